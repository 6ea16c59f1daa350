#include "renderer/gpu/timer.h"

#include <cassert>

#include <epoxy/gl.h>

namespace volcast::gpu {

Result<double> Timer::lapMs() {
    if (!device_->alive()) return fail(ErrorCode::kDeviceLost, "the device was given up");
    assert(device_->onDeviceThread());
    constexpr GLuint64 kSliceNs = 1'000'000'000;
    GLsync fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    GLenum status = GL_TIMEOUT_EXPIRED;
    // No limit of its own: whoever supervises this process has the deadline.
    while (status == GL_TIMEOUT_EXPIRED) {
        status = glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, kSliceNs);
        if (device_->resetStatus() != ResetStatus::kNone) status = GL_WAIT_FAILED;
    }
    glDeleteSync(fence);
    if (status == GL_WAIT_FAILED) {
        return fail(ErrorCode::kDeviceLost, "the GPU was reset while it drew");
    }
    const auto now = std::chrono::steady_clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - start_).count();
    start_ = now;
    return ms;
}

}  // namespace volcast::gpu
