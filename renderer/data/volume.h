#pragma once

#include <cstddef>
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

/// One scalar of a volume.
struct Channel {
    std::string name;
    std::string unit;
    Range range;
    base::Array<std::byte> voxels;  ///< size.x * size.y * size.z values, x fastest, no padding.
    base::Array<glm::vec2> bricks;  ///< (min, max) a brick, x fastest; see brickGrid().
};

/// Voxels on a regular grid. Values sit on grid points: the box spans (size - 1) * spacing.
///
/// World position of grid point i: origin + direction * (spacing * i).
struct Volume {
    static constexpr int kBrickSize = 16;  ///< Grid intervals a brick, along each axis.

    glm::ivec3 size{1};
    glm::dvec3 spacing{1.0};    ///< World units between grid points; each > 0.
    glm::dvec3 origin{0.0};     ///< World position of the first grid point.
    glm::dmat3 direction{1.0};  ///< Columns are the grid's axes in the world; orthonormal.
    VoxelType type = VoxelType::kF32;
    std::vector<Channel> channels;

    /// Bricks along each axis. Brick b covers grid points [16 b, min(16 b + 16, size - 1)], both
    /// ends included, so that its range bounds every trilinear value inside it.
    [[nodiscard]] glm::ivec3 brickGrid() const noexcept {
        return glm::max((size - 2) / kBrickSize + 1, glm::ivec3(1));
    }
};

}  // namespace volcast::data
