#include "renderer/scene/view_blocks.h"

#include <algorithm>
#include <cstring>

namespace volcast::scene {
namespace {

// No device asks for more than 256 bytes of alignment of uniform blocks.
constexpr std::size_t kAlignment = 256;
constexpr std::size_t kStride = (sizeof(LayerBlock) + kAlignment - 1) / kAlignment * kAlignment;
constexpr std::size_t kCapacity = kAlignment + Scene::kMaxLayers * kStride;

std::size_t offsetOf(std::size_t layer) {
    return kAlignment + layer * kStride;
}

}  // namespace

Result<void> ViewBlocks::set(gpu::Device& device, const glm::vec4& background,
                             const std::vector<LayerBlock>& layers) {
    if (!buffer_.valid()) {
        Result<gpu::Buffer> buffer = gpu::Buffer::create(
            device, {.bytes = kCapacity, .updatable = true, .label = "view blocks"});
        if (!buffer) return buffer.error();
        buffer_ = std::move(*buffer);
    }
    std::vector<std::byte> wanted(offsetOf(layers.size()));
    std::memcpy(wanted.data(), &background, sizeof(background));
    for (std::size_t i = 0; i < layers.size(); ++i) {
        std::memcpy(wanted.data() + offsetOf(i), &layers[i], sizeof(LayerBlock));
    }
    // Bytes beyond what was sent before differ from it by definition.
    const std::size_t common = std::min(wanted.size(), sent_.size());
    const auto first = static_cast<std::size_t>(
        std::mismatch(wanted.begin(), wanted.begin() + static_cast<std::ptrdiff_t>(common),
                      sent_.begin())
            .first -
        wanted.begin());
    std::size_t last = wanted.size();
    while (last > first && last <= sent_.size() && wanted[last - 1] == sent_[last - 1]) --last;
    if (last > first) buffer_.update(first, std::span{wanted}.subspan(first, last - first));
    if (wanted.size() < sent_.size()) {
        std::ranges::copy(wanted, sent_.begin());
    } else {
        sent_ = std::move(wanted);
    }
    return {};
}

void ViewBlocks::bindBackground(unsigned binding) const noexcept {
    buffer_.bindUniform(binding, 0, sizeof(glm::vec4));
}

void ViewBlocks::bindLayer(std::size_t layer) const noexcept {
    buffer_.bindUniform(shading::shared::kLayerBinding, offsetOf(layer), sizeof(LayerBlock));
}

}  // namespace volcast::scene
