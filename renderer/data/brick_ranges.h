#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/data/volume.h"

namespace volcast::data {

/// Smallest and largest value of each brick of `level`, by the level's `voxels` alone; see
/// Volume::brickGrid and ChannelLevel::bricks.
std::vector<glm::vec2> brickRanges(const Volume& volume, int level,
                                   std::span<const std::byte> voxels);

/// Widens the ranges of a level's bricks by those of the next finer level's beneath them.
void includeFiner(const Volume& volume, int level, std::span<const glm::vec2> finer,
                  std::span<glm::vec2> ranges);

}  // namespace volcast::data
