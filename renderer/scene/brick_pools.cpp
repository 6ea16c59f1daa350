#include "renderer/scene/brick_pools.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

namespace volcast::scene {

bool BrickPools::mine() const {
    return !turn_ || turn_->view == view_ || frame_ - turn_->frame > kPatience;
}

void BrickPools::begin(std::uint64_t view, std::uint64_t frame,
                       std::map<data::VoxelType, int> layers, bool complete) {
    view_ = view;
    frame_ = frame;
    layers_ = std::move(layers);
    // Of types that this picture needs pools are made as it is prepared.
    std::erase_if(pools_, [this](const auto& entry) {
        return !layers_.contains(entry.first) && frame_ - entry.second.frame > kPatience;
    });
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
    std::set<data::VoxelType> types;
    for (const auto& [each, count] : layers_) types.insert(each);
    for (const auto& [each, pool] : pools_) types.insert(each);
    types.insert(type);
    const std::size_t share = limits_.volumeBytes / types.size();
    std::erase_if(pools_, [share](const auto& entry) { return entry.second.bytes > share; });
    auto found = pools_.find(type);
    if (found != pools_.end() && found->second.bytes < share) {
        pools_.erase(found);
        found = pools_.end();
    }
    if (found == pools_.end()) {
        auto made = volume::BrickPool::create(device, type, share);
        if (!made) return made.error();
        found = pools_.emplace(type, Pool{.bricks = std::move(*made), .bytes = share}).first;
    }
    found->second.frame = frame_;
    return &found->second.bricks;
}

std::size_t BrickPools::capacity(data::VoxelType type) const {
    const auto layers = layers_.find(type);
    const auto count = static_cast<std::size_t>(layers == layers_.end() ? 1 : layers->second);
    return std::max<std::size_t>(pools_.at(type).bricks.capacity() / count, 1);
}

}  // namespace volcast::scene
