#include "renderer/gpu/buffer.h"

#include <string>

namespace volcast::gpu {
namespace {

struct TexelLayout {
    GLenum internal = GL_NONE;
    std::size_t bytes = 0;
};

TexelLayout layoutOf(TexelFormat format) {
    switch (format) {
        case TexelFormat::kNone: return {};
        case TexelFormat::kR32F: return {.internal = GL_R32F, .bytes = 4};
        case TexelFormat::kRg32F: return {.internal = GL_RG32F, .bytes = 8};
        case TexelFormat::kRgba32F: return {.internal = GL_RGBA32F, .bytes = 16};
        case TexelFormat::kR32I: return {.internal = GL_R32I, .bytes = 4};
        case TexelFormat::kRg32I: return {.internal = GL_RG32I, .bytes = 8};
        case TexelFormat::kRgba32I: return {.internal = GL_RGBA32I, .bytes = 16};
        case TexelFormat::kR32U: return {.internal = GL_R32UI, .bytes = 4};
    }
    return {};
}

Result<void> validate(const Device& device, const BufferDesc& desc, std::size_t initialBytes) {
    const std::string label = desc.label;
    if (desc.bytes == 0 || initialBytes > desc.bytes) {
        return fail(ErrorCode::kInvalidArgument,
                    label + ": a buffer of " + std::to_string(desc.bytes) +
                        " bytes cannot be made from " + std::to_string(initialBytes));
    }
    if (desc.texels == TexelFormat::kNone) return {};
    const auto limit = static_cast<std::size_t>(device.limits().texelBufferTexels);
    const std::size_t texels = desc.bytes / layoutOf(desc.texels).bytes;
    if (texels > limit) {
        return fail(ErrorCode::kLimitExceeded, label + ": " + std::to_string(texels) +
                                                   " texels, this GPU addresses at most " +
                                                   std::to_string(limit));
    }
    return {};
}

}  // namespace

Result<Buffer> Buffer::create(Device& device, const BufferDesc& desc,
                              std::span<const std::byte> initial) {
    assert(device.onDeviceThread());
    const Result<void> valid = validate(device, desc, initial.size());
    if (!valid) return valid.error();
    Buffer buffer;
    buffer.device_ = &device;
    buffer.bytes_ = desc.bytes;
    GLuint name = 0;
    glCreateBuffers(1, &name);
    buffer.handle_ = BufferHandle{device, name};
    const bool whole = initial.size() == desc.bytes;
    glNamedBufferStorage(name, static_cast<GLsizeiptr>(desc.bytes),
                         whole ? initial.data() : nullptr,
                         desc.updatable || !whole ? GL_DYNAMIC_STORAGE_BIT : 0);
    glObjectLabel(GL_BUFFER, name, -1, desc.label);
    const Result<void> stored = device.check(desc.label);
    if (!stored) return stored.error();
    if (whole) {
        ++device.counters().bufferUploads;
        device.counters().uploadedBytes += initial.size();
    } else if (!initial.empty()) {
        buffer.update(0, initial);
    }
    if (desc.texels != TexelFormat::kNone) {
        glCreateTextures(GL_TEXTURE_BUFFER, 1, &name);
        buffer.view_ = TextureHandle{device, name};
        glTextureBuffer(name, layoutOf(desc.texels).internal, buffer.handle_.name());
        glObjectLabel(GL_TEXTURE, name, -1, desc.label);
        const Result<void> viewed = device.check(desc.label);
        if (!viewed) return viewed.error();
    }
    return buffer;
}

void Buffer::update(std::size_t offset, std::span<const std::byte> bytes) {
    assert(device_ != nullptr && device_->onDeviceThread());
    assert(offset + bytes.size() <= bytes_);
    if (bytes.empty()) return;
    glNamedBufferSubData(handle_.name(), static_cast<GLintptr>(offset),
                         static_cast<GLsizeiptr>(bytes.size()), bytes.data());
    ++device_->counters().bufferUploads;
    device_->counters().uploadedBytes += bytes.size();
}

void Buffer::bindUniform(unsigned binding) const noexcept {
    glBindBufferBase(GL_UNIFORM_BUFFER, binding, handle_.name());
}

void Buffer::bindUniform(unsigned binding, std::size_t offset, std::size_t bytes) const noexcept {
    glBindBufferRange(GL_UNIFORM_BUFFER, binding, handle_.name(), static_cast<GLintptr>(offset),
                      static_cast<GLsizeiptr>(bytes));
}

void Buffer::bindStorage(unsigned binding) const noexcept {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, handle_.name());
}

void Buffer::bindTexels(unsigned unit) const noexcept {
    glBindTextureUnit(unit, view_.name());
}

}  // namespace volcast::gpu
