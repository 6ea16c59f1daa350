#pragma once

#include <array>
#include <string_view>

namespace volcast::shading {

/// One ray model: its chunk, and what it needs of a program.
struct RayModelRow {
    std::string_view name;   ///< As in plans and on the command line.
    std::string_view chunk;  ///< Fills the slot `model`; empty: drawn as triangles, not by rays.
    bool integrates;         ///< Calls integrateSegment(): the slot `segment` must be filled.
    bool onMeshes;
    bool onVolumes;
};

/// All ray models, in the order of scene::RayModel.
inline constexpr std::array<RayModelRow, 3> kRayModels{{
    {"surface", "", false, true, false},
    {"mip", "model/mip.glsl", false, true, true},
    {"volume", "model/volume.glsl", true, true, true},
}};

}  // namespace volcast::shading
