#pragma once

#include "renderer/gpu/target.h"
#include "renderer/gpu/texture2d.h"

namespace volcast::gpu {

/// One picture of 4 floats a pixel that a pass draws into and a later one reads.
class Canvas {
public:
    /// Makes room for pictures of `size`; what was drawn is lost where that changes.
    ///
    /// Errors: kLimitExceeded (size), kOutOfGpuMemory; the canvas then stays as it was.
    Result<void> fit(Device& device, glm::ivec2 size, const char* label);

    [[nodiscard]] const Target& target() const noexcept { return target_; }
    void bind(unsigned unit) const noexcept { colour_.bind(unit); }

private:
    Texture2D colour_;
    Target target_;
};

}  // namespace volcast::gpu
