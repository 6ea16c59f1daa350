#include "renderer/mesh/walk.h"

#include <algorithm>
#include <string>

#include <epoxy/gl.h>

#include "renderer/mesh/mesh_buffers.h"
#include "renderer/mesh/shared.h"
#include "renderer/mesh/walk_cache.h"
#include "renderer/plan/effects.h"
#include "renderer/scene/ray_models.h"

namespace volcast::mesh {

namespace {

// llvmpipe ends all loops of an invocation after 65,535 iterations together. A single loop counts
// the steps of the longest of its 8 rays; nested loops may count those of all 8.
constexpr int kMaxStepsConvex = 65000;
constexpr int kMaxStepsListed = 8000;
constexpr int kMaxDraws = 4096;  // Of one picture; 32 million cells on a ray.

WalkTraits traitsOf(const DrawInputs& inputs) {
    return {.model = inputs.layer->model,
            .association = inputs.association,
            .convex = inputs.mesh->convex,
            .clipsAtStart = inputs.planeDepth <= 0.0,
            .earlyStop = inputs.plan->has(plan::kEarlyStop)};
}

/// Bytes between two paused rays of `program`; their size depends on the ray model.
std::size_t pausedRayBytes(const gpu::Program& program) {
    const GLuint index =
        glGetProgramResourceIndex(program.name(), GL_BUFFER_VARIABLE, "pausedRays[0].vertices");
    const GLenum property = GL_TOP_LEVEL_ARRAY_STRIDE;
    GLint stride = 0;
    glGetProgramResourceiv(program.name(), GL_BUFFER_VARIABLE, index, 1, &property, 1, nullptr,
                           &stride);
    return static_cast<std::size_t>(std::max(stride, 16));
}

void drawPicture(const DrawInputs& inputs, const gpu::Program& program, const WalkCache& cache) {
    inputs.target->begin({.blend = gpu::Blend::kOver});
    program.use();
    cache.bind(inputs);
    inputs.device->draw(gpu::Primitive::kTriangles, 3);
}

/// Draws the rays that one draw could not finish, until none is left.
Result<void> drawLongRays(const DrawInputs& inputs, WalkCache& cache) {
    WalkTraits traits = traitsOf(inputs);
    traits.counts = true;
    traits.resumes = true;
    const auto program = inputs.programs->ray(walkRecipe(traits, inputs.constants));
    if (!program) return program.error();
    if (auto done = cache.bindPausedRays(*inputs.device, pausedRayBytes(**program)); !done) {
        return done;
    }
    for (int draw = 0; draw < kMaxDraws; ++draw) {
        cache.clearCounts();
        drawPicture(inputs, **program, cache);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
        const std::uint32_t unfinished = cache.unfinishedRays();
        if (auto done = inputs.device->check("mesh walk"); !done) return done;
        if (unfinished == 0) return {};
    }
    return fail(ErrorCode::kLimitExceeded,
                "mesh: a ray meets more than " + std::to_string(kMaxDraws) + " times " +
                    std::to_string(kMaxStepsListed) + " cells or boundary faces");
}

}  // namespace

shading::Recipe walkRecipe(const WalkTraits& traits, std::vector<shading::Constant> constants) {
    const scene::RayModelRow& row = scene::row(traits.model);
    const bool listed = !traits.convex;
    constants.insert(constants.end(), {{"kValuesAt", valuesAt(traits.association)},
                                       {"kListed", listed},
                                       {"kClipsAtStart", traits.clipsAtStart},
                                       {"kEarlyStop", traits.earlyStop},
                                       {"kMaxSteps", listed ? kMaxStepsListed : kMaxStepsConvex},
                                       {"kCounts", traits.counts},
                                       {"kResumes", traits.resumes}});
    return {.evaluator = "mesh/walk.glsl",
            .classify = "classify/transfer_function.glsl",
            .segment = traits.model == scene::RayModel::kVolume ? "segment/average.glsl" : "",
            .model = std::string{row.chunk},
            .constants = std::move(constants)};
}

std::unique_ptr<WalkState> WalkState::create() {
    return std::make_unique<WalkCache>();
}

Result<void> drawWalk(const DrawInputs& inputs, WalkState& state) {
    WalkCache& cache = WalkCache::of(state);
    // A line crosses a cell once, so few cells cannot make a long ray; lists can be of any length.
    const bool mayBeLong =
        !inputs.mesh->convex || inputs.mesh->cells.size() > std::size_t{kMaxStepsConvex};
    WalkTraits traits = traitsOf(inputs);
    traits.counts = mayBeLong;
    const auto program = inputs.programs->ray(walkRecipe(traits, inputs.constants));
    if (!program) return program.error();
    if (auto done = cache.prepare(inputs); !done) return done;
    if (mayBeLong) cache.clearCounts();
    drawPicture(inputs, **program, cache);
    if (mayBeLong && cache.unfinishedRays() > 0) return drawLongRays(inputs, cache);
    return {};
}

}  // namespace volcast::mesh
