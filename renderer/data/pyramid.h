#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/data/volume.h"

namespace volcast::data {

/// Volumes of fewer voxels have no pyramid: a channel of them takes less than 8 MiB as floats.
inline constexpr std::size_t kLeastPyramidVoxels = std::size_t{1} << 21;

/// The coarsest level of a pyramid is the first that has at most this many intervals a side.
inline constexpr int kCoarsestIntervals = 32;

/// Levels above level 0 that the pyramid of a volume of `size` has; 0: it has none.
[[nodiscard]] int pyramidLevels(const glm::ivec3& size) noexcept;

/// Bytes of all coarser levels of one channel of `volume`.
[[nodiscard]] std::size_t pyramidBytes(const Volume& volume) noexcept;

/// What is known of all voxels of a channel before there is a pyramid.
struct KnownVoxels {
    Range range;
    bool someMissing = false;  ///< NaN among them.
};

/// Fills `coarse`, the voxels of `level`, from those of the level before: see Volume for how.
/// `known`: the channel. `progress` is told the share that is done now and then.
void halve(const Volume& volume, int level, const KnownVoxels& known,
           std::span<const std::byte> fine, std::span<std::byte> coarse,
           const std::function<void(double)>& progress);

/// All coarser levels of a channel that is complete but for them.
std::vector<ChannelLevel> buildPyramid(const Volume& volume, const Channel& channel,
                                       const std::function<void(double)>& progress);

}  // namespace volcast::data
