#pragma once

#include <span>

#include <glm/glm.hpp>

#include "renderer/gpu/buffer.h"

namespace volcast::scene {

/// Fills `buffer` with `texels` from its start: one upload while they fit, else it is made anew
/// with room for as many again, so that adding a few while editing stays an upload.
///
/// Errors: kOutOfGpuMemory; the buffer then stays as it was.
Result<void> refill(gpu::Device& device, gpu::Buffer& buffer, std::span<const glm::vec4> texels,
                    const char* label);

}  // namespace volcast::scene
