#include "renderer/scene/scale.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "renderer/scene/validate_error.h"

namespace volcast::scene {
namespace {

bool ordered(const data::Range& range) {
    return std::isfinite(range.min) && std::isfinite(range.max) && range.min < range.max;
}

/// The lower end of a range that is small beside its distance from 0, else 0.
double farOffset(const data::Range& range) {
    constexpr double kFar = 4.0;
    const double low = range.min, high = range.max;
    return std::max(std::abs(low), std::abs(high)) > kFar * (high - low) ? low : 0.0;
}

}  // namespace

ScaleFunction::ScaleFunction(const Scale& scale, const data::Range& range)
    : kind_{scale.kind},
      exponent_{scale.exponent},
      domain_{scale.domain.value_or(range)},
      offset_{scale.kind == Scale::Kind::kLinear ? farOffset(domain_) : 0.0},
      identity_{scale.kind == Scale::Kind::kLinear && !scale.domain.has_value() && offset_ == 0.0} {
}

float ScaleFunction::ofData(float value) const {
    if (identity_) return value;
    return ofPoint(std::clamp(value, domain_.min, domain_.max));
}

float ScaleFunction::ofPoint(float value) const {
    switch (kind_) {
        case Scale::Kind::kLinear: return static_cast<float>(static_cast<double>(value) - offset_);
        case Scale::Kind::kLog: return static_cast<float>(std::log(static_cast<double>(value)));
        case Scale::Kind::kPower: break;
    }
    const double width = static_cast<double>(domain_.max) - domain_.min;
    const double share = width > 0.0 ? (static_cast<double>(value) - domain_.min) / width : 0.0;
    // Odd beyond the lower end, so that control points below the domain keep their order.
    return static_cast<float>(std::copysign(std::pow(std::abs(share), exponent_), share));
}

data::TransferFunction scaled(const data::TransferFunction& map, const ScaleFunction& scale) {
    data::TransferFunction result = map;
    for (data::ControlPoint& point : result.points) point.value = scale.ofPoint(point.value);
    return result;
}

std::vector<float> resolved(const Levels& levels) {
    std::vector<float> values = levels.values;
    if (levels.spacing != Levels::Spacing::kList) {
        values.clear();
        const double first = levels.first, last = levels.last;
        for (int i = 0; i < levels.count; ++i) {
            const double t = levels.count > 1 ? static_cast<double>(i) / (levels.count - 1) : 0.0;
            double value = first + (last - first) * t;
            if (levels.spacing == Levels::Spacing::kLog) value = first * std::pow(last / first, t);
            if (levels.spacing == Levels::Spacing::kPower) {
                value = first + (last - first) * std::pow(t, static_cast<double>(levels.exponent));
            }
            values.push_back(static_cast<float>(value));
        }
    }
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

Result<void> validate(const Scale& scale, const data::Range& range, const std::string& path) {
    if (scale.domain && !ordered(*scale.domain)) {
        return invalid(path + ".domain",
                       std::to_string(scale.domain->min) + " to " +
                           std::to_string(scale.domain->max) +
                           " is not a range of finite numbers, the first below the last");
    }
    const data::Range domain = scale.domain.value_or(range);
    if (scale.kind == Scale::Kind::kLog && !(domain.min > 0.0F)) {
        return invalid(path + ".domain",
                       "a logarithmic scale needs values above 0, the domain begins at " +
                           std::to_string(domain.min) + "; give it one above 0");
    }
    if (scale.kind == Scale::Kind::kPower &&
        !(scale.exponent > 0.0F && std::isfinite(scale.exponent))) {
        return invalid(path + ".exponent", std::to_string(scale.exponent) + " is not above 0");
    }
    return {};
}

std::vector<float> levelsOf(const Layer& layer) {
    std::vector<float> levels = resolved(layer.levels);
    if (layer.interval) {
        std::erase_if(levels, [&](float level) {
            return level < layer.interval->min || level > layer.interval->max;
        });
    }
    return levels;
}

Result<void> validate(const Levels& levels, const std::string& path) {
    const bool list = levels.spacing == Levels::Spacing::kList;
    const long count = list ? static_cast<long>(levels.values.size()) : levels.count;
    const std::string where = path + (list ? ".values" : ".count");
    if (count < 1) return invalid(where, "an isosurface needs at least one level");
    if (count > Levels::kMaxLevels) {
        return fail(ErrorCode::kLimitExceeded,
                    where + ": " + std::to_string(count) + " levels, at most " +
                        std::to_string(Levels::kMaxLevels),
                    where);
    }
    if (list) {
        if (std::ranges::all_of(levels.values, [](float v) { return std::isfinite(v); })) return {};
        return invalid(where, "a level is not a finite number");
    }
    if (!std::isfinite(levels.first)) return invalid(path + ".first", "is not a finite number");
    if (!std::isfinite(levels.last)) return invalid(path + ".last", "is not a finite number");
    if (levels.spacing == Levels::Spacing::kLog && !(levels.first > 0.0F && levels.last > 0.0F)) {
        const bool first = !(levels.first > 0.0F);
        return invalid(path + (first ? ".first" : ".last"),
                       std::to_string(first ? levels.first : levels.last) +
                           " is not above 0, as logarithmic spacing needs");
    }
    if (levels.spacing == Levels::Spacing::kPower &&
        !(levels.exponent > 0.0F && std::isfinite(levels.exponent))) {
        return invalid(path + ".exponent", std::to_string(levels.exponent) + " is not above 0");
    }
    return {};
}

}  // namespace volcast::scene
