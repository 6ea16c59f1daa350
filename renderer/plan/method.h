#pragma once

#include <span>

#include "renderer/data/dataset.h"
#include "renderer/plan/evidence.h"
#include "renderer/plan/plan.h"
#include "renderer/scene/ray_models.h"

namespace volcast::plan {

/// Which integrator serves a layer of a mesh, and why; in the effect kAccuracy.
struct Method {
    scene::Integrator integrator = scene::Integrator::kExact;
    std::string reason;
};

/// `integrators`: those that serve the layer. `constantInCells`: fields have one value a cell.
/// `evidence`: what is known of the model's integrators; a bound that nothing is known about is met
/// by the exact one.
Method chooseMethod(const scene::Layer& layer, std::span<const scene::IntegratorRow> integrators,
                    const scene::Accuracy& wish, bool constantInCells,
                    std::span<const Evidence> evidence = {});

/// Whether chooseMethod() would use evidence.
bool needsEvidence(const scene::Layer& layer, const scene::Accuracy& wish);

}  // namespace volcast::plan
