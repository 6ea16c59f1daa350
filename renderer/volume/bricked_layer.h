#pragma once

#include <cstddef>
#include <cstdint>

#include "renderer/base/result.h"
#include "renderer/data/volume.h"
#include "renderer/gpu/buffer.h"
#include "renderer/volume/brick_pool.h"
#include "renderer/volume/brick_tree.h"

namespace volcast::volume {

/// What a picture asked of the pool for one layer.
struct BrickReport {
    std::size_t needed = 0;
    std::size_t resident = 0;      ///< Of those needed.
    std::size_t hidden = 0;        ///< Passed over: no value in their range shows.
    std::size_t outside = 0;       ///< Passed over: no ray gets there.
    int finest = 0, coarsest = 0;  ///< Levels of what is drawn once all is there.
    bool limited = false;          ///< Coarser than asked for: the pool has no more room.
    std::size_t loadedBytes = 0;   ///< For this picture.
    [[nodiscard]] bool ready() const noexcept { return resident == needed; }
};

/// What a picture of one layer may ask of a pool.
struct BrickRequest {
    const data::Volume* volume = nullptr;
    const data::Channel* channel = nullptr;
    std::uint64_t number = 0;  ///< Of the channel; see BrickPool::Key.
    BrickView view;
    std::size_t capacity = 1;  ///< Bricks that it may use.
};

/// A channel as a layer of a view draws it: the tree of its bricks, those that are there.
class BrickedLayer {
public:
    /// Chooses the bricks of a picture and loads those that `pool` lacks, coarse first, until
    /// `loadBytes` are used up (which it lowers); the first always.
    ///
    /// Errors: kOutOfGpuMemory.
    Result<BrickReport> prepare(gpu::Device& device, BrickPool& pool, const BrickRequest& request,
                                std::size_t& loadBytes);

    /// The tree and the voxels of `pool`.
    void bind(const BrickPool& pool) const noexcept;

private:
    gpu::Buffer tree_;
};

}  // namespace volcast::volume
