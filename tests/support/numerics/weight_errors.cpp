#include "tests/support/numerics/weight_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace volcast::support {
namespace {

double relative(double got, double right) {
    const double past = std::max(std::abs(got - right) - kAbsolute, 0.0);
    return past == 0.0 ? 0.0 : past / std::max(right, std::numeric_limits<double>::min());
}

bool bothIn(const PsiRow& row, double low, double high) {
    return std::min(row.a, row.b) >= low && std::max(row.a, row.b) <= high;
}

}  // namespace

WeightErrors::WeightErrors() {
    const auto name = [this](Measure measure, const char* text, double limit) {
        measures_[measure].name = text;
        measures_[measure].limit = limit;
    };
    const double any = std::numeric_limits<double>::infinity();
    name(kFrontRelative, "w_front, relative", kRelative);
    name(kBackRelative, "w_back, relative", kRelative);
    name(kThin, "T: w_back, relative, depths in [1e-6, 1]", any);
    name(kMiddle, "U: w_back, relative, depths in [0, 10]", any);
    name(kWide, "W: w_back, absolute, depths in [1e-30, 1e6]", any);
    name(kOpacity, "|w_front + w_back - (1 - zeta)|", kSum);
    name(kOwnSum, "|w_front + w_back - alpha|", kSum);
    name(kNegative, "a weight below 0 by", 0.0);
    name(kAboveTwoThirds, "w_back above 2/3 alpha by", 0.0);
    name(kNotFinite, "not finite", 0.0);
}

void WeightErrors::add(const PsiRow& row, const glm::vec3& weights) {
    const double front = weights.x;
    const double back = weights.y;
    const double alpha = weights.z;
    std::array<double, kMeasures> errors{};
    errors.fill(-1.0);
    errors[kNotFinite] =
        std::isfinite(front) && std::isfinite(back) && std::isfinite(alpha) ? 0 : 1;
    if (errors[kNotFinite] == 0.0) {
        errors[kFrontRelative] = relative(front, row.front);
        errors[kBackRelative] = relative(back, row.back);
        if (bothIn(row, 1e-6, 1.0)) errors[kThin] = errors[kBackRelative];
        if (bothIn(row, 0.0, 10.0)) errors[kMiddle] = errors[kBackRelative];
        if (bothIn(row, 1e-30, 1e6)) errors[kWide] = std::abs(back - row.back);
        errors[kOpacity] = std::abs(front + back - (1.0 - row.zeta));
        errors[kOwnSum] = std::abs(front + back - alpha);
        errors[kNegative] = std::max({-front, -back, 0.0});
        errors[kAboveTwoThirds] = std::max((3.0 * back - 2.0 * alpha) / 3.0, 0.0);
    }
    bool past = false;
    for (std::size_t i = 0; i < kMeasures; ++i) {
        Worst& worst = measures_[i];
        if (errors[i] > worst.limit) {
            ++worst.past;
            past = true;
        }
        if (errors[i] <= worst.error) continue;
        worst.error = errors[i];
        worst.row = row;
        worst.weights = weights;
    }
    ++rows_;
    if (past) ++rowsPast_;
}

}  // namespace volcast::support
