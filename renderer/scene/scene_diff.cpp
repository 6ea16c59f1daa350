#include "renderer/scene/scene_diff.h"

#include <algorithm>

namespace volcast::scene {
namespace {

const Layer* find(const Scene& scene, const std::string& id) {
    const auto found = std::ranges::find_if(
        scene.layers, [&](const Layer& layer) { return layer.visible && layer.id == id; });
    return found == scene.layers.end() ? nullptr : &*found;
}

/// Ids of the visible layers of `scene` that are visible in `other` too.
std::vector<std::string> common(const Scene& scene, const Scene& other) {
    std::vector<std::string> ids;
    for (const Layer& layer : scene.layers) {
        if (layer.visible && find(other, layer.id) != nullptr) ids.push_back(layer.id);
    }
    return ids;
}

LayerDiff diff(const Layer* before, const Layer& after) {
    LayerDiff change{.id = after.id};
    if (before == nullptr || before->dataset != after.dataset) {
        change.added = true;
        return change;
    }
    change.field = before->field != after.field || before->timeStep != after.timeStep ||
                   before->densityField != after.densityField || before->scale != after.scale ||
                   before->densityScale != after.densityScale;
    change.cells = before->markers != after.markers;
    change.map = before->map != after.map || before->densityMap != after.densityMap ||
                 before->levels != after.levels || before->channels != after.channels;
    change.program = before->model != after.model || before->integrator != after.integrator ||
                     before->evaluator != after.evaluator || before->sampling != after.sampling ||
                     before->coloured != after.coloured || before->headlight != after.headlight ||
                     before->interval.has_value() != after.interval.has_value() ||
                     before->light.has_value() != after.light.has_value() ||
                     before->voxelEvaluator != after.voxelEvaluator ||
                     before->jitter.has_value() != after.jitter.has_value() ||
                     before->shader.code != after.shader.code;
    change.uniforms =
        before->surfaceColour != after.surfaceColour || before->stepWorld != after.stepWorld ||
        before->interval != after.interval || before->edgeWidth != after.edgeWidth ||
        before->edgeColour != after.edgeColour ||
        before->extinctionScale != after.extinctionScale || before->exposure != after.exposure ||
        before->light != after.light || before->depthSamples != after.depthSamples ||
        before->gain != after.gain || before->jitter != after.jitter ||
        before->shader != after.shader || before->crossSections != after.crossSections;
    return change;
}

}  // namespace

SceneDiff diff(const Scene& before, const Scene& after) {
    SceneDiff changes;
    changes.camera = before.camera != after.camera;
    changes.background = before.background != after.background;
    changes.clipping = before.clipPlanes != after.clipPlanes;
    changes.accuracy = before.accuracy != after.accuracy;
    const auto seenBefore = std::ranges::count_if(before.layers, &Layer::visible);
    const std::vector<std::string> kept = common(before, after);
    changes.order =
        kept.size() != static_cast<std::size_t>(seenBefore) || kept != common(after, before);
    for (const Layer& layer : after.layers) {
        if (!layer.visible) continue;  // Nothing of a hidden layer is drawn.
        const LayerDiff change = diff(find(before, layer.id), layer);
        if (change.any()) {
            changes.layers.push_back(change);
        }
    }
    return changes;
}

}  // namespace volcast::scene
