#include "renderer/scene/picture.h"

#include <array>

namespace volcast::scene {
namespace {

using gpu::PixelFormat;

Result<void> make(gpu::Device& device, gpu::Texture2D& texture, PictureSize size,
                  PixelFormat format, const char* label) {
    Result<gpu::Texture2D> made =
        gpu::Texture2D::create(device, {.size = size, .format = format, .label = label});
    if (!made) return made.error();
    texture = std::move(*made);
    return {};
}

Result<void> make(gpu::Device& device, gpu::Target& target, const char* label,
                  std::span<const gpu::Texture2D* const> colours,
                  const gpu::Texture2D* depth = nullptr) {
    Result<gpu::Target> made = gpu::Target::create(device, label, colours, depth);
    if (!made) return made.error();
    target = std::move(*made);
    return {};
}

Result<void> makeOpaque(gpu::Device& device, Picture& picture) {
    Result<void> made =
        make(device, picture.distance, picture.size, PixelFormat::kR32F, "opaque distance");
    if (made) made = make(device, picture.depth, picture.size, PixelFormat::kDepth32F, "depth");
    if (!made) return made;
    const std::array colours{static_cast<const gpu::Texture2D*>(&picture.layers),
                             static_cast<const gpu::Texture2D*>(&picture.distance)};
    return make(device, picture.opaquePass, "opaque layers", colours, &picture.depth);
}

}  // namespace

Result<std::unique_ptr<Picture>> Picture::create(gpu::Device& device, PictureSize size,
                                                 bool withOpaque) {
    auto picture = std::make_unique<Picture>();
    picture->size = size;
    picture->hasOpaque = withOpaque;
    Result<void> made = make(device, picture->layers, size, PixelFormat::kRgba32F, "layers");
    if (made) made = make(device, picture->resolved, size, PixelFormat::kRgba8, "picture");
    if (!made) return made.error();
    const std::array layers{static_cast<const gpu::Texture2D*>(&picture->layers)};
    const std::array resolved{static_cast<const gpu::Texture2D*>(&picture->resolved)};
    made = make(device, picture->transparentPass, "transparent layers", layers);
    if (made) made = make(device, picture->resolvePass, "resolve", resolved);
    if (made && withOpaque) made = makeOpaque(device, *picture);
    if (!made) return made.error();
    return picture;
}

}  // namespace volcast::scene
