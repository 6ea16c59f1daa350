#pragma once

#include <vector>

#include "renderer/scene/map_texels.h"
#include "renderer/shading/assemble.h"

namespace volcast::support {

/// What a layer gives to recipes, in a variant: bits 0 and 1 say whether there are two maps and
/// opaque layers, the rest how maps are found.
inline std::vector<shading::Constant> layerConstants(int bits) {
    const auto bit = [bits](int i) { return (bits >> i & 1) != 0; };
    return {{"kMapSearch", (bits >> 2) % 4},
            {"kDensitySearch", (bits >> 3) % 4},
            {"kMapSlopes", bit(2) ? 4 : 7},
            {"kDensitySlopes", bit(3) ? 4 : 7},
            {"kTwoMaps", bit(0)},
            {"kPreintegratedSide", scene::kPreintegratedSide},
            {"kEndsAtSurfaces", bit(1)}};
}

}  // namespace volcast::support
