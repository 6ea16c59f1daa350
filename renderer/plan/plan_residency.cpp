#include <algorithm>

#include "renderer/plan/effects.h"
#include "renderer/plan/matter.h"
#include "renderer/scene/user_controls.h"

namespace volcast::plan {
namespace {

// A resident voxel is a float32 whatever its type.
constexpr std::uint64_t kResidentVoxelBytes = 4;
constexpr std::uint64_t kMib = std::uint64_t{1} << 20;

std::uint64_t residentBytes(const data::DatasetSummary& summary) {
    return static_cast<std::uint64_t>(summary.voxels.x) *
           static_cast<std::uint64_t>(summary.voxels.y) *
           static_cast<std::uint64_t>(summary.voxels.z) * kResidentVoxelBytes;
}

std::string mib(std::uint64_t bytes) {
    return number(static_cast<double>(bytes) / static_cast<double>(kMib)) + " MiB";
}

/// Rays have fewer samples than without bricks.
void limitSamples(LayerPlan& plan, const Matter& matter) {
    const double longest =
        glm::length(matter.summary.spacing * glm::dvec3(matter.summary.voxels - 1));
    const double smallest = longest / kMaxBrickedRaySamples;
    if (plan.stepWorld <= 0.0 || plan.stepWorld >= smallest) return;
    for (Effect& effect : plan.effects) {
        if (effect.name != kStepEnlarged) continue;
        effect.on = true;
        effect.reason = "a step of " + number(plan.stepWorld) + " needs more than " +
                        std::to_string(kMaxBrickedRaySamples) +
                        " samples on a ray through bricks: drawn with " + number(smallest);
    }
    plan.stepWorld = smallest;
}

/// Ranges of bricks are not asked for where that could take too many rounds.
void limitSkipping(LayerPlan& plan, const Matter& matter) {
    const glm::ivec3 voxels = matter.summary.voxels;
    if (std::max({voxels.x, voxels.y, voxels.z}) <= kMaxSkippedSide) return;
    for (Effect& effect : plan.effects) {
        if (effect.name != kEmptyBricks || !effect.on) continue;
        effect.on = false;
        effect.reason = "the volume has more than " + std::to_string(kMaxSkippedSide) +
                        " voxels along an axis: no ranges are asked for";
    }
}

}  // namespace

void planResidency(LayerPlan& plan, const Matter& matter, const Limits& limits) {
    const std::uint64_t bytes = residentBytes(matter.summary);
    const std::string taken = "a channel takes " + mib(bytes) + " of GPU memory, " +
                              mib(limits.volumeBytes) + " are allowed";
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
