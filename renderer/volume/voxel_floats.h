#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "renderer/data/volume.h"

namespace volcast::volume {

/// `voxels` of `type` as floats; 8- and 16-bit integers are exact.
void toFloats(data::VoxelType type, std::span<const std::byte> voxels, std::vector<float>& floats);

}  // namespace volcast::volume
