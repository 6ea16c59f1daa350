#include "renderer/accuracy/measurement_effects.h"

#include <array>

#include "renderer/plan/effects.h"

namespace volcast::accuracy {
namespace {

using scene::Layer;
using scene::RayModel;

struct Row {
    const char* effect;
    bool (*asked)(const Layer& layer);
    void (*leaveOut)(Layer& layer);
};

bool isBoundary(const Layer& layer) {
    return layer.model == RayModel::kSurface || layer.model == RayModel::kWireframe;
}

constexpr std::array kRows{
    Row{plan::kInterval, [](const Layer& l) { return l.interval.has_value(); },
        [](Layer& l) { l.interval.reset(); }},
    Row{plan::kSecondField, [](const Layer& l) { return !l.densityField.empty(); },
        [](Layer& l) {
            l.densityField.clear();
            l.densityMap = {};
            l.densityScale = {};
        }},
    Row{plan::kScale, [](const Layer& l) { return l.scale != scene::Scale{}; },
        [](Layer& l) { l.scale = {}; }},
    Row{plan::kCellsLeftOut, [](const Layer& l) { return !l.markers.field.empty(); },
        [](Layer& l) { l.markers = {}; }},
    Row{plan::kHeadlight, [](const Layer& l) { return isBoundary(l) && l.headlight; },
        [](Layer& l) { l.headlight = false; }},
    Row{plan::kGradient,
        [](const Layer& l) { return l.model == RayModel::kIsosurface && l.headlight; },
        [](Layer& l) { l.headlight = false; }},
    Row{plan::kEdges, [](const Layer& l) { return l.model == RayModel::kWireframe; },
        [](Layer& l) { l.model = RayModel::kSurface; }},
    Row{plan::kColourByValue, [](const Layer& l) { return isBoundary(l) && l.coloured; },
        [](Layer& l) { l.coloured = false; }},
    Row{plan::kLight, [](const Layer& l) { return l.light.has_value(); },
        [](Layer& l) { l.light.reset(); }},
    Row{plan::kJitter, [](const Layer& l) { return l.jitter.has_value(); },
        [](Layer& l) { l.jitter.reset(); }},
    Row{plan::kInterpolation,
        [](const Layer& l) { return l.sampling != scene::Sampling::kNearest; },
        [](Layer& l) { l.sampling = scene::Sampling::kNearest; }},
};

}  // namespace

std::vector<WithoutEffect> withoutEffects(const scene::Scene& scene) {
    std::vector<WithoutEffect> found;
    for (std::size_t i = 0; i < scene.layers.size(); ++i) {
        const Layer& layer = scene.layers[i];
        if (!layer.visible || !layer.shader.code.empty()) continue;
        const auto add = [&](const char* effect) -> scene::Scene& {
            return found
                .emplace_back(WithoutEffect{.layer = layer.id, .effect = effect, .scene = scene})
                .scene;
        };
        if (!scene.clipPlanes.empty()) add(plan::kClipPlanes).clipPlanes.clear();
        for (const Row& row : kRows) {
            if (row.asked(layer)) row.leaveOut(add(row.effect).layers[i]);
        }
    }
    return found;
}

}  // namespace volcast::accuracy
