#include "renderer/volume/bricked_layer.h"

#include <algorithm>
#include <bit>
#include <vector>

#include "renderer/shading/shared.h"
#include "renderer/volume/brick_voxels.h"

namespace volcast::volume {

namespace {

glm::ivec4 texelOf(const BrickNode& node) {
    return {node.firstChild,
            node.need == Need::kHidden ? shading::shared::kHidden : shading::shared::kNotLoaded,
            std::bit_cast<int>(node.range.x), std::bit_cast<int>(node.range.y)};
}

}  // namespace

Result<BrickReport> BrickedLayer::prepare(gpu::Device& device, BrickPool& pool,
                                          std::uint64_t number, const data::Volume& volume,
                                          const data::Channel& channel, const BrickView& view,
                                          std::size_t capacity, std::size_t& loadBytes) {
    const BrickTree tree = chooseBricks(volume, channel, view, capacity);
    BrickReport report{.needed = tree.order.size(),
                       .hidden = tree.hidden,
                       .outside = tree.outside,
                       .finest = tree.finest,
                       .coarsest = tree.coarsest,
                       .limited = tree.limited};
    std::vector<glm::ivec4> texels;
    texels.reserve(tree.nodes.size());
    for (const BrickNode& node : tree.nodes) texels.push_back(texelOf(node));
    // All that is there is used before anything is loaded, which would take the place of it.
    std::vector<int> missing;
    const auto place = [&](int node, int slot) {
        texels[static_cast<std::size_t>(node)].y = slot;
        ++report.resident;
    };
    const auto brickOf = [&](int node) { return tree.nodes[static_cast<std::size_t>(node)].brick; };
    for (const int node : tree.order) {
        if (const auto slot = pool.use({.channel = number, .brick = brickOf(node)})) {
            place(node, *slot);
        } else {
            missing.push_back(node);
        }
    }
    std::vector<std::byte> voxels;
    for (const int node : missing) {
        const std::size_t bytes = BrickPool::brickBytes(volume.type);
        if (node != 0 && loadBytes < bytes) break;  // Without the root there is nothing to show.
        copyBrick(volume, channel, brickOf(node), voxels);
        const auto slot = pool.load({.channel = number, .brick = brickOf(node)}, voxels);
        if (!slot) return slot.error();
        place(node, *slot);
        report.loadedBytes += bytes;
        loadBytes -= std::min(bytes, loadBytes);
    }
    const auto bytes = std::as_bytes(std::span{texels});
    if (!tree_.valid() || tree_.bytes() < bytes.size()) {
        auto made = gpu::Buffer::create(device,
                                        {.bytes = 2 * bytes.size(),  // Trees grow and shrink.
                                         .updatable = true,
                                         .texels = gpu::TexelFormat::kRgba32I,
                                         .label = "brick tree"},
                                        bytes);
        if (!made) return made.error();
        tree_ = std::move(*made);
    } else {
        tree_.update(0, bytes);
    }
    return report;
}

void BrickedLayer::bind(const BrickPool& pool) const noexcept {
    pool.bind(shading::shared::kVoxelUnit);
    tree_.bindTexels(shading::shared::kBrickUnit);
}

}  // namespace volcast::volume
