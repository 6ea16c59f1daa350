#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/data/volume.h"

namespace volcast::volume {

/// Volumes in blocks of kRangeBlock grid intervals along each axis; what is known of a block lets
/// rays pass over it. Blocks of a grid are x fastest.
inline constexpr int kRangeBlock = 4;
/// Ranges that GPUs read are of blocks with this much more on all sides, so that whatever is within
/// it of a point of a block is known from one of them, and rays that run side by side need not stop
/// where one of them enters another block.
inline constexpr int kRangeReach = 4;

/// Blocks along each axis of a volume of `points` grid points.
glm::ivec3 blockGrid(glm::ivec3 points);

/// (smallest, largest) value of the voxels of each block's intervals, and of `around` more on all
/// sides: 0 for all that trilinear interpolation reads, 1 for tricubic. NaN counts as no value;
/// (infinity, -infinity): there is none.
std::vector<glm::vec2> blockRanges(const data::Volume& volume, const data::Channel& channel,
                                   int around);

/// Joins each block's range with those of the up to 26 blocks around it.
std::vector<glm::vec2> joinedAround(std::span<const glm::vec2> ranges, glm::ivec3 grid);

}  // namespace volcast::volume
