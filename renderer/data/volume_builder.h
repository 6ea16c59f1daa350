#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/base/result.h"
#include "renderer/data/volume.h"

namespace volcast::data {

/// One scalar a voxel, as a file holds it.
struct ChannelInput {
    std::string name;  ///< Unique; bytes that are no UTF-8 become '?'.
    std::string unit = {};
    std::vector<std::byte> voxels = {};  ///< Native byte order, x fastest, no padding.
};

/// Voxels as a file holds them; members as in Volume.
struct VolumeInput {
    glm::ivec3 size{1};
    glm::dvec3 spacing{1.0};
    glm::dvec3 origin{0.0};
    glm::dmat3 direction{1.0};  ///< Made exactly orthonormal; may be off by 1e-3.
    VoxelType type = VoxelType::kF32;
    std::vector<ChannelInput> channels = {};
};

inline constexpr int kMaxVolumeSide = 1 << 15;
inline constexpr std::size_t kMaxVolumeBytes = std::size_t{1} << 40;  ///< Of one channel.
inline constexpr std::size_t kMaxChannels = 256;

/// A volume without channels, of an input that needs no voxels yet; names become UTF-8 in it.
///
/// Errors: as buildVolume(), but for voxels.
Result<Volume> buildGrid(VolumeInput& input);

/// How many of a channel's voxels are NaN.
///
/// Errors: kInvalidArgument (all are, or one is infinite, which is named).
Result<std::uint64_t> countWithoutValue(const Volume& volume, const std::string& channel,
                                        std::span<const std::byte> voxels);

/// The range of a channel with these bricks, one of which has a value.
Range rangeOf(std::span<const glm::vec2> bricks);

/// Checks voxels, finds their ranges and bricks, and builds the pyramid of a large volume;
/// `pyramidProgress` (may be empty) is told the share of the last that is done.
///
/// Errors: kInvalidArgument (a size below 1, spacing that is not > 0, a place or direction that is
/// not finite, a voxel that is infinite, a channel of NaN alone, a wrong number of bytes, no
/// channel, a doubled or empty channel name), kUnsupported (axes that are not perpendicular),
/// kLimitExceeded (size or channels).
Result<Volume> buildVolume(VolumeInput input,
                           const std::function<void(double)>& pyramidProgress = {});

}  // namespace volcast::data
