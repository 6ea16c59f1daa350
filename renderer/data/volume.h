#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/base/array.h"
#include "renderer/data/field.h"

namespace volcast::data {

enum class VoxelType { kU8, kU16, kI16, kF32 };

/// Bytes of one voxel of one channel.
[[nodiscard]] constexpr std::size_t voxelBytes(VoxelType type) noexcept {
    switch (type) {
        case VoxelType::kU8: return 1;
        case VoxelType::kU16:
        case VoxelType::kI16: return 2;
        case VoxelType::kF32: return 4;
    }
    return 0;
}

/// A channel at a part of its resolution; see Volume::levelSize.
struct ChannelLevel {
    base::Array<std::byte> voxels;  ///< As Channel::voxels, of the level's size.
    /// (min, max) a brick, of the level's own values in it and of all finer ones beneath it;
    /// (infinity, -infinity) where none of them is a number.
    base::Array<glm::vec2> bricks;
};

/// One scalar of a volume. Voxels of float32 may be NaN: there is no value, and nothing is drawn
/// wherever interpolation would use one. All others are finite.
struct Channel {
    std::string name;
    std::string unit;
    Range range;                           ///< Of all that are numbers.
    std::uint64_t voxelsWithoutValue = 0;  ///< NaN, of level 0; never all of them.
    base::Array<std::byte> voxels;      ///< size.x * size.y * size.z values, x fastest, no padding.
    base::Array<glm::vec2> bricks;      ///< As ChannelLevel::bricks, x fastest; see brickGrid().
    std::vector<ChannelLevel> coarser;  ///< Levels 1, 2, ... of the pyramid; none: it has none.
};

/// Voxels on a regular grid. Values sit on grid points: the box spans (size - 1) * spacing.
///
/// World position of grid point i: origin + direction * (spacing * i).
///
/// Large volumes have a pyramid. Along each axis, point j of level k lies on grid point
/// min(2^k j, size - 1) of level 0: every level has the faces of the box, only the last interval of
/// an axis may be shorter than 2^k, and bricks of a level are made of 2 x 2 x 2 of the next finer.
/// A value is the mean of the finer level's trilinear field over a box about its point, reaching to
/// the nearer of its neighbours on each axis (weights 1/4, 1/2, 1/4 where both are as near; on a
/// face nowhere but along the face). A linear field is therefore the same on all levels, without a
/// shift; integers are rounded to the nearest. Voxels without a value are left out of the mean, and
/// a point around which there is no other is NaN.
struct Volume {
    static constexpr int kBrickSize = 16;  ///< Grid intervals a brick, along each axis.

    glm::ivec3 size{1};
    glm::dvec3 spacing{1.0};    ///< World units between grid points; each > 0.
    glm::dvec3 origin{0.0};     ///< World position of the first grid point.
    glm::dmat3 direction{1.0};  ///< Columns are the grid's axes in the world; orthonormal.
    VoxelType type = VoxelType::kF32;
    std::vector<Channel> channels;

    /// Grid points of a level of the pyramid along each axis.
    [[nodiscard]] glm::ivec3 levelSize(int level) const noexcept {
        return ((size - 2 + (1 << level)) >> level) + 1;
    }

    /// Bricks of a level along each axis. Brick b covers the level's grid points
    /// [16 b, min(16 b + 16, points - 1)], both ends included, so that its range bounds every
    /// trilinear value inside it.
    [[nodiscard]] glm::ivec3 brickGrid(int level = 0) const noexcept {
        return glm::max((levelSize(level) - 2) / kBrickSize + 1, glm::ivec3(1));
    }

    /// Levels above level 0, the same for all channels.
    [[nodiscard]] int coarserLevels() const noexcept {
        return channels.empty() ? 0 : static_cast<int>(channels.front().coarser.size());
    }
};

}  // namespace volcast::data
