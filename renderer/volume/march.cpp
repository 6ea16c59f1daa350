#include "renderer/volume/march.h"

#include <array>
#include <cmath>

#include "renderer/gpu/scissor.h"
#include "renderer/plan/effects.h"
#include "renderer/scene/ray_models.h"
#include "renderer/shading/shared.h"
#include "renderer/volume/field.h"

namespace volcast::volume {

MarchTraits traitsOf(const DrawInputs& inputs) {
    return {.model = inputs.layer->model,
            .integrator = inputs.plan->method,
            .sampling = inputs.layer->sampling,
            .texels = texelsOf(inputs),
            .filterInHardware = inputs.filterInHardware,
            .skipsBricks = inputs.plan->has(plan::kEmptyBricks),
            .byDistance = inputs.emptySpace != nullptr,
            .earlyStop = inputs.plan->has(plan::kEarlyStop),
            .lit = inputs.plan->has(plan::kGradient),
            .shaded = inputs.plan->has(plan::kLight),
            .interval = inputs.plan->has(plan::kInterval),
            .jitters = inputs.plan->has(plan::kJitter),
            .missing = inputs.plan->has(plan::kVoxelsWithoutValue),
            .clipPlanes = inputs.clipPlanes,
            .field = fieldTraits(inputs)};
}

namespace {

/// What a ray hands to its model.
enum class Pieces {
    kSamples,   ///< Constant pieces, of the samples in the middle of steps.
    kLines,     ///< From sample to sample.
    kSplit,     ///< The same, in parts where the map bends.
    kAdaptive,  ///< Constant pieces of steps that set their own length.
    kVoxels,    ///< Nearest voxels from wall to wall: constant, so that the cheapest is exact.
};

Pieces piecesOf(const MarchTraits& traits) {
    if (scene::row(traits.model).opaque) return Pieces::kLines;
    const scene::Combine combine = scene::row(traits.model).combine;
    const bool sums = combine == scene::Combine::kUnder || combine == scene::Combine::kSum;
    const bool best = traits.integrator == scene::Integrator::kExact ||
                      traits.integrator == scene::Integrator::kAdaptive;
    if (!sums || traits.integrator == scene::row(traits.model).voxelIntegrators[0].integrator) {
        return Pieces::kSamples;
    }
    if (best && traits.sampling == scene::Sampling::kNearest) return Pieces::kVoxels;
    if (traits.integrator == scene::Integrator::kAdaptive) return Pieces::kAdaptive;
    return best ? Pieces::kSplit : Pieces::kLines;
}

}  // namespace

shading::Recipe marchRecipe(const MarchTraits& traits, std::vector<shading::Constant> constants) {
    const scene::RayModelRow& row = scene::row(traits.model);
    const Pieces pieces = piecesOf(traits);
    const plan::RayLimits limits =
        plan::rayLimits(traits.field.bricked, traits.field.coarserLevels);
    const bool loops = pieces == Pieces::kSplit || pieces == Pieces::kAdaptive;
    const scene::IntegratorRow* integrator =
        pieces == Pieces::kVoxels ? row.voxelIntegrators.data()
                                  : scene::integratorRow(traits.model, traits.integrator, false);
    constants.insert(constants.end(),
                     {{"kSampling", static_cast<int>(traits.sampling)},
                      {"kTexels", static_cast<int>(traits.texels)},
                      {"kFilterInHardware", traits.filterInHardware},
                      {"kPieces", pieces == Pieces::kLines || pieces == Pieces::kSplit},
                      {"kNarrows", row.opaque},
                      {"kAdaptive", pieces == Pieces::kAdaptive},
                      {"kByVoxels", pieces == Pieces::kVoxels},
                      {"kSplits", pieces == Pieces::kSplit},
                      {"kSumsColour", traits.model == scene::RayModel::kSplat},
                      {"kSumsExtinction", traits.model == scene::RayModel::kXray},
                      {"kMaxRayParts", limits.pieces},
                      {"kSkipBricks", traits.skipsBricks},
                      {"kByDistance", traits.skipsBricks && traits.byDistance},
                      // A sample that is looked at first has to count.
                      {"kForesees", traits.skipsBricks && !traits.interval && !traits.missing &&
                                        (traits.model == scene::RayModel::kMip ||
                                         traits.model == scene::RayModel::kMinip)},
                      {"kEarlyStop", traits.earlyStop},
                      {"kLit", traits.lit},
                      {"kShaded", traits.shaded},
                      {"kInterval", traits.interval},
                      {"kJitters", traits.jitters},
                      {"kMissing", traits.missing},
                      {"kCoarseSteps", traits.field.bricked && !row.opaque},
                      {"kClipPlanes", traits.clipPlanes},
                      {"kClipsAtStart", true},
                      {"kTricubicOvershoot", plan::kTricubicOvershoot},
                      {"kMaxRaySamples", loops ? limits.pieces : limits.samples}});
    std::string segment{integrator == nullptr ? "" : integrator->chunk};
    if (traits.shaded) segment = "segment/average_lit.glsl";
    shading::Recipe recipe{
        .evaluator = row.opaque ? "volume/march_opaque.glsl" : "volume/march.glsl",
        .classify = "classify/transfer_function.glsl",
        .segment = std::move(segment),
        .model = std::string{row.chunk},
        .constants = std::move(constants)};
    addField(recipe, traits.field);
    return recipe;
}

namespace {

/// What code shows of an extreme is not known either, so that the interval alone tells.
bool followsExtremes(const scene::Layer& layer) {
    return layer.shader.code.empty() &&
           (layer.model == scene::RayModel::kMip || layer.model == scene::RayModel::kMinip);
}

bool skipsWhole(const plan::LayerPlan& plan) {
    return plan.has(plan::kEmptyBricks) && !plan.has(plan::kBricks);
}

}  // namespace

bool passesOverEmptySpace(const scene::Layer& layer, const plan::LayerPlan& plan) {
    return skipsWhole(plan) && !followsExtremes(layer);
}

bool readsRanges(const scene::Layer& layer, const plan::LayerPlan& plan) {
    return skipsWhole(plan) && followsExtremes(layer);
}

void drawCover(const DrawInputs& inputs) {
    const gpu::Scissor scissor{{inputs.cover.x, inputs.cover.y}, {inputs.cover.z, inputs.cover.w}};
    inputs.device->draw(gpu::Primitive::kTriangles, 3);
}

Result<void> drawMarch(const DrawInputs& inputs) {
    const Result<const gpu::Program*> program =
        inputs.programs->ray(marchRecipe(traitsOf(inputs), inputs.constants));
    if (!program) return program.error();
    const bool opaque = scene::row(inputs.layer->model).opaque;
    inputs.target->begin(opaque ? gpu::PassState{.depth = gpu::DepthTest::kNearest}
                                : gpu::PassState{.blend = gpu::Blend::kOver});
    (*program)->use();
    bindField(inputs);
    if (inputs.emptySpace != nullptr) inputs.emptySpace->bind();
    drawCover(inputs);
    return {};
}

Result<bool> filtersExactly(gpu::Device& device, shading::ProgramCache& programs) {
    // Between voxels 0 and 1 the value is the position itself; hardware with 8 bits is off by up
    // to 1/512 there.
    constexpr int kWidth = 64;
    constexpr float kTolerance = 4e-6F;
    Result<gpu::Texture3D> voxels =
        gpu::Texture3D::create(device, {.size = {2, 1, 1}, .linear = true, .label = "probe"});
    if (!voxels) return voxels.error();
    const std::array<float, 2> ends{0.0F, 1.0F};
    const Result<void> uploaded = voxels->upload(0, 1, std::as_bytes(std::span{ends}));
    if (!uploaded) return uploaded.error();
    const Result<gpu::Texture2D> row = gpu::Texture2D::create(
        device, {.size = {kWidth, 1}, .format = gpu::PixelFormat::kRgba32F, .label = "probe"});
    if (!row) return row.error();
    const std::array colours{&*row};
    const Result<gpu::Target> target = gpu::Target::create(device, "probe", colours);
    if (!target) return target.error();
    const Result<const gpu::Program*> program =
        programs.pass(shading::kFullScreenVertex, "volume/filter_probe.glsl");
    if (!program) return program.error();
    target->begin({});
    (*program)->use();
    voxels->bind(shading::shared::kVoxelUnit);
    device.draw(gpu::Primitive::kTriangles, 3);
    std::array<float, std::size_t{4} * kWidth> pixels{};
    target->readRgba32F(pixels);
    for (std::size_t i = 0; i < kWidth; ++i) {
        if (!(std::abs(pixels[4 * i] - pixels[4 * i + 1]) < kTolerance)) return false;
    }
    return true;
}

}  // namespace volcast::volume
