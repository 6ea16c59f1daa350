#pragma once

#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/base/result.h"
#include "renderer/data/field.h"

namespace volcast::data {

/// One point of a transfer function.
struct ControlPoint {
    float value = 0.0F;       ///< In the field's own unit.
    glm::vec3 colour{0.0F};   ///< Linear RGB.
    float extinction = 0.0F;  ///< 1 / world unit, >= 0.
    friend bool operator==(const ControlPoint&, const ControlPoint&) = default;
};

/// Colour and extinction of a value: piecewise linear, clamped outside the first and last point.
///
/// Values ascend; two equal values make a step.
struct TransferFunction {
    static constexpr std::size_t kMaxPoints = 1024;

    std::vector<ControlPoint> points;

    friend bool operator==(const TransferFunction&, const TransferFunction&) = default;
};

/// Colour (rgb) and extinction (a) at `value`. `map` has at least one point.
glm::vec4 evaluate(const TransferFunction& map, float value);

/// Checks count (1 to kMaxPoints), order, finiteness and sign.
///
/// Errors: kInvalidArgument or kLimitExceeded, with `field` naming the point.
Result<void> validate(const TransferFunction& map);

/// Reads lines `value r g b sigma`; `#` starts a comment.
///
/// Errors: kInvalidArgument naming the line.
Result<TransferFunction> parseTransferFunction(std::string_view text);

/// The map a dataset is first shown with: dark violet to yellow over `range`, extinction rising
/// from 0 so that `lengthWorld` of the middle value is half opaque.
TransferFunction defaultTransferFunction(Range range, double lengthWorld);

}  // namespace volcast::data
