#include "renderer/gpu/texture2d.h"

#include <string>

namespace volcast::gpu {
namespace {

GLenum internalFormat(PixelFormat format) {
    switch (format) {
        case PixelFormat::kRgba8: return GL_RGBA8;
        case PixelFormat::kR32F: return GL_R32F;
        case PixelFormat::kRg32F: return GL_RG32F;
        case PixelFormat::kRgba32F: return GL_RGBA32F;
        case PixelFormat::kR32I: return GL_R32I;
        case PixelFormat::kR32U: return GL_R32UI;
        case PixelFormat::kDepth32F: return GL_DEPTH_COMPONENT32F;
    }
    return GL_NONE;
}

}  // namespace

std::size_t pixelBytes(PixelFormat format) noexcept {
    switch (format) {
        case PixelFormat::kRgba32F: return 16;
        case PixelFormat::kRg32F: return 8;
        default: return 4;
    }
}

Result<Texture2D> Texture2D::create(Device& device, const Texture2DDesc& desc) {
    assert(device.onDeviceThread());
    const int limit = device.limits().textureSide;
    if (desc.size.x < 1 || desc.size.y < 1 || desc.size.x > limit || desc.size.y > limit) {
        return fail(ErrorCode::kLimitExceeded,
                    std::string{desc.label} + ": " + std::to_string(desc.size.x) + " x " +
                        std::to_string(desc.size.y) + " pixels, this GPU allows 1 to " +
                        std::to_string(limit) + " on a side");
    }
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &name);
    Texture2D texture;
    texture.handle_ = TextureHandle{device, name};
    texture.size_ = desc.size;
    texture.format_ = desc.format;
    glTextureStorage2D(name, 1, internalFormat(desc.format), desc.size.x, desc.size.y);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glObjectLabel(GL_TEXTURE, name, -1, desc.label);
    const Result<void> made = device.check(desc.label);
    if (!made) return made.error();
    return texture;
}

void Texture2D::bindImage(unsigned unit) const noexcept {
    glBindImageTexture(unit, handle_.name(), 0, GL_FALSE, 0, GL_READ_WRITE,
                       internalFormat(format_));
}

}  // namespace volcast::gpu
