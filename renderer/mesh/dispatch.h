#pragma once

#include <algorithm>

#include "renderer/gpu/device.h"

namespace volcast::mesh {

/// Runs the bound compute program once for each of `items`, in groups of 128 in one row or several:
/// id = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 128. Ids of the
/// last groups may be too large.
inline void dispatchEach(gpu::Device& device, int items) {
    constexpr unsigned kGroupSize = 128;  // local_size_x of the shaders.
    constexpr unsigned kGroupsAcross = 16384;
    const unsigned groups = (static_cast<unsigned>(items) + kGroupSize - 1) / kGroupSize;
    device.dispatch(std::min(groups, kGroupsAcross), (groups + kGroupsAcross - 1) / kGroupsAcross,
                    1);
}

}  // namespace volcast::mesh
