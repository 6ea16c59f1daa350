#pragma once

#include <cstddef>
#include <span>

#include <glm/glm.hpp>

#include "renderer/base/result.h"
#include "renderer/gpu/handle.h"

namespace volcast::gpu {

enum class PixelFormat { kRgba8, kR32F, kRg32F, kRgba32F, kR32I, kR32U, kDepth32F };

/// Bytes of one pixel.
[[nodiscard]] std::size_t pixelBytes(PixelFormat format) noexcept;

struct Texture2DDesc {
    glm::ivec2 size{1};  ///< Pixels; each in [1, DeviceLimits::textureSide].
    PixelFormat format = PixelFormat::kRgba32F;
    const char* label = "";
};

/// A picture in GPU memory, drawn into through a Target and read by texelFetch (no filtering).
class Texture2D {
public:
    /// Errors: kLimitExceeded (size), kOutOfGpuMemory.
    static Result<Texture2D> create(Device& device, const Texture2DDesc& desc);

    Texture2D() = default;

    void bind(unsigned unit) const noexcept { glBindTextureUnit(unit, handle_.name()); }
    /// For imageLoad and imageStore; not for kDepth32F.
    void bindImage(unsigned unit) const noexcept;

    [[nodiscard]] glm::ivec2 size() const noexcept { return size_; }
    [[nodiscard]] PixelFormat format() const noexcept { return format_; }
    [[nodiscard]] GLuint name() const noexcept { return handle_.name(); }

private:
    TextureHandle handle_;
    glm::ivec2 size_{0};
    PixelFormat format_ = PixelFormat::kRgba32F;
};

}  // namespace volcast::gpu
