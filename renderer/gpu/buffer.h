#pragma once

#include <cstddef>
#include <span>

#include "renderer/base/result.h"
#include "renderer/gpu/handle.h"

namespace volcast::gpu {

/// How texelFetch sees a buffer; kNone: it is never read as texels.
enum class TexelFormat { kNone, kR32F, kRg32F, kRgba32F, kR32I, kRg32I, kRgba32I, kR32U };

struct BufferDesc {
    std::size_t bytes = 0;   ///< Capacity, > 0.
    bool updatable = false;  ///< update() may be called.
    TexelFormat texels = TexelFormat::kNone;
    const char* label = "";  ///< Shown by GL debuggers and in error messages.
};

/// A piece of GPU memory of fixed size: uniform block, storage block or texels.
class Buffer {
public:
    /// `initial` is empty (the content is undefined) or fills the buffer from its start.
    ///
    /// Errors: kInvalidArgument (0 bytes, or more initial bytes than fit), kLimitExceeded (more
    /// texels than the device can address), kOutOfGpuMemory.
    static Result<Buffer> create(Device& device, const BufferDesc& desc,
                                 std::span<const std::byte> initial = {});

    Buffer() = default;

    /// Overwrites part of an updatable buffer. Counted as one upload.
    void update(std::size_t offset, std::span<const std::byte> bytes);

    void bindUniform(unsigned binding) const noexcept;
    /// `offset` is a multiple of 256.
    void bindUniform(unsigned binding, std::size_t offset, std::size_t bytes) const noexcept;
    void bindStorage(unsigned binding) const noexcept;
    /// Needs a texel format.
    void bindTexels(unsigned unit) const noexcept;

    [[nodiscard]] std::size_t bytes() const noexcept { return bytes_; }
    [[nodiscard]] bool valid() const noexcept { return static_cast<bool>(handle_); }
    [[nodiscard]] GLuint name() const noexcept { return handle_.name(); }

private:
    Device* device_ = nullptr;
    BufferHandle handle_;
    TextureHandle view_;
    std::size_t bytes_ = 0;
};

}  // namespace volcast::gpu
