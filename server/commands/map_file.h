#pragma once

#include <string_view>

#include "renderer/data/drawn_map.h"
#include "renderer/data/field.h"

namespace volcast::commands {

/// What a map file may leave open.
struct MapUsual {
    data::Range window;                   ///< The field's usual range.
    std::vector<float> percentiles = {};  ///< Of the field, 0 to 100 %; empty: it has no values.
    double distance = 1.0;                ///< World units.
    data::Axis axis = {};                 ///< Of the field's scale.
};

/// A transfer function from a file: lines `value r g b sigma`, or a JSON object with one of
///
///     "points":    [{"value": V, "colour": {"r": R, "g": G, "b": B}, "extinction": S}, ...];
///                  the page's files have "kind" and "editor" besides, which are not read
///     "colours":   [[POSITION, COLOUR], ...] and "opacities": [[POSITION, OPACITY], ...],
///                  "curve": "spline" (where absent) or "lines"
///     "rgba":      [[R, G, B, OPACITY], ...] at equal steps
///     "linear":    COLOUR, fading in from black; "opacity": that of the window's last value (0.6)
///
/// and, for all but "points", "window": [FIRST, LAST] or "percentiles": [FIRST, LAST] (whole
/// numbers), and "distance": world units that opacities are over. A COLOUR is "#rrggbb" (sRGB) or
/// [R, G, B] (linear).
///
/// Errors: kInvalidArgument or kLimitExceeded naming the line or key.
Result<data::TransferFunction> parseMap(std::string_view text, const MapUsual& usual);

}  // namespace volcast::commands
