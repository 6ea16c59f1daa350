#include "renderer/data/transfer_function.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>

namespace volcast::data {

namespace {

bool isFinite(const ControlPoint& point) {
    return std::isfinite(point.value) && std::isfinite(point.extinction) &&
           std::isfinite(point.colour.r) && std::isfinite(point.colour.g) &&
           std::isfinite(point.colour.b);
}

glm::vec4 colourAndExtinction(const ControlPoint& point) {
    return {point.colour, point.extinction};
}

/// One line without its comment; an empty result where nothing is left of it.
std::string_view stripped(std::string_view line) {
    line = line.substr(0, line.find('#'));
    const auto first = line.find_first_not_of(" \t\r");
    return first == std::string_view::npos ? std::string_view{} : line.substr(first);
}

/// Reads `value r g b sigma` and nothing more.
bool readPoint(std::string_view text, ControlPoint& point) {
    std::istringstream in{std::string{text}};
    in.imbue(std::locale::classic());
    std::string rest;
    return static_cast<bool>(in >> point.value >> point.colour.r >> point.colour.g >>
                             point.colour.b >> point.extinction) &&
           !(in >> rest);
}

}  // namespace

glm::vec4 evaluate(const TransferFunction& map, float value) {
    const auto& points = map.points;
    // The first point beyond the value; at a step this is the point after it.
    const auto above = std::upper_bound(
        points.begin(), points.end(), value,
        [](float wanted, const ControlPoint& point) { return wanted < point.value; });
    if (above == points.begin()) return colourAndExtinction(points.front());
    if (above == points.end()) return colourAndExtinction(points.back());
    const ControlPoint& low = *(above - 1);
    const float t = (value - low.value) / (above->value - low.value);
    return glm::mix(colourAndExtinction(low), colourAndExtinction(*above), t);
}

Result<void> validate(const TransferFunction& map) {
    const auto count = map.points.size();
    if (count == 0) {
        return fail(ErrorCode::kInvalidArgument, "transfer function: has no points", "points");
    }
    if (count > TransferFunction::kMaxPoints) {
        return fail(ErrorCode::kLimitExceeded,
                    "transfer function: " + std::to_string(count) + " points, the limit is " +
                        std::to_string(TransferFunction::kMaxPoints),
                    "points");
    }
    for (std::size_t i = 0; i < count; ++i) {
        const ControlPoint& point = map.points[i];
        const std::string field = "points[" + std::to_string(i) + "]";
        if (!isFinite(point)) {
            return fail(ErrorCode::kInvalidArgument,
                        "transfer function: " + field + " has a number that is not finite", field);
        }
        if (point.extinction < 0.0F) {
            return fail(ErrorCode::kInvalidArgument,
                        "transfer function: " + field + " has a negative extinction, " +
                            std::to_string(point.extinction),
                        field + ".extinction");
        }
        if (i > 0 && point.value < map.points[i - 1].value) {
            return fail(ErrorCode::kInvalidArgument,
                        "transfer function: the value of " + field + ", " +
                            std::to_string(point.value) + ", is below the one before it",
                        field + ".value");
        }
    }
    return {};
}

Result<TransferFunction> parseTransferFunction(std::string_view text) {
    TransferFunction map;
    int number = 0;
    while (!text.empty()) {
        ++number;
        const auto end = text.find('\n');
        const std::string_view line = stripped(text.substr(0, end));
        text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
        if (line.empty()) continue;
        ControlPoint point;
        if (!readPoint(line, point)) {
            return fail(ErrorCode::kInvalidArgument,
                        "transfer function, line " + std::to_string(number) +
                            ": expected five numbers, value r g b sigma");
        }
        map.points.push_back(point);
        if (const auto valid = validate(map); !valid) {
            return fail(valid.error().code,
                        "line " + std::to_string(number) + ": " + valid.error().message,
                        valid.error().field);
        }
    }
    if (const auto valid = validate(map); !valid) return valid.error();
    return map;
}

TransferFunction defaultTransferFunction(Range range, double lengthWorld) {
    // Five colours of the map viridis (S. van der Walt, N. Smith, 2015, CC0) in linear light, from
    // sRGB (68 1 84), (59 82 139), (33 145 140), (94 201 98), (253 231 37).
    constexpr std::array kColours{
        glm::vec3{0.0578F, 0.0003F, 0.0887F}, glm::vec3{0.0437F, 0.0844F, 0.2582F},
        glm::vec3{0.0152F, 0.2831F, 0.2623F}, glm::vec3{0.1119F, 0.5841F, 0.1221F},
        glm::vec3{0.9823F, 0.7991F, 0.0185F}};
    const double length = lengthWorld > 0.0 && std::isfinite(lengthWorld) ? lengthWorld : 1.0;
    constexpr double kLargest = 1e30;
    const auto half = static_cast<float>(std::min(std::log(2.0) / length, kLargest));
    const float low = std::min(range.min, range.max);
    const float high = std::max(range.min, range.max);
    TransferFunction map;
    for (std::size_t i = 0; i < kColours.size(); ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(kColours.size() - 1);
        map.points.push_back({.value = low * (1.0F - t) + high * t,
                              .colour = kColours[i],
                              .extinction = 2.0F * half * t});
    }
    return map;
}

}  // namespace volcast::data
