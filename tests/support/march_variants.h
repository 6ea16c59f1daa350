#pragma once

#include "renderer/scene/ray_models.h"
#include "renderer/volume/march.h"

namespace volcast::support {

inline constexpr int kMarchVariants = 32;

/// Programs of the march for one ray model: what tells them apart takes turns, so that each
/// meets each other with both of its values.
inline volume::MarchTraits marchTraits(const scene::RayModelRow& row, int variant) {
    const auto bit = [variant](int i) { return (variant >> i & 1) != 0; };
    const bool first = bit(0) != bit(2);
    return {.model = row.model,
            .integrator =
                row.voxelIntegrators[first ? 0 : variant % row.voxelIntegrators.size()].integrator,
            .sampling = static_cast<scene::Sampling>(variant % 3),
            .texels = static_cast<volume::VoxelTexels>(variant / 3 % 4),
            .filterInHardware = bit(3),
            .skipsBricks = bit(1),
            .byDistance = bit(2) != bit(3),
            .earlyStop = bit(2),
            .lit = bit(4) && row.model == scene::RayModel::kIsosurface,
            .shaded = bit(2) && row.model == scene::RayModel::kVolume,
            .lightAtEye = bit(3) != bit(0),
            .interval = bit(4) != bit(1),
            .jitters = first && bit(3),
            .missing = bit(0) != bit(4),
            .clipPlanes = bit(3) != bit(2) ? 2 : 0};
}

}  // namespace volcast::support
