#include "renderer/gpu/canvas.h"

#include <array>
#include <utility>

namespace volcast::gpu {

Result<void> Canvas::fit(Device& device, glm::ivec2 size, const char* label) {
    if (colour_.size() == size) return {};
    Result<Texture2D> colour =
        Texture2D::create(device, {.size = size, .format = PixelFormat::kRgba32F, .label = label});
    if (!colour) return colour.error();
    const std::array colours{&std::as_const(*colour)};
    Result<Target> target = Target::create(device, label, colours);
    if (!target) return target.error();
    target_ = std::move(*target);
    colour_ = std::move(*colour);
    return {};
}

}  // namespace volcast::gpu
