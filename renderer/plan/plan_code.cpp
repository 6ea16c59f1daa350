#include <algorithm>

#include "renderer/plan/effects.h"
#include "renderer/plan/matter.h"

namespace volcast::plan {
namespace {

/// A sample's opacity is that of this share of the data's diagonal; meshes are sampled as often.
constexpr double kSamplesOverDiagonal = 64.0;

/// The longest part of a ray that a sample in a mesh stands for.
void planParts(LayerPlan& plan, const Matter& matter, const scene::Camera& camera) {
    const double usual = matter.diagonal > 0.0 ? matter.diagonal / kSamplesOverDiagonal : 1.0;
    const double asked = askedStep(matter, camera);
    const double wanted = asked > 0.0 ? asked : usual;
    const double smallest = matter.diagonal / kMaxRaySamples;
    const bool enlarged = wanted < smallest;
    plan.stepWorld = std::max(wanted, smallest);
    add(plan, kStepEnlarged, enlarged,
        enlarged
            ? "a step of " + number(wanted) + " needs more than " + std::to_string(kMaxRaySamples) +
                  " samples over the diagonal: drawn with " + number(smallest)
            : "each cell is sampled in parts of at most " + number(wanted));
}

}  // namespace

double askedStep(const Matter& matter, const scene::Camera& camera) {
    if (matter.layer.depthSamples == 0) return matter.layer.stepWorld;
    const glm::dvec3 forward = glm::normalize(camera.center - camera.eye);
    const data::Box& bounds = matter.summary.bounds;
    return glm::dot(glm::abs(forward), bounds.max - bounds.min) / matter.layer.depthSamples;
}

void planCode(LayerPlan& plan, const Matter& matter) {
    plan.integrator = "user shader";
    plan.method = scene::Integrator::kAverage;
    add(plan, kUserShader, true, "the layer's code says what a sample shows; its map is not used");
    const bool gathers = matter.layer.model == scene::RayModel::kVolume;
    add(plan, kEarlyStop, gathers,
        gathers ? "a ray may get opaque on its way" : "every sample may have the extreme");
}

void planMeshCode(LayerPlan& plan, const Matter& matter, const scene::Camera& camera) {
    plan.evaluator = Evaluator::kMeshWalk;
    planCode(plan, matter);
    planParts(plan, matter, camera);
    add(plan, kSecondField, false, "code reads further fields by their number");
    add(plan, kReEntry, !matter.summary.convex,
        matter.summary.convex ? "the mesh is convex: a ray leaves it once"
                              : "the mesh is not convex: rays may come back");
}

}  // namespace volcast::plan
