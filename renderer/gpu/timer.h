#pragma once

#include <chrono>

#include "renderer/base/result.h"
#include "renderer/gpu/device.h"

namespace volcast::gpu {

/// Wall time until the GPU has done what was asked since start. Timer queries are not used:
/// llvmpipe's are wrong by a factor of seven.
class Timer {
public:
    explicit Timer(Device& device) noexcept
        : device_{&device}, start_{std::chrono::steady_clock::now()} {}

    /// Waits on a fence; milliseconds since construction or the last call.
    ///
    /// Errors: kDeviceLost (the fence failed).
    Result<double> lapMs();

private:
    Device* device_;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace volcast::gpu
