#include "renderer/volume/voxel_blocks.h"

#include <cstring>

namespace volcast::volume {
namespace {

/// The voxels of one channel, by grid point; beyond the last point of an axis its value goes on.
template <class T>
class Grid {
public:
    Grid(glm::ivec3 size, std::span<const std::byte> voxels) : last_{size - 1}, voxels_{voxels} {}

    T operator()(int x, int y, int z) const {
        const glm::ivec3 at = glm::min(glm::ivec3(x, y, z), last_);
        const std::size_t index =
            (static_cast<std::size_t>(at.z) * (last_.y + 1) + at.y) * (last_.x + 1) + at.x;
        T value;
        std::memcpy(&value, voxels_.data() + index * sizeof(T), sizeof(T));
        return value;
    }

private:
    glm::ivec3 last_;
    std::span<const std::byte> voxels_;
};

/// Calls texel(x, y, z) for all grid points of a layer of blocks, in the order of its texels.
template <class Texel>
void fill(const BlockLayout& layout, int layer, std::vector<std::uint32_t>& packed, Texel texel) {
    packed.resize(layout.layer());
    std::size_t next = 0;
    for (int block = 0; block < layout.blocks.x * layout.blocks.y; ++block) {
        const glm::ivec3 low{block % layout.blocks.x * 4, block / layout.blocks.x * 4, layer * 4};
        for (int i = 0; i < 64; ++i) {
            packed[next++] = texel(low.x + (i & 3), low.y + (i >> 2 & 3), low.z + (i >> 4));
        }
    }
}

void packFaces(const BlockLayout& layout, const Grid<std::uint8_t>& grid, int layer,
               std::vector<std::uint32_t>& packed) {
    fill(layout, layer, packed, [&grid](int x, int y, int z) {
        return static_cast<std::uint32_t>(grid(x, y, z) | grid(x + 1, y, z) << 8 |
                                          grid(x, y + 1, z) << 16) |
               static_cast<std::uint32_t>(grid(x + 1, y + 1, z)) << 24;
    });
}

void packPairs(const BlockLayout& layout, const Grid<std::uint16_t>& grid, int layer,
               std::vector<std::uint32_t>& packed) {
    fill(layout, layer, packed, [&grid](int x, int y, int z) {
        return grid(x, y, z) | static_cast<std::uint32_t>(grid(x + 1, y, z)) << 16;
    });
}

}  // namespace

VoxelTexels texelsFor(data::VoxelType type) noexcept {
    switch (type) {
        case data::VoxelType::kU8: return VoxelTexels::kFaces8;
        case data::VoxelType::kU16: return VoxelTexels::kPairsU16;
        case data::VoxelType::kI16: return VoxelTexels::kPairsI16;
        case data::VoxelType::kF32: break;
    }
    return VoxelTexels::kTexture;
}

void packLayer(const BlockLayout& layout, VoxelTexels texels, std::span<const std::byte> voxels,
               int layer, std::vector<std::uint32_t>& packed) {
    if (texels == VoxelTexels::kFaces8) {
        packFaces(layout, Grid<std::uint8_t>{layout.size, voxels}, layer, packed);
    } else {
        packPairs(layout, Grid<std::uint16_t>{layout.size, voxels}, layer, packed);
    }
}

}  // namespace volcast::volume
