#include "renderer/volume/brick_pool.h"

#include <algorithm>
#include <cmath>

#include "renderer/shading/shared.h"
#include "renderer/volume/brick_voxels.h"

namespace volcast::volume {

namespace {

gpu::VoxelFormat formatOf(data::VoxelType type) {
    switch (data::voxelBytes(type)) {
        case 1: return gpu::VoxelFormat::kR8U;
        case 2: return gpu::VoxelFormat::kR16U;
        default: return gpu::VoxelFormat::kR32U;
    }
}

/// A box of at most `count` bricks, as near to a cube as the limit of a side allows.
glm::ivec3 layout(std::size_t count, int mostASide) {
    const auto most = static_cast<std::size_t>(mostASide);
    const std::size_t x =
        std::min(most, static_cast<std::size_t>(std::cbrt(static_cast<double>(count))));
    const std::size_t slab = count / x;
    const std::size_t y =
        std::min(most, static_cast<std::size_t>(std::sqrt(static_cast<double>(slab))));
    const std::size_t z = std::min(most, count / (x * y));
    return {static_cast<int>(x), static_cast<int>(y), static_cast<int>(z)};
}

int packed(const glm::ivec3& place) {
    constexpr int kBits = shading::shared::kSlotBits;
    return place.x | place.y << kBits | place.z << (2 * kBits);
}

}  // namespace

std::size_t BrickPool::brickBytes(data::VoxelType type) noexcept {
    const auto side = static_cast<std::size_t>(pooledBrickSide());
    return side * side * side * data::voxelBytes(type);
}

Result<BrickPool> BrickPool::create(gpu::Device& device, data::VoxelType type,
                                    std::size_t budgetBytes) {
    const int side = pooledBrickSide();
    const int mostASide =
        std::min(device.limits().texture3DSide / side, (1 << shading::shared::kSlotBits) - 1);
    const glm::ivec3 bricks =
        layout(std::max(budgetBytes / brickBytes(type), kLeastBricks), mostASide);
    auto atlas = gpu::Texture3D::create(
        device, {.size = side * bricks, .format = formatOf(type), .label = "brick pool"});
    if (!atlas) return atlas.error();
    BrickPool pool;
    pool.atlas_ = std::move(*atlas);
    for (int z = 0; z < bricks.z; ++z) {
        for (int y = 0; y < bricks.y; ++y) {
            for (int x = 0; x < bricks.x; ++x) {
                pool.slots_.push_back({.key = std::nullopt, .place = {x, y, z}});
            }
        }
    }
    pool.capacity_ = pool.slots_.size();
    return pool;
}

std::optional<int> BrickPool::use(const Key& key) {
    const auto found = found_.find(key);
    if (found == found_.end()) return std::nullopt;
    slots_.splice(slots_.end(), slots_, found->second);
    return packed(found->second->place);
}

Result<int> BrickPool::load(const Key& key, std::span<const std::byte> voxels) {
    const auto slot = slots_.begin();
    if (slot->key) found_.erase(*slot->key);
    slot->key.reset();
    const int side = pooledBrickSide();
    const auto uploaded = atlas_.upload(side * slot->place, glm::ivec3(side), voxels);
    if (!uploaded) return uploaded.error();
    slot->key = key;
    found_[key] = slot;
    slots_.splice(slots_.end(), slots_, slot);
    return packed(slot->place);
}

}  // namespace volcast::volume
