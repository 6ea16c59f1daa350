#include "renderer/mesh/walk.h"

#include <algorithm>
#include <string>

#include <epoxy/gl.h>

#include "renderer/mesh/mesh_buffers.h"
#include "renderer/mesh/shared.h"
#include "renderer/mesh/walk_cache.h"
#include "renderer/mesh/walk_user.h"
#include "renderer/plan/effects.h"
#include "renderer/scene/ray_models.h"
#include "renderer/shading/psi_table.h"

namespace volcast::mesh {

namespace {

// Models and integrators that take a piece in parts, where the map bends.
bool splitsPieces(const WalkTraits& traits) {
    using scene::RayModel;
    if (traits.code) return true;
    const bool integrates = traits.model == RayModel::kVolume || traits.model == RayModel::kXray ||
                            traits.model == RayModel::kSplat;
    return integrates && traits.integrator == scene::Integrator::kExact;
}

// llvmpipe ends all loops of an invocation after 65,535 iterations together. Where the mesh is
// convex, its 8 rays go through the same rounds; entries of lists they may take one after the
// other. A round is one cell; where pieces are split it has loops of its own.
constexpr int kMostIterations = 65'000;
constexpr int kCellsARound = 16;
constexpr int kPartsARound = 8;
constexpr int kIterationsOfSplits = 1 + kCellsARound + kPartsARound;
constexpr int kRays = 8;
constexpr int kMaxDraws = 16'384;  // Of one picture; 6 million cells on a ray at least.

/// Those of a code's own loops may come on top of it.
int maxRounds(const WalkTraits& traits) {
    const int iterations = kMostIterations / (traits.convex ? 1 : kRays);
    if (traits.code) return iterations - iterationsAPart(*traits.code);
    return iterations / (splitsPieces(traits) ? kIterationsOfSplits : 1);
}

std::optional<CodeTraits> codeOf(const UserInputs* user) {
    if (user == nullptr) return std::nullopt;
    CodeTraits code{.texts = user->texts, .othersAt = {}, .iterations = user->iterations};
    for (const FieldGpu* field : user->others) code.othersAt.push_back(valuesAt(field));
    return code;
}

bool isOneColour(const plan::LayerPlan& plan) {
    const auto colours = std::ranges::find(plan.effects, plan::kColours, &plan::Effect::name);
    return colours != plan.effects.end() && !colours->on && !plan.has(plan::kLevelsInVolume);
}

WalkTraits traitsOf(const DrawInputs& inputs) {
    return {.model = inputs.layer->model,
            .integrator = inputs.plan->method,
            .valuesAt = valuesAt(inputs.field),
            .densityAt = valuesAt(inputs.density),
            .levels = inputs.plan->has(plan::kLevelsInVolume),
            .oneColour = isOneColour(*inputs.plan),
            .lit = inputs.plan->has(plan::kGradient),
            .interval = inputs.plan->has(plan::kInterval),
            .clipPlanes = inputs.clipPlanes,
            .convex = inputs.mesh->convex,
            .clipsAtStart = inputs.planeDepth <= 0.0,
            .earlyStop = inputs.plan->has(plan::kEarlyStop),
            .countsSteps = inputs.countsSteps,
            .code = codeOf(inputs.user)};
}

/// A piece's front values are the back values of the piece before.
bool isContinuous(const WalkTraits& traits) {
    const bool second =
        traits.densityAt == shared::kValuesAtVertices || traits.densityAt == shared::kValuesNowhere;
    return traits.valuesAt == shared::kValuesAtVertices && second && !traits.interval &&
           !traits.clipsAtStart && traits.clipPlanes == 0;
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

void drawPicture(const DrawInputs& inputs, const gpu::Program& program, WalkCache& cache,
                 bool counts) {
    if (counts) cache.clearCounts();
    const bool opaque = scene::row(inputs.layer->model).opaque;
    inputs.target->begin(opaque ? gpu::PassState{.depth = gpu::DepthTest::kNearest}
                                : gpu::PassState{.blend = gpu::Blend::kOver});
    program.use();
    cache.bind(inputs);
    inputs.device->draw(gpu::Primitive::kTriangles, 3);
    if (inputs.countsSteps) cache.addSteps();
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
        drawPicture(inputs, **program, cache, true);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
        const std::uint32_t unfinished = cache.unfinishedRays();
        if (auto done = inputs.device->check("mesh walk"); !done) return done;
        if (unfinished == 0) return {};
    }
    return fail(ErrorCode::kLimitExceeded,
                "mesh: a ray meets more than " + std::to_string(kMaxDraws) + " times " +
                    std::to_string(maxRounds(traits)) + " cells or boundary faces");
}

}  // namespace

shading::Recipe walkRecipe(const WalkTraits& traits, std::vector<shading::Constant> constants) {
    const scene::RayModelRow& row = scene::row(traits.model);
    const scene::IntegratorRow* integrator = scene::integratorRow(traits.model, traits.integrator);
    const bool listed = !traits.convex;
    constants.insert(constants.end(),
                     {{"kValuesAt", traits.valuesAt},
                      {"kDensityAt", traits.densityAt},
                      {"kListed", listed},
                      {"kContinuous", isContinuous(traits)},
                      {"kInterval", traits.interval},
                      {"kClipPlanes", traits.clipPlanes},
                      {"kLit", traits.lit},
                      {"kClipsAtStart", traits.clipsAtStart},
                      {"kEarlyStop", traits.earlyStop},
                      {"kMaxRounds", maxRounds(traits)},
                      {"kSplits", splitsPieces(traits)},
                      {"kPartByPart", traits.code.has_value()},
                      {"kIterationsAPart", traits.code ? iterationsAPart(*traits.code) : 1},
                      {"kCellsARound", kCellsARound},
                      {"kPartsARound", kPartsARound},
                      {"kCounts", traits.counts},
                      {"kResumes", traits.resumes},
                      {"kPsiTableSide", shading::kPsiTableSide},
                      {"kCountsSteps", traits.countsSteps}});
    shading::Recipe recipe{.evaluator = row.opaque ? "mesh/walk_opaque.glsl" : "mesh/walk.glsl",
                           .classify = "classify/transfer_function.glsl",
                           .segment = integrator == nullptr ? "" : std::string{integrator->chunk},
                           .model = std::string{row.chunk},
                           .constants = std::move(constants)};
    if (traits.levels) recipe.model = "model/volume_to_levels.glsl";
    if (traits.oneColour) {
        recipe.segment = "segment/line_exact.glsl";
        recipe.model = "model/opacity.glsl";
    }
    if (traits.code) showByCode(recipe, traits);
    return recipe;
}

std::unique_ptr<WalkState> WalkState::create() {
    return std::make_unique<WalkCache>();
}

Result<void> drawWalk(const DrawInputs& inputs, WalkState& state) {
    WalkCache& cache = WalkCache::of(state);
    // A line crosses a cell once, so few cells cannot make a long ray; lists can be of any length,
    // and a piece can have any number of parts.
    WalkTraits traits = traitsOf(inputs);
    const bool mayBeLong = !inputs.mesh->convex || splitsPieces(traits) ||
                           inputs.mesh->cells.size() > std::size_t{kMostIterations};
    traits.counts = mayBeLong;
    const auto program = inputs.programs->ray(walkRecipe(traits, inputs.constants));
    if (!program) return program.error();
    if (auto done = cache.prepare(inputs); !done) return done;
    cache.clearSteps();
    drawPicture(inputs, **program, cache, mayBeLong || inputs.countsSteps);
    if (mayBeLong && cache.unfinishedRays() > 0) return drawLongRays(inputs, cache);
    return {};
}

}  // namespace volcast::mesh
