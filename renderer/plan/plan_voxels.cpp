#include <algorithm>

#include "renderer/plan/effects.h"
#include "renderer/plan/matter.h"
#include "renderer/scene/channels.h"
#include "renderer/scene/ray_models.h"

namespace volcast::plan {
namespace {

using scene::Layer;
using scene::RayModel;

/// The step that a layer asks for, world units.
double wantedStep(const Matter& matter, const scene::Camera& camera) {
    const double asked = askedStep(matter, camera);
    const glm::dvec3 spacing = matter.summary.spacing;
    return asked > 0.0 ? asked : 0.5 * std::min({spacing.x, spacing.y, spacing.z});
}

void planStep(LayerPlan& plan, const Matter& matter, const scene::Camera& camera) {
    const glm::dvec3 spacing = matter.summary.spacing;
    const double wanted = wantedStep(matter, camera);
    const double longest = glm::length(spacing * glm::dvec3(matter.summary.voxels - 1));
    const int most = mostSteps(plan.method, rayLimits(false, 0));
    const double smallest = longest / most;
    plan.stepWorld = std::max(wanted, smallest);
    const bool enlarged = wanted < smallest;
    add(plan, kStepEnlarged, enlarged,
        enlarged ? "a step of " + number(wanted) + " needs more than " + std::to_string(most) +
                       " samples on a ray: drawn with " + number(smallest)
        : matter.layer.depthSamples > 0
            ? std::to_string(matter.layer.depthSamples) + " samples over the depth of the data"
            : "the step is as asked for");
}

/// Samples that stand for a whole step may be anywhere in it.
void planJitter(LayerPlan& plan, const Layer& layer) {
    const bool samples = plan.method == scene::row(layer.model).voxelIntegrators[0].integrator ||
                         layer.model == RayModel::kMipColour;
    const bool march = plan.evaluator == Evaluator::kVolumeMarch;
    const bool on =
        march && layer.jitter.has_value() && samples && layer.model != RayModel::kIsosurface;
    add(plan, kJitter, on,
        on              ? "samples are moved in their steps, by the pixel and the seed"
        : !layer.jitter ? "samples are in the middle of their steps"
                        : "what lies between samples counts, wherever they are");
}

/// Why bricks can be passed over whatever the map; empty where they cannot.
std::string reasonToPassOver(RayModel model) {
    switch (model) {
        case RayModel::kMip: return "a brick that cannot raise the maximum is passed over";
        case RayModel::kMinip: return "a brick that cannot lower the minimum is passed over";
        case RayModel::kIsosurface: return "a brick between two levels is passed over";
        default: return {};
    }
}

/// Channels that are drawn together.
void planChannels(LayerPlan& plan, const Layer& layer) {
    const std::size_t shown = scene::shownChannels(layer).size();
    add(plan, kChannels, shown > 0,
        shown > 0 ? std::to_string(shown) + " channel(s), each by its own map"
                  : "one channel is drawn");
}

bool isOneBrick(const Matter& matter) {
    const glm::ivec3 intervals = matter.summary.voxels - 1;
    return std::max({intervals.x, intervals.y, intervals.z}) <= data::Volume::kBrickSize;
}

/// Of channels that absorb together; one with an interval may add nothing anywhere.
void planBricksOfChannels(LayerPlan& plan, const Matter& matter) {
    const bool everywhere = matter.extinction.min > 0.0F;
    add(plan, kEmptyBricks, !everywhere,
        everywhere ? "a channel's map has extinction everywhere in the data's range"
                   : "a brick is passed over where no channel's map has extinction");
}

void planBricks(LayerPlan& plan, const Matter& matter) {
    if (isOneBrick(matter)) {
        add(plan, kEmptyBricks, false, "the volume is a single brick");
    } else if (plan.has(kChannels) && absorbs(matter.layer.model)) {
        planBricksOfChannels(plan, matter);
    } else if (plan.has(kInterval)) {
        add(plan, kEmptyBricks, true, "a brick without values in the interval is passed over");
    } else if (!absorbs(matter.layer.model)) {
        const std::string reason = reasonToPassOver(matter.layer.model);
        add(plan, kEmptyBricks, !reason.empty(),
            reason.empty() ? "every value of a brick may add to the ray" : reason);
    } else if (matter.extinction.min > 0.0F) {
        add(plan, kEmptyBricks, false, "the map has extinction everywhere in the data's range");
    } else {
        add(plan, kEmptyBricks, true, "the map has no extinction in a part of the data's range");
    }
}

void planMissing(LayerPlan& plan, const Matter& matter) {
    std::uint64_t count = matter.field == nullptr ? 0 : matter.field->voxelsWithoutValue;
    if (!matter.layer.channels.empty()) {
        count = 0;
        for (const scene::ChannelMap* channel : scene::shownChannels(matter.layer)) {
            count += scene::findField(matter.summary, channel->field)->voxelsWithoutValue;
        }
    }
    add(plan, kVoxelsWithoutValue, count > 0,
        count > 0 ? "nothing is drawn where " + std::to_string(count) +
                        " voxel(s) without a value (NaN) would count"
                  : "every voxel has a value");
}

Evaluator evaluatorFor(scene::VoxelEvaluator evaluator) {
    switch (evaluator) {
        case scene::VoxelEvaluator::kSlices: return Evaluator::kVolumeSlices;
        case scene::VoxelEvaluator::kSliceInstances: return Evaluator::kVolumeSliceInstances;
        case scene::VoxelEvaluator::kAuto:
        case scene::VoxelEvaluator::kMarch: break;
    }
    return Evaluator::kVolumeMarch;
}

void planInterpolation(LayerPlan& plan, const Layer& layer) {
    const bool interpolates = layer.sampling != scene::Sampling::kNearest;
    add(plan, kInterpolation, interpolates,
        interpolates ? std::string{scene::name(layer.sampling)} + " between grid points"
                     : "the nearest grid point's value");
}

void planLight(LayerPlan& plan, const Layer& volume) {
    const bool lit = volume.light.has_value();
    add(plan, kLight, lit,
        !lit                     ? "matter emits its colour alone, so no gradient is needed"
        : plan.has(kChannels)    ? "each channel is lit by the slope of its own field"
        : volume.light->position ? "lit from a point of the world"
                                 : "lit from the eye");
}

/// What code shows of a value is not known before it runs; but of some values it is not asked.
void planBricksOfCode(LayerPlan& plan, const Matter& matter) {
    if (isOneBrick(matter)) {
        add(plan, kEmptyBricks, false, "the volume is a single brick");
    } else if (plan.has(kInterval)) {
        add(plan, kEmptyBricks, true,
            "a brick without values in the interval is passed over, whatever the code shows");
    } else if (plan.has(kVoxelsWithoutValue)) {
        add(plan, kEmptyBricks, true, "a brick without any value is passed over");
    } else {
        add(plan, kEmptyBricks, false,
            "nobody knows what the code shows of a brick's values; an interval would tell");
    }
}

/// A user's code in the place of the map.
void planUserShader(LayerPlan& plan, const Matter& matter, const scene::Camera& camera) {
    plan.evaluator = Evaluator::kVolumeMarch;
    planCode(plan, matter);
    planStep(plan, matter, camera);
    planBricksOfCode(plan, matter);
}

}  // namespace

int mostSteps(scene::Integrator method, const RayLimits& limits) {
    if (method == scene::Integrator::kAdaptive) return limits.pieces / kMaxRoundsAStep;
    return method == scene::Integrator::kExact ? limits.pieces : limits.samples;
}

void planVoxels(LayerPlan& plan, const Matter& matter, const scene::Scene& scene,
                std::span<const Evidence> evidence) {
    plan.evaluator = evaluatorFor(matter.layer.voxelEvaluator);
    plan.integrator = "march";
    planChannels(plan, matter.layer);
    planInterpolation(plan, matter.layer);
    planMissing(plan, matter);
    if (!matter.layer.shader.code.empty()) return planUserShader(plan, matter, scene.camera);
    add(plan, kUserShader, false, "the map says what a sample shows");
    planVoxelMethod(plan, matter, scene.accuracy, evidence);
    if (matter.layer.model == RayModel::kIsosurface) planHeadlight(plan, matter.layer);
    if (matter.layer.model == RayModel::kVolume) planLight(plan, matter.layer);
    planStep(plan, matter, scene.camera);
    planJitter(plan, matter.layer);
    if (plan.evaluator == Evaluator::kVolumeMarch) {
        planBricks(plan, matter);
        planEarlyStop(plan, matter);
    } else {
        add(plan, kEmptyBricks, false, "slices cut through all of the volume");
        add(plan, kEarlyStop, false, "slices are drawn for all rays at once");
    }
}

void planCrossSections(LayerPlan& plan, const Matter& matter) {
    plan.evaluator = Evaluator::kCrossSections;
    plan.integrator = "planes";
    planInterpolation(plan, matter.layer);
    planMissing(plan, matter);
    const bool code = !matter.layer.shader.code.empty();
    add(plan, kUserShader, code,
        code ? "the layer's code says what a plane shows; its map is not used"
             : "the map says what a plane shows");
    add(plan, kEndsAtSurfaces, false, "opaque layers share one depth");
}

}  // namespace volcast::plan
