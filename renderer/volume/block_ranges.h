#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "renderer/data/volume.h"

namespace volcast::volume {

/// Ranges that let rays pass over several steps at once: of blocks of kRangeBlock grid intervals
/// along each axis, each with kRangeReach more on all sides, and one more again for what tricubic
/// interpolation reads. So whatever is within kRangeReach of a point of a block is known from one
/// of them, and rays that run side by side need not stop where one of them enters another block.
inline constexpr int kRangeBlock = 4;
inline constexpr int kRangeReach = 4;

/// (smallest, largest) value of each block, x fastest; (infinity, -infinity) where there is none.
std::vector<glm::vec2> blockRanges(const data::Volume& volume, const data::Channel& channel);

}  // namespace volcast::volume
