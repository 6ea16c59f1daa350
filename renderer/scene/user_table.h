#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "renderer/gpu/buffer.h"

namespace volcast::scene {

/// The controls of a layer's code on the GPU. A change of a control is one upload into the same
/// buffer while it fits.
class UserTable {
public:
    /// Uploads `texels` unless they are there already.
    ///
    /// Errors: kOutOfGpuMemory; the table then stays as it was.
    Result<void> set(gpu::Device& device, const std::vector<glm::vec4>& texels);

    void bind() const noexcept;

private:
    std::vector<glm::vec4> texels_;
    gpu::Buffer buffer_;
};

}  // namespace volcast::scene
