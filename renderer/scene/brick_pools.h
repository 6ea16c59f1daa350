#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

#include "renderer/base/result.h"
#include "renderer/plan/plan.h"
#include "renderer/volume/brick_pool.h"

namespace volcast::scene {

/// The pools of bricks that all views share, one a voxel type, and whose turn it is to fill them.
/// A budget holds for all of them together.
///
/// One view at a time loads bricks, until its picture is ready: two that need more than there is
/// room for would else take them from each other for ever.
class BrickPools {
public:
    /// A view that has its turn and was not drawn for so many pictures of others loses it.
    static constexpr std::uint64_t kPatience = 16;

    explicit BrickPools(const plan::Limits& limits) : limits_{limits} {}

    /// A picture of `view` begins, the `frame`-th of all; `layers`: how many of it are drawn from
    /// bricks of which voxel type. `complete`: it loads all that it needs.
    void begin(std::uint64_t view, std::uint64_t frame, std::map<data::VoxelType, int> layers,
               bool complete);
    /// It is done: whether all bricks that it needs are there.
    void end(bool ready);
    void dropView(std::uint64_t view);

    /// The pool of a type. All pools together keep to the budget: each has an equal share, and one
    /// that has more is made anew. Those that no view has used for kPatience pictures are dropped.
    ///
    /// Errors: kOutOfGpuMemory.
    Result<volume::BrickPool*> pool(gpu::Device& device, data::VoxelType type);
    /// Bricks of the pool of a type that one layer of this picture may use.
    [[nodiscard]] std::size_t capacity(data::VoxelType type) const;
    /// What this picture may still load, in bytes.
    [[nodiscard]] std::size_t& loadBytes() noexcept { return loadBytes_; }

private:
    struct Pool {
        volume::BrickPool bricks;
        std::size_t bytes = 0;    ///< What it was made with.
        std::uint64_t frame = 0;  ///< Last used in.
    };
    struct Turn {
        std::uint64_t view = 0;
        std::uint64_t frame = 0;  ///< Last drawn in.
    };
    [[nodiscard]] bool mine() const;

    plan::Limits limits_;
    std::map<data::VoxelType, Pool> pools_;
    std::optional<Turn> turn_;
    std::uint64_t view_ = 0;
    std::uint64_t frame_ = 0;
    std::map<data::VoxelType, int> layers_;
    std::size_t loadBytes_ = 0;
};

}  // namespace volcast::scene
