#pragma once

#include "renderer/data/dataset.h"
#include "renderer/plan/plan.h"

namespace volcast::plan {

/// Which integrator serves a layer of a mesh, and why; in the effect kAccuracy.
struct Method {
    scene::Integrator integrator = scene::Integrator::kExact;
    std::string reason;
};

/// `constantInCells`: both fields have one value a cell.
Method chooseMethod(const scene::Layer& layer, const scene::Accuracy& wish, bool constantInCells);

}  // namespace volcast::plan
