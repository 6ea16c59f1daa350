#pragma once

#include <cstddef>
#include <vector>

#include "renderer/gpu/buffer.h"
#include "renderer/scene/layer_block.h"

namespace volcast::scene {

/// The uniform blocks of one view: the background, then one LayerBlock a layer. What differs from
/// the last picture goes up in one piece, so that a camera move is one small upload.
class ViewBlocks {
public:
    /// Errors: kOutOfGpuMemory.
    Result<void> set(gpu::Device& device, const glm::vec4& background,
                     const std::vector<LayerBlock>& layers);

    void bindBackground(unsigned binding) const noexcept;
    void bindLayer(std::size_t layer) const noexcept;

private:
    gpu::Buffer buffer_;
    std::vector<std::byte> sent_;
};

}  // namespace volcast::scene
