#include "renderer/volume/bricked_layer.h"

#include <algorithm>
#include <bit>
#include <vector>

#include "renderer/scene/scale.h"
#include "renderer/shading/shared.h"
#include "renderer/volume/brick_voxels.h"

namespace volcast::volume {

namespace {

using shading::shared::kRootNode;

glm::ivec4 texelOf(const BrickNode& node, const scene::ScaleFunction& scale) {
    return {node.firstChild == 0 ? 0 : node.firstChild + kRootNode,
            node.need == Need::kHidden ? shading::shared::kHidden : shading::shared::kNotLoaded,
            std::bit_cast<int>(scale.ofPoint(node.range.x)),
            std::bit_cast<int>(scale.ofPoint(node.range.y))};
}

/// The tree as texels, no brick there yet.
std::vector<glm::ivec4> texelsOf(const BrickTree& tree, const data::Channel& channel) {
    const scene::ScaleFunction scale{scene::Scale{}, channel.range};
    std::vector<glm::ivec4> texels;
    texels.reserve(tree.nodes.size() + kRootNode);
    texels.emplace_back(std::bit_cast<int>(-scale.ofPoint(0.0F)), 0, 0, 0);
    for (const BrickNode& node : tree.nodes) texels.push_back(texelOf(node, scale));
    return texels;
}

}  // namespace

Result<BrickReport> BrickedLayer::prepare(gpu::Device& device, BrickPool& pool,
                                          const BrickRequest& request, std::size_t& loadBytes) {
    const BrickTree tree =
        chooseBricks(*request.volume, *request.channel, request.view, request.capacity);
    BrickReport report{.needed = tree.order.size(),
                       .hidden = tree.hidden,
                       .outside = tree.outside,
                       .finest = tree.finest,
                       .coarsest = tree.coarsest,
                       .limited = tree.limited};
    std::vector<glm::ivec4> texels = texelsOf(tree, *request.channel);
    const auto place = [&](int node, int slot) {
        texels[kRootNode + static_cast<std::size_t>(node)].y = slot;
        ++report.resident;
    };
    const auto keyOf = [&](int node) {
        return BrickPool::Key{.channel = request.number,
                              .brick = tree.nodes[static_cast<std::size_t>(node)].brick};
    };
    // All that is there is used before anything is loaded, which could take its place.
    std::vector<int> missing;
    for (const int node : tree.order) {
        if (const auto slot = pool.use(keyOf(node))) {
            place(node, *slot);
        } else {
            missing.push_back(node);
        }
    }
    const std::size_t bytesEach = BrickPool::brickBytes(request.volume->type);
    std::vector<std::byte> voxels;
    for (const int node : missing) {
        if (node != 0 && loadBytes < bytesEach) break;  // Without the root nothing can be shown.
        copyBrick(*request.volume, *request.channel, keyOf(node).brick, voxels);
        const auto slot = pool.load(keyOf(node), voxels);
        if (!slot) return slot.error();
        place(node, *slot);
        report.loadedBytes += bytesEach;
        loadBytes -= std::min(bytesEach, loadBytes);
    }
    const auto bytes = std::as_bytes(std::span{texels});
    if (tree_.valid() && bytes.size() <= tree_.bytes()) {
        tree_.update(0, bytes);
        return report;
    }
    auto made = gpu::Buffer::create(device,
                                    {.bytes = 2 * bytes.size(),  // Trees grow and shrink.
                                     .updatable = true,
                                     .texels = gpu::TexelFormat::kRgba32I,
                                     .label = "brick tree"},
                                    bytes);
    if (!made) return made.error();
    tree_ = std::move(*made);
    return report;
}

void BrickedLayer::bind(const BrickPool& pool) const noexcept {
    pool.bind(shading::shared::kVoxelUnit);
    tree_.bindTexels(shading::shared::kBrickUnit);
}

}  // namespace volcast::volume
