#include "renderer/scene/texel_buffer.h"

#include <utility>

namespace volcast::scene {

Result<void> refill(gpu::Device& device, gpu::Buffer& buffer, std::span<const glm::vec4> texels,
                    const char* label) {
    const auto bytes = std::as_bytes(texels);
    if (buffer.bytes() >= bytes.size()) {
        buffer.update(0, bytes);
        return {};
    }
    Result<gpu::Buffer> larger = gpu::Buffer::create(device,
                                                     {.bytes = bytes.size() * 2,
                                                      .updatable = true,
                                                      .texels = gpu::TexelFormat::kRgba32F,
                                                      .label = label},
                                                     bytes);
    if (!larger) return larger.error();
    buffer = std::move(*larger);
    return {};
}

}  // namespace volcast::scene
