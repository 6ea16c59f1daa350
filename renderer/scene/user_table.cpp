#include "renderer/scene/user_table.h"

#include <cstring>

#include "renderer/scene/texel_buffer.h"
#include "renderer/shading/shared.h"

namespace volcast::scene {

Result<void> UserTable::set(gpu::Device& device, const std::vector<glm::vec4>& texels) {
    // By their bits: those of integers may be no number, which is never equal.
    const bool same =
        texels.size() == texels_.size() &&
        std::memcmp(texels.data(), texels_.data(), texels.size() * sizeof(glm::vec4)) == 0;
    if (buffer_.valid() && same) return {};
    Result<void> filled = refill(device, buffer_, texels, "controls");
    if (!filled) return filled;
    texels_ = texels;
    return {};
}

void UserTable::bind() const noexcept {
    buffer_.bindTexels(shading::shared::kMapUnit);
}

}  // namespace volcast::scene
