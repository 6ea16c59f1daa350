#include <algorithm>

#include "renderer/plan/effects.h"
#include "renderer/plan/matter.h"
#include "renderer/plan/method.h"
#include "renderer/scene/ray_models.h"

namespace volcast::plan {
namespace {

using scene::RayModel;

Method methodOf(const LayerPlan& plan, const Matter& matter, const scene::Accuracy& wish,
                std::span<const Evidence> evidence) {
    const scene::Layer& layer = matter.layer;
    const auto rows = scene::row(layer.model).voxelIntegrators;
    const scene::Integrator cheapest = rows.front().integrator;
    const scene::Integrator best = rows.back().integrator;
    const bool continuous = layer.sampling != scene::Sampling::kNearest;
    const bool free = layer.integrator == scene::Integrator::kAuto;
    if (plan.has(kChannels)) {
        return {.integrator = cheapest, .reason = "several channels are drawn by their samples"};
    }
    if (rows.size() == 1) return {.integrator = best, .reason = "the model has one way"};
    if (layer.model == RayModel::kMipColour && free) {
        return {.integrator = continuous ? best : cheapest,
                .reason = continuous ? "a continuous field has every value between its samples"
                                     : "voxels have their own values alone"};
    }
    if (free && wish.kind == scene::Accuracy::Kind::kAuto) {
        return {.integrator = cheapest, .reason = "samples in the middle of steps cost least"};
    }
    Method chosen = chooseMethod(layer, rows, wish, false, evidence);
    const bool lit = layer.model == RayModel::kVolume && layer.light.has_value();
    if (lit && chosen.integrator != best) {
        return {.integrator = cheapest, .reason = "light falls on samples, for a step each"};
    }
    return chosen;
}

}  // namespace

void planEvidence(LayerPlan& plan, std::span<const Evidence> evidence) {
    const auto known = std::ranges::find(evidence, plan.method, &Evidence::integrator);
    if (known == evidence.end()) return;
    plan.predictedMs = known->predictedMs;
    plan.errorBound = known->error;
}

void planVoxelMethod(LayerPlan& plan, const Matter& matter, const scene::Accuracy& wish,
                     std::span<const Evidence> evidence) {
    const auto rows = scene::row(matter.layer.model).voxelIntegrators;
    const bool march = plan.evaluator == Evaluator::kVolumeMarch;
    const Method method =
        march ? methodOf(plan, matter, wish, evidence)
              : Method{.integrator = rows.front().integrator, .reason = "each slice is a sample"};
    plan.method = method.integrator;
    planEvidence(plan, evidence);
    const bool choice = march && rows.size() > 1;
    plan.integrator = choice ? scene::name(method.integrator) : march ? "march" : "slices";
    add(plan, kAccuracy, choice, method.reason);
}

}  // namespace volcast::plan
