#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <optional>
#include <span>
#include <tuple>

#include "renderer/base/result.h"
#include "renderer/data/volume.h"
#include "renderer/gpu/texture3d.h"
#include "renderer/volume/brick_tree.h"

namespace volcast::volume {

/// Bricks of any number of channels of one voxel type in one texture, in that type: exact. Each has
/// a border, so that no interpolation reads another brick. Those used longest ago make room.
class BrickPool {
public:
    /// As many bricks as `budgetBytes` hold and the device's largest texture allows, at least
    /// kLeastBricks.
    ///
    /// Errors: kOutOfGpuMemory.
    static Result<BrickPool> create(gpu::Device& device, data::VoxelType type,
                                    std::size_t budgetBytes);
    static constexpr std::size_t kLeastBricks = 64;

    /// Bytes of one brick with its border.
    [[nodiscard]] static std::size_t brickBytes(data::VoxelType type) noexcept;

    /// Says which channel a brick is of; equal numbers are the same voxels.
    struct Key {
        std::uint64_t channel = 0;
        Brick brick;
        friend bool operator<(const Key& a, const Key& b) {
            const auto tie = [](const Key& k) {
                return std::tuple{k.channel, k.brick.level, k.brick.place.x, k.brick.place.y,
                                  k.brick.place.z};
            };
            return tie(a) < tie(b);
        }
    };

    /// The slot of a brick, as in shared/brick_pool.glsl; none: it is not there. It is the one used
    /// last from now on.
    std::optional<int> use(const Key& key);
    /// Puts a brick where the one was that was used longest ago, and returns its slot.
    ///
    /// Errors: kOutOfGpuMemory.
    Result<int> load(const Key& key, std::span<const std::byte> voxels);

    [[nodiscard]] std::size_t capacity() const noexcept { return capacity_; }
    void bind(unsigned unit) const noexcept { atlas_.bind(unit); }

private:
    struct Slot {
        std::optional<Key> key;
        glm::ivec3 place{0};
    };
    gpu::Texture3D atlas_;
    std::size_t capacity_ = 0;
    std::list<Slot> slots_;  ///< Used longest ago first.
    std::map<Key, std::list<Slot>::iterator> found_;
};

}  // namespace volcast::volume
