#pragma once

#include <functional>
#include <span>
#include <vector>

#include "renderer/base/result.h"
#include "renderer/data/opacity_curve.h"
#include "renderer/data/transfer_function.h"

namespace volcast::data {

/// A colour at a position.
struct ColourPoint {
    double position = 0.0;
    glm::vec3 colour{0.0F};  ///< Linear RGB.
};

/// The values that positions 0 and 1 stand for; values outside are clamped. Inverted windows
/// (first > last) have a meaning: the map runs from high values to low ones.
struct Window {
    double first = 0.0;
    double last = 1.0;
};

/// What a scale does to values, and its inverse; both monotone over the window. Empty: linear.
struct Axis {
    std::function<double(double)> along, back;
};

/// A transfer function as editors draw it: colours and opacities apart, each as many as it likes.
///
/// Positions run from 0 to 1 over a window, straight along the field's axis, and do not fall; two
/// equal ones make a step. Before the first point and beyond the last each keeps its end's value.
struct DrawnMap {
    std::vector<ColourPoint> colours{};  ///< One at least; straight lines between them.
    /// One at least; opacity in [0, 1] over `distance`. See OpacityCurve.
    std::vector<OpacityPoint> opacities{};
    int degree = 3;         ///< Of the opacity's curve: 3, or 1 for straight lines.
    double distance = 1.0;  ///< World units, > 0.
};

/// How far the opacity (over a map's `distance`) of resolve()'s points is from the curve, at most.
inline constexpr double kOpacityError = 1.0 / 1024.0;

/// Opacities count as at most this: 1 would need infinite extinction.
inline constexpr double kMostOpacity = 1.0 - 1.0 / (1 << 24);

/// -log1p(-opacity) / distance; see kMostOpacity.
[[nodiscard]] double extinctionOf(double opacity, double distance);

/// Control points of a drawn map: all colour points, and as many on the opacity's curve as make
/// lines in extinction follow it to kOpacityError.
///
/// Errors: kInvalidArgument with `field` naming what is wrong ("colours[2].position",
/// "opacities[0].opacity", "distance", "window"); kLimitExceeded, "opacities", where more than
/// TransferFunction::kMaxPoints would be needed.
Result<TransferFunction> resolve(const DrawnMap& map, const Window& window, const Axis& axis = {});

/// Entries at equal steps over a window: linear RGB and opacity over `distance`; lines in colour
/// and extinction between them. A single entry holds everywhere.
///
/// Errors: as above, with "rgba[3]" and "rgba".
Result<TransferFunction> fromTable(std::span<const glm::dvec4> rgba, double distance,
                                   const Window& window, const Axis& axis = {});

/// One colour that fades in: black and clear at the window's first value, `colour` with `opacity`
/// over its distance at the last, linear in the value between them.
DrawnMap linearMap(const glm::vec3& colour, double opacity, double distance);

}  // namespace volcast::data
