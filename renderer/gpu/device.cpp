#include "renderer/gpu/device.h"

#include <cassert>

#include <epoxy/gl.h>

#include "renderer/gpu/egl.h"

namespace volcast::gpu {
namespace {

constexpr int kMajor = 4, kMinor = 5;

std::string text(GLenum key) {
    const auto* value = reinterpret_cast<const char*>(glGetString(key));
    return value == nullptr ? std::string{} : std::string{value};
}

std::string text(EGLDisplay display, EGLint key) {
    const char* value = eglQueryString(display, key);
    return value == nullptr ? std::string{} : std::string{value};
}

int integer(GLenum key) {
    GLint value = 0;
    glGetIntegerv(key, &value);
    return value;
}

EGLContext createContext(EGLDisplay display, bool robust) {
    const EGLint plain[] = {EGL_CONTEXT_MAJOR_VERSION,
                            kMajor,
                            EGL_CONTEXT_MINOR_VERSION,
                            kMinor,
                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                            EGL_NONE};
    const EGLint guarded[] = {EGL_CONTEXT_MAJOR_VERSION,
                              kMajor,
                              EGL_CONTEXT_MINOR_VERSION,
                              kMinor,
                              EGL_CONTEXT_OPENGL_PROFILE_MASK,
                              EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                              EGL_CONTEXT_OPENGL_ROBUST_ACCESS,
                              EGL_TRUE,
                              EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                              EGL_LOSE_CONTEXT_ON_RESET,
                              EGL_NONE};
    return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, robust ? guarded : plain);
}

}  // namespace

Result<std::unique_ptr<Device>> Device::create(const DeviceDesc& desc) {
    std::unique_ptr<Device> device{new Device};
    const Result<void> opened = device->open(desc);
    if (!opened) return opened.error();
    return device;
}

Result<void> Device::open(const DeviceDesc& desc) {
    Result<OpenDisplay> opened = openDisplay(desc.gpu);
    if (!opened) return opened.error();
    display_ = opened->display;
    const Result<void> made = makeContext();
    if (!made) return fail(made.error().code, opened->name + ": " + made.error().message);
    describe(opened->name);
    glCreateVertexArrays(1, &vertexArray_);
    glBindVertexArray(vertexArray_);
    glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    return check("opening the device");
}

Result<void> Device::makeContext() {
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) {
        return fail(ErrorCode::kUnsupported, "EGL offers no OpenGL");
    }
    for (const bool robust : {true, false}) {
        context_ = createContext(display_, robust);
        robust_ = robust;
        if (context_ != EGL_NO_CONTEXT) break;
    }
    if (context_ == EGL_NO_CONTEXT) {
        return fail(ErrorCode::kUnsupported, "no OpenGL 4.5 core context can be made here");
    }
    if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
        return fail(ErrorCode::kUnsupported, "a context without a surface cannot be made current");
    }
    thread_ = std::this_thread::get_id();
    alive_ = true;
    return {};
}

void Device::describe(const std::string& platform) {
    info_.platform = platform;
    info_.eglVendor = text(display_, EGL_VENDOR);
    info_.eglVersion = text(display_, EGL_VERSION);
    info_.glVendor = text(GL_VENDOR);
    info_.glRenderer = text(GL_RENDERER);
    info_.glVersion = text(GL_VERSION);
    info_.glslVersion = text(GL_SHADING_LANGUAGE_VERSION);
    info_.robust = robust_;
    for (const char* name : {"llvmpipe", "softpipe", "SWR", "SwiftShader"}) {
        info_.software = info_.software || info_.glRenderer.find(name) != std::string::npos;
    }
    info_.limits = {.textureSide = integer(GL_MAX_TEXTURE_SIZE),
                    .texture3DSide = integer(GL_MAX_3D_TEXTURE_SIZE),
                    .texelBufferTexels = integer(GL_MAX_TEXTURE_BUFFER_SIZE),
                    .uniformBlockBytes = integer(GL_MAX_UNIFORM_BLOCK_SIZE),
                    .storageBlockBytes = integer(GL_MAX_SHADER_STORAGE_BLOCK_SIZE),
                    .viewportSide = integer(GL_MAX_VIEWPORT_DIMS)};
}

Device::~Device() {
    if (context_ == EGL_NO_CONTEXT) return;
    if (alive_) {
        assert(onDeviceThread());
        glDeleteVertexArrays(1, &vertexArray_);
        abandon();
    }
    eglDestroyContext(display_, context_);
}

void Device::abandon() noexcept {
    if (!alive_) return;
    alive_ = false;
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

ResetStatus Device::resetStatus() const noexcept {
    if (!alive_ || !robust_) return ResetStatus::kNone;
    switch (glGetGraphicsResetStatus()) {
        case GL_GUILTY_CONTEXT_RESET: return ResetStatus::kGuilty;
        case GL_INNOCENT_CONTEXT_RESET: return ResetStatus::kInnocent;
        case GL_UNKNOWN_CONTEXT_RESET: return ResetStatus::kUnknown;
        default: return ResetStatus::kNone;
    }
}

Result<void> Device::check(const std::string& what) {
    if (!alive_) return fail(ErrorCode::kDeviceLost, what + ": the device was given up");
    assert(onDeviceThread());
    GLenum first = GL_NO_ERROR;
    // Bounded, because a lost context may repeat its error for ever.
    for (int i = 0; i < 16; ++i) {
        const GLenum error = glGetError();
        if (error == GL_NO_ERROR) break;
        if (first == GL_NO_ERROR) first = error;
    }
    if (resetStatus() != ResetStatus::kNone || first == GL_CONTEXT_LOST) {
        return fail(ErrorCode::kDeviceLost, what + ": the GPU was reset");
    }
    if (first == GL_NO_ERROR) return {};
    if (first == GL_OUT_OF_MEMORY) {
        return fail(ErrorCode::kOutOfGpuMemory, what + ": out of GPU memory");
    }
    return fail(ErrorCode::kUnsupported, what + ": GL error " + std::to_string(first));
}

void Device::draw(Primitive primitive, int vertices, int instances) {
    assert(onDeviceThread());
    ++counters_.drawCalls;
    glDrawArraysInstanced(primitive == Primitive::kPoints ? GL_POINTS : GL_TRIANGLES, 0, vertices,
                          instances);
}

void Device::dispatch(unsigned groupsX, unsigned groupsY, unsigned groupsZ) {
    assert(onDeviceThread());
    ++counters_.drawCalls;
    glDispatchCompute(groupsX, groupsY, groupsZ);
}

void Device::finish() {
    if (!alive_) return;
    glFinish();
}

}  // namespace volcast::gpu
