#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "renderer/data/transfer_function.h"
#include "renderer/scene/scale.h"

namespace volcast::reference {

/// A transfer function over scaled values, in double: colour (rgb) and extinction (a).
///
/// Piece 0 lies before the first control point and piece `points` beyond the last, both constant;
/// piece k between points k - 1 and k. At a step its value is that of the point after it.
class LinearMap {
public:
    LinearMap() = default;
    LinearMap(const data::TransferFunction& map, const scene::ScaleFunction& scale);

    [[nodiscard]] bool empty() const noexcept { return values_.empty(); }
    [[nodiscard]] glm::dvec4 at(double value) const { return on(pieceAt(value), value); }
    [[nodiscard]] std::size_t pieceAt(double value) const;
    /// What piece `piece` would have at `value`, clamped to its ends.
    [[nodiscard]] glm::dvec4 on(std::size_t piece, double value) const;
    /// Piece `piece` as slope * value + offset.
    struct Line {
        glm::dvec4 slope{0.0}, offset{0.0};
    };
    [[nodiscard]] Line lineOf(std::size_t piece) const;
    /// Values of the control points, ascending.
    [[nodiscard]] const std::vector<double>& values() const noexcept { return values_; }

    /// Adds the shares in (0, 1) of the way from `from` to `to` at which the map bends or steps.
    void addBends(double from, double to, std::vector<double>& shares) const;
    /// The largest red, green, blue and extinction over [low, high]: ends and all points between.
    /// Of a step within both sides count, at `low` the upper one.
    [[nodiscard]] glm::dvec4 largest(double low, double high) const;

private:
    std::vector<double> values_;
    std::vector<glm::dvec4> matter_;
};

}  // namespace volcast::reference
