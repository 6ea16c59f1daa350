#include "renderer/plan/method.h"

#include <string>

#include "renderer/scene/ray_models.h"

namespace volcast::plan {

using scene::Accuracy;
using scene::Integrator;

Method chooseMethod(const scene::Layer& layer, const Accuracy& wish, bool constantInCells) {
    const auto& integrators = scene::row(layer.model).integrators;
    if (layer.integrator != Integrator::kAuto) {
        return {.integrator = layer.integrator, .reason = "asked for by name"};
    }
    if (integrators.size() == 1) {
        return {.integrator = integrators.front().integrator,
                .reason = "the model has one way, and it is exact"};
    }
    const auto named = [](const scene::IntegratorRow& row) { return std::string{row.name}; };
    if (constantInCells) {
        return {.integrator = integrators.front().integrator,
                .reason = "one value a cell, so that " + named(integrators.front()) + " is exact"};
    }
    if (wish.kind == Accuracy::Kind::kFastest) {
        return {.integrator = integrators.front().integrator, .reason = "the fastest is asked for"};
    }
    return {.integrator = integrators.back().integrator,
            .reason = wish.kind == Accuracy::Kind::kExact ? "an exact picture is asked for"
                                                          : "exact costs little more"};
}

}  // namespace volcast::plan
