#include <algorithm>
#include <map>

#include "renderer/plan/effects.h"
#include "renderer/plan/matter.h"
#include "renderer/scene/channels.h"
#include "renderer/scene/layer_fields.h"
#include "renderer/scene/user_controls.h"

namespace volcast::plan {
namespace {

// A resident voxel is a float32 whatever its type.
constexpr std::uint64_t kResidentVoxelBytes = 4;
constexpr std::uint64_t kMib = std::uint64_t{1} << 20;

std::uint64_t channelBytes(const data::DatasetSummary& summary) {
    return static_cast<std::uint64_t>(summary.voxels.x) *
           static_cast<std::uint64_t>(summary.voxels.y) *
           static_cast<std::uint64_t>(summary.voxels.z) * kResidentVoxelBytes;
}

/// Of channels that are drawn together, whose texels have room for four.
constexpr std::uint64_t kChannelsATexel = 4;

std::string mib(std::uint64_t bytes) {
    return number(static_cast<double>(bytes) / static_cast<double>(kMib)) + " MiB";
}

/// Rays have fewer samples than without bricks.
void limitSamples(LayerPlan& plan, const Matter& matter) {
    const double longest =
        glm::length(matter.summary.spacing * glm::dvec3(matter.summary.voxels - 1));
    const int most = mostSteps(plan.method, rayLimits(true, matter.summary.coarserLevels));
    const double smallest = longest / most;
    if (plan.stepWorld <= 0.0 || plan.stepWorld >= smallest) return;
    for (Effect& effect : plan.effects) {
        if (effect.name != kStepEnlarged) continue;
        effect.on = true;
        effect.reason = "a step of " + number(plan.stepWorld) + " needs more than " +
                        std::to_string(most) + " samples on a ray through bricks: drawn with " +
                        number(smallest);
    }
    plan.stepWorld = smallest;
}

/// Ranges of bricks are not asked for where that could take too many rounds, nor by code.
void limitSkipping(LayerPlan& plan, const Matter& matter) {
    const glm::ivec3 voxels = matter.summary.voxels;
    const bool code = !matter.layer.shader.code.empty();
    if (!code && std::max({voxels.x, voxels.y, voxels.z}) <= kMaxSkippedSide) return;
    for (Effect& effect : plan.effects) {
        if (effect.name != kEmptyBricks || !effect.on) continue;
        effect.on = false;
        effect.reason = code ? "bricks that hold nothing are not loaded, but rays ask at each step"
                             : "the volume has more than " + std::to_string(kMaxSkippedSide) +
                                   " voxels along an axis: no ranges are asked for";
    }
}

}  // namespace

Residency residencyOf(const scene::Scene& scene, const scene::Summaries& summaries) {
    std::map<std::string, std::uint64_t> wholes;  // By what layers share.
    for (const scene::Layer& layer : scene.layers) {
        const data::DatasetSummary& summary = summaries.at(layer.dataset);
        if (!layer.visible || summary.isMesh) continue;
        const std::uint64_t bytes = channelBytes(summary);
        std::string names;
        for (const scene::ChannelMap* channel : scene::shownChannels(layer)) {
            names += '\n' + channel->field;
        }
        const data::FieldSummary* field = scene::findField(summary, layer.field);
        if (names.empty() && field != nullptr) names = field->name;
        const bool several = !scene::shownChannels(layer).empty();
        wholes[layer.dataset + '\n' + names] = several ? kChannelsATexel * bytes : bytes;
    }
    Residency all{.wholes = wholes.size()};
    for (const auto& [name, bytes] : wholes) all.bytes += bytes;
    return all;
}

RayLimits rayLimits(bool bricked, int coarserLevels) noexcept {
    constexpr int kSkippedLevels = 7;  // 32 << 7 = kMaxSkippedSide.
    if (!bricked) return {};
    if (coarserLevels > kSkippedLevels) {
        return {.samples = kMaxWideBrickedRaySamples, .pieces = kMaxWideBrickedRayPieces};
    }
    return {.samples = kMaxBrickedRaySamples, .pieces = kMaxBrickedRayPieces};
}

void planResidency(LayerPlan& plan, const Matter& matter, const Limits& limits,
                   const Residency& all) {
    const std::uint64_t bytes = all.bytes;
    const std::string taken =
        (all.wholes == 1 ? "its voxels take "
                         : "the voxels of " + std::to_string(all.wholes) + " layers take ") +
        mib(bytes) + " of GPU memory, " + mib(limits.volumeBytes) + " are allowed";
    const bool alone =
        matter.layer.channels.empty() &&
        (bytes <= limits.volumeBytes || !scene::readsOtherChannels(matter.layer, matter.summary));
    const bool known =
        plan.evaluator == Evaluator::kVolumeMarch || plan.evaluator == Evaluator::kCrossSections;
    if (bytes <= limits.volumeBytes) {
        add(plan, kBricks, false, taken);
    } else if (matter.summary.coarserLevels == 0) {
        add(plan, kBricks, false, "the volume is too small to have coarser levels");
    } else if (!alone || !known) {
        add(plan, kBricks, false,
            taken + ", but " + (known ? "several channels need" : "slices need") + " all of it");
    } else {
        add(plan, kBricks, true, taken + ": loaded by bricks of its pyramid");
        limitSamples(plan, matter);
        limitSkipping(plan, matter);
    }
}

}  // namespace volcast::plan
