#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/data/volume.h"

namespace volcast::volume {

/// What one texel of a channel holds; the constant kTexels of shaders/volume/voxels.glsl.
enum class VoxelTexels {
    kTexture,   ///< One float, in a 3D texture.
    kFaces8,    ///< 4 bytes: the values at (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1).
    kPairsU16,  ///< 2 words of 16 bits: the values at x and x + 1.
    kPairsI16,  ///< The same, signed.
};

/// Where the texel of a grid point is: blocks of 4^3 points, x fastest in them and among them, so
/// that points that are close are mostly in one line of the cache, whatever direction a ray has.
/// One layer of points more than there are, equal to the last, spares rays a comparison. Numbers of
/// blocks are odd: with powers of two, rays along an axis would meet the same few cache lines.
struct BlockLayout {
    explicit BlockLayout(glm::ivec3 points) : size{points}, blocks{(points + 4) / 4 | 1} {}

    [[nodiscard]] std::size_t texels() const noexcept {
        return std::size_t{64} * blocks.x * blocks.y * blocks.z;
    }
    /// Texels of one layer of blocks across z.
    [[nodiscard]] std::size_t layer() const noexcept {
        return std::size_t{64} * blocks.x * blocks.y;
    }

    glm::ivec3 size;    ///< Grid points.
    glm::ivec3 blocks;  ///< Along each axis.
};

/// What serves voxels of `type` that are drawn as they are. Of floats a buffer would hold one a
/// texel too, and the texture unit interpolates.
VoxelTexels texelsFor(data::VoxelType type) noexcept;

/// The texels of layer `layer` of blocks, in their order; not of kTexture. `voxels`: all of a
/// channel, as in data::Channel.
void packLayer(const BlockLayout& layout, VoxelTexels texels, std::span<const std::byte> voxels,
               int layer, std::vector<std::uint32_t>& packed);

}  // namespace volcast::volume
