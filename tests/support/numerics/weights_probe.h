#pragma once

#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/gpu/buffer.h"
#include "renderer/gpu/device.h"
#include "renderer/shading/program_cache.h"

namespace volcast::support {

/// The chunks of the program, and those of tests/support/numerics/chunks.
shading::ChunkSource chunksWithProbes();

/// Evaluates functions of shaders/lib that take two numbers, on the GPU.
class WeightsProbe {
public:
    /// `chunk`: a file of tests/support/numerics/chunks that includes weights_main.glsl, such as
    /// "weights_psi.glsl".
    ///
    /// Errors: kShaderBuild, kOutOfGpuMemory.
    static Result<WeightsProbe> create(gpu::Device& device, const std::string& chunk);

    /// weightsOf(pair.x, pair.y) of each pair; in batches, so any number of them.
    ///
    /// Errors: kOutOfGpuMemory.
    Result<std::vector<glm::vec3>> operator()(std::span<const glm::vec2> pairs) const;

private:
    WeightsProbe(gpu::Device& device, gpu::Buffer psiTable, shading::ProgramCache programs)
        : device_{&device}, psiTable_{std::move(psiTable)}, programs_{std::move(programs)} {}

    Result<void> batch(std::span<const glm::vec2> pairs, std::vector<glm::vec3>& answers) const;

    gpu::Device* device_;
    gpu::Buffer psiTable_;
    shading::ProgramCache programs_;  ///< Owns `program_`.
    const gpu::Program* program_ = nullptr;
};

}  // namespace volcast::support
