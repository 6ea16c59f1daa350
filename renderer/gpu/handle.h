#pragma once

#include <cassert>
#include <utility>

#include <epoxy/gl.h>

#include "renderer/gpu/device.h"

namespace volcast::gpu {

/// Owns one GL object name; move-only, and empty (name 0) by default or after a move.
///
/// The device must outlive the handle. Once the device is not alive() the name belongs to no
/// context, so the destructor forgets it instead of calling GL.
template <void (*Destroy)(GLuint)>
class Handle {
public:
    Handle() = default;
    Handle(Device& device, GLuint name) noexcept : device_{&device}, name_{name} {}
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    Handle(Handle&& other) noexcept
        : device_{other.device_}, name_{std::exchange(other.name_, 0)} {}
    Handle& operator=(Handle&& other) noexcept {
        Handle taken{std::move(other)};
        std::swap(device_, taken.device_);
        std::swap(name_, taken.name_);
        return *this;
    }
    ~Handle() {
        if (name_ == 0 || !device_->alive()) return;
        assert(device_->onDeviceThread());
        Destroy(name_);
    }
    [[nodiscard]] GLuint name() const noexcept { return name_; }
    [[nodiscard]] explicit operator bool() const noexcept { return name_ != 0; }

private:
    Device* device_ = nullptr;
    GLuint name_ = 0;
};

inline void destroyBuffer(GLuint name) {
    glDeleteBuffers(1, &name);
}
inline void destroyTexture(GLuint name) {
    glDeleteTextures(1, &name);
}
inline void destroyFramebuffer(GLuint name) {
    glDeleteFramebuffers(1, &name);
}
inline void destroyProgram(GLuint name) {
    glDeleteProgram(name);
}
inline void destroyShader(GLuint name) {
    glDeleteShader(name);
}

using BufferHandle = Handle<destroyBuffer>;
using TextureHandle = Handle<destroyTexture>;
using FramebufferHandle = Handle<destroyFramebuffer>;
using ProgramHandle = Handle<destroyProgram>;
using ShaderHandle = Handle<destroyShader>;

}  // namespace volcast::gpu
