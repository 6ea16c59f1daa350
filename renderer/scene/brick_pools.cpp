#include "renderer/scene/brick_pools.h"

#include <algorithm>
#include <limits>

namespace volcast::scene {

bool BrickPools::mine() const {
    return !turn_ || turn_->view == view_ || frame_ - turn_->frame > kPatience;
}

void BrickPools::begin(std::uint64_t view, std::uint64_t frame, std::size_t layers, bool complete) {
    view_ = view;
    frame_ = frame;
    layers_ = std::max<std::size_t>(layers, 1);
    loadBytes_ = complete ? std::numeric_limits<std::size_t>::max()
                 : mine() ? limits_.pictureBytes
                          : 0;
}

void BrickPools::end(bool ready) {
    if (!mine()) return;
    turn_.reset();
    if (!ready) turn_ = {.view = view_, .frame = frame_};
}

void BrickPools::dropView(std::uint64_t view) {
    if (turn_ && turn_->view == view) turn_.reset();
}

Result<volume::BrickPool*> BrickPools::pool(gpu::Device& device, data::VoxelType type) {
    auto found = pools_.find(type);
    if (found == pools_.end()) {
        std::erase_if(pools_, [this](const auto& entry) { return entry.second.frame != frame_; });
        auto made = volume::BrickPool::create(device, type, limits_.volumeBytes);
        if (!made) return made.error();
        found = pools_.emplace(type, Pool{.bricks = std::move(*made)}).first;
    }
    found->second.frame = frame_;
    return &found->second.bricks;
}

std::size_t BrickPools::capacity(const volume::BrickPool& pool) const noexcept {
    return std::max<std::size_t>(pool.capacity() / layers_, 1);
}

}  // namespace volcast::scene
