#pragma once

#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/gpu/device.h"
#include "renderer/scene/map_texels.h"
#include "renderer/shading/program_cache.h"

namespace volcast::support {

/// One segment of a ray: its values run linearly from `front` to `back` over `extent`.
struct ProbedSegment {
    float front = 0.0F, back = 0.0F;
    float extent = 1.0F;  ///< World units.
    bool goesOn = false;  ///< `front` is where the segment before it ended.
};
using ProbedRay = std::vector<ProbedSegment>;

struct ProbedAnswer {
    glm::vec4 colour{0.0F};  ///< What the model's endRay() gives.
    float hitDistance = 0.0F;
    int parts = 0;  ///< In how many parts the segments were taken.
};

/// The chunks of a ray model that fill a program; empty: the model needs none.
struct ProbedModel {
    std::string segment, model;
};

/// Runs lists of segments through a ray model on the GPU, by chunks/segments.glsl.
class SegmentsProbe {
public:
    explicit SegmentsProbe(gpu::Device& device);

    /// One answer a ray; at most 4096 rays. Extinctions and light count as they are: both scales 1.
    ///
    /// Errors: kShaderBuild, kOutOfGpuMemory.
    Result<std::vector<ProbedAnswer>> operator()(const ProbedModel& chunks,
                                                 const scene::MapContent& content,
                                                 std::span<const ProbedRay> rays);

private:
    gpu::Device* device_;
    shading::ProgramCache programs_;
};

}  // namespace volcast::support
