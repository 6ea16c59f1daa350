#include "renderer/scene/user_table.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "renderer/shading/shared.h"

namespace volcast::scene {

Result<void> UserTable::set(gpu::Device& device, const std::vector<glm::vec4>& texels) {
    const auto bytes = std::as_bytes(std::span{texels});
    // By their bits: those of integers may be no number, which is never equal.
    const bool same = texels.size() == texels_.size() &&
                      std::memcmp(texels.data(), texels_.data(), bytes.size()) == 0;
    if (buffer_.valid() && same) return {};
    if (buffer_.bytes() >= bytes.size()) {
        buffer_.update(0, bytes);
    } else {
        // Room for a few more points of a transfer function.
        Result<gpu::Buffer> buffer = gpu::Buffer::create(device,
                                                         {.bytes = bytes.size() * 2,
                                                          .updatable = true,
                                                          .texels = gpu::TexelFormat::kRgba32F,
                                                          .label = "controls"},
                                                         bytes);
        if (!buffer) return buffer.error();
        buffer_ = std::move(*buffer);
    }
    texels_ = texels;
    return {};
}

void UserTable::bind() const noexcept {
    buffer_.bindTexels(shading::shared::kMapUnit);
}

}  // namespace volcast::scene
