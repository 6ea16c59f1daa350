#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "renderer/data/volume.h"
#include "renderer/volume/brick_tree.h"

namespace volcast::volume {

/// Grid points along an axis of a brick in the pool, with its border.
[[nodiscard]] int pooledBrickSide() noexcept;

/// Copies a brick's voxels with its border into `voxels`, which has room for them: x fastest.
/// Beyond the volume its outermost grid points are repeated.
void copyBrick(const data::Volume& volume, const data::Channel& channel, const Brick& brick,
               std::vector<std::byte>& voxels);

}  // namespace volcast::volume
