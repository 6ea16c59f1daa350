#include "renderer/data/drawn_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

namespace volcast::data {

namespace {

/// A point of a piecewise linear function, steps included.
template <class Value>
struct Knot {
    double position;
    Value value;
};

/// Before the step where there is one at `position`.
template <class Value>
Value below(const std::vector<Knot<Value>>& line, double position) {
    const auto at = std::ranges::lower_bound(line, position, {}, &Knot<Value>::position);
    if (at == line.end()) return line.back().value;
    if (at == line.begin() || at->position == position) return at->value;
    const double t = (position - (at - 1)->position) / (at->position - (at - 1)->position);
    return glm::mix((at - 1)->value, at->value, t);
}

/// After the step where there is one at `position`.
template <class Value>
Value above(const std::vector<Knot<Value>>& line, double position) {
    const auto at = std::ranges::upper_bound(line, position, {}, &Knot<Value>::position);
    if (at == line.begin()) return line.front().value;
    if ((at - 1)->position == position) return (at - 1)->value;
    return below(line, position);
}

using Colours = std::vector<Knot<glm::dvec3>>;
using Depths = std::vector<Knot<double>>;  ///< -log1p(-opacity).

double depthOf(double opacity) {
    return -std::log1p(-std::min(opacity, kMostOpacity));
}

/// A stretch of a span that one line in depth may or may not follow.
struct Stretch {
    double x0, x1;
    double depth0, depth1;
    int halvings;
};

/// Whether the line in depth is as close to the curve as it has to be, looked at where a smooth
/// difference is largest.
bool closeEnough(const OpacityCurve& curve, int span, const Stretch& s) {
    // The points between these cannot be much worse: a quarter of the error is left for them.
    constexpr double kLookedFor = 0.75 * kOpacityError;
    for (const double t : {0.5, 0.25, 0.75, 0.1, 0.9}) {
        const double drawn = std::min(curve.at(span, std::lerp(s.x0, s.x1, t)), kMostOpacity);
        const double line = -std::expm1(-std::lerp(s.depth0, s.depth1, t));
        if (std::abs(line - drawn) > kLookedFor) return false;
    }
    return true;
}

/// Appends points after x0, x1 last.
void follow(const OpacityCurve& curve, int span, const Stretch& s, Depths& depths) {
    constexpr int kMostHalvings = 40;  // A curve that stands upright ends in a step of this width.
    const double middle = std::midpoint(s.x0, s.x1);
    if (s.halvings < kMostHalvings && !closeEnough(curve, span, s) &&
        depths.size() <= TransferFunction::kMaxPoints) {
        const double depth = depthOf(curve.at(span, middle));
        follow(curve, span, {s.x0, middle, s.depth0, depth, s.halvings + 1}, depths);
        follow(curve, span, {middle, s.x1, depth, s.depth1, s.halvings + 1}, depths);
        return;
    }
    depths.push_back({s.x1, s.depth1});
}

Depths follow(const DrawnMap& map) {
    const OpacityCurve curve{map.opacities, map.degree};
    OpacityPoint from = curve.joint(0);
    Depths depths{{from.x, depthOf(from.y)}};
    for (int span = 0; span < curve.spans(); ++span) {
        const OpacityPoint to = curve.joint(span + 1);
        follow(curve, span, {from.x, to.x, depthOf(from.y), depthOf(to.y), 0}, depths);
        from = to;
    }
    return depths;
}

Error wrong(const std::string& field, const std::string& why) {
    return fail(ErrorCode::kInvalidArgument, field + ": " + why, field);
}

std::string text(double value) {
    return std::to_string(value);
}

Result<void> checkPosition(const std::string& item, double position, double before) {
    if (!(position >= 0.0 && position <= 1.0)) {
        return wrong(item + ".position", text(position) + " is not from 0 to 1");
    }
    if (position < before) {
        return wrong(item + ".position",
                     text(position) + " is below the one before it, " + text(before));
    }
    return {};
}

Result<void> checkOpacity(const std::string& field, double opacity) {
    if (opacity >= 0.0 && opacity <= 1.0) return {};
    return wrong(field, text(opacity) + " is not from 0 to 1");
}

Result<void> checkDistance(double distance) {
    if (distance > 0.0 && std::isfinite(distance)) return {};
    return wrong("distance", text(distance) + " is not a finite number above 0");
}

Result<void> checkColour(const std::string& field, const glm::vec3& colour) {
    for (int i = 0; i < 3; ++i) {
        if (!(colour[i] >= 0.0F && std::isfinite(colour[i]))) {
            return wrong(field, text(colour[i]) + " is not a finite number from 0 up");
        }
    }
    return {};
}

Result<void> check(const Window& window) {
    const std::string both = text(window.first) + " to " + text(window.last);
    constexpr double kLargest = std::numeric_limits<float>::max();
    if (!(std::abs(window.first) <= kLargest && std::abs(window.last) <= kLargest)) {
        return wrong("window", both + " is not a pair of finite float32 numbers");
    }
    if (static_cast<float>(window.first) == static_cast<float>(window.last))
        return wrong("window", both + " has no width that float32 can tell");
    return {};
}

Result<void> check(const DrawnMap& map) {
    if (map.colours.empty()) return wrong("colours", "there is none");
    if (map.opacities.empty()) return wrong("opacities", "there is none");
    if (map.degree != 1 && map.degree != 3) {
        return wrong("degree", std::to_string(map.degree) + " is neither 1 nor 3");
    }
    double before = 0.0;
    for (std::size_t i = 0; i < map.colours.size(); ++i) {
        const std::string item = "colours[" + std::to_string(i) + "]";
        auto good = checkPosition(item, map.colours[i].position, before);
        if (good) good = checkColour(item + ".colour", map.colours[i].colour);
        if (!good) return good;
        before = map.colours[i].position;
    }
    before = 0.0;
    for (std::size_t i = 0; i < map.opacities.size(); ++i) {
        const std::string item = "opacities[" + std::to_string(i) + "]";
        auto good = checkPosition(item, map.opacities[i].x, before);
        if (good) good = checkOpacity(item + ".opacity", map.opacities[i].y);
        if (!good) return good;
        before = map.opacities[i].x;
    }
    return checkDistance(map.distance);
}

double valueAt(const Window& window, const Axis& axis, double position) {
    if (!axis.along || position == 0.0 || position == 1.0) {
        return std::lerp(window.first, window.last, position);
    }
    return axis.back(std::lerp(axis.along(window.first), axis.along(window.last), position));
}

/// Both functions at all positions where either has a point.
Result<TransferFunction> merged(const Colours& colours, const Depths& depths, double distance,
                                const Window& window, const Axis& axis) {
    std::vector<double> positions;
    for (const auto& knot : colours) positions.push_back(knot.position);
    for (const auto& knot : depths) positions.push_back(knot.position);
    std::ranges::sort(positions);
    positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
    TransferFunction map;
    const auto add = [&](double position, const glm::dvec3& colour, double depth) {
        map.points.push_back({.value = static_cast<float>(valueAt(window, axis, position)),
                              .colour = glm::vec3{colour},
                              .extinction = static_cast<float>(depth / distance)});
    };
    for (const double position : positions) {
        const glm::dvec3 colour = below(colours, position), next = above(colours, position);
        const double depth = below(depths, position), nextDepth = above(depths, position);
        add(position, colour, depth);
        if (colour != next || depth != nextDepth) add(position, next, nextDepth);
    }
    if (window.first > window.last) std::ranges::reverse(map.points);
    if (map.points.size() > TransferFunction::kMaxPoints) {
        return fail(ErrorCode::kLimitExceeded,
                    "opacities: following their curve to an error of 1/1024 takes more than " +
                        std::to_string(TransferFunction::kMaxPoints) + " control points",
                    "opacities");
    }
    if (auto valid = validate(map); !valid) return valid.error();
    return map;
}

}  // namespace

double extinctionOf(double opacity, double distance) {
    return depthOf(opacity) / distance;
}

Result<TransferFunction> resolve(const DrawnMap& map, const Window& window, const Axis& axis) {
    if (auto good = check(map); !good) return good.error();
    if (auto good = check(window); !good) return good.error();
    Colours colours;
    for (const ColourPoint& point : map.colours) {
        colours.push_back({point.position, glm::dvec3{point.colour}});
    }
    return merged(colours, follow(map), map.distance, window, axis);
}

Result<TransferFunction> fromTable(std::span<const glm::dvec4> rgba, double distance,
                                   const Window& window, const Axis& axis) {
    if (rgba.empty()) return wrong("rgba", "there is no entry");
    if (rgba.size() > TransferFunction::kMaxPoints) {
        return fail(ErrorCode::kLimitExceeded,
                    "rgba: " + std::to_string(rgba.size()) + " entries, the limit is " +
                        std::to_string(TransferFunction::kMaxPoints),
                    "rgba");
    }
    if (auto good = checkDistance(distance); !good) return good.error();
    if (auto good = check(window); !good) return good.error();
    Colours colours;
    Depths depths;
    for (std::size_t i = 0; i < rgba.size(); ++i) {
        const std::string item = "rgba[" + std::to_string(i) + "]";
        auto good = checkColour(item, glm::vec3{rgba[i]});
        if (good) good = checkOpacity(item, rgba[i].a);
        if (!good) return good.error();
        const double position =
            rgba.size() == 1 ? 0.0 : static_cast<double>(i) / static_cast<double>(rgba.size() - 1);
        colours.push_back({position, glm::dvec3{rgba[i]}});
        depths.push_back({position, depthOf(rgba[i].a)});
    }
    return merged(colours, depths, distance, window, axis);
}

DrawnMap linearMap(const glm::vec3& colour, double opacity, double distance) {
    return {.colours = {{.position = 0.0, .colour = glm::vec3{0.0F}},
                        {.position = 1.0, .colour = colour}},
            .opacities = {{0.0, 0.0}, {1.0, opacity}},
            .degree = 1,
            .distance = distance};
}

}  // namespace volcast::data
