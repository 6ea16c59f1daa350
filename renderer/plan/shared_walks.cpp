#include "renderer/plan/shared_walks.h"

#include <algorithm>
#include <string>

#include "renderer/plan/effects.h"
#include "renderer/scene/ray_models.h"

namespace volcast::plan {
namespace {

using scene::Layer;
using scene::RayModel;

/// Rays of both meet the same pieces with the same values. An interval cuts the pieces of a volume
/// and would cut off levels at its ends.
bool sameData(const Layer& a, const Layer& b) {
    return a.dataset == b.dataset && a.field == b.field && a.timeStep == b.timeStep &&
           a.scale == b.scale && !a.interval && !b.interval && a.markers == b.markers;
}

bool isPlainIsosurface(const Layer& layer, const LayerPlan& plan) {
    return plan.drawn && layer.model == RayModel::kIsosurface && layer.densityField.empty();
}

/// Whether an isosurface may be drawn in the walk of `host`. Alone it may be cheaper without one;
/// in a volume the walk goes by anyway.
bool mayWalk(const Layer& layer, const LayerPlan& plan, const Layer& host) {
    return plan.evaluator == Evaluator::kMeshWalk ||
           (host.model == RayModel::kVolume && layer.evaluator == scene::MeshEvaluator::kAuto);
}

void set(LayerPlan& plan, const char* name, bool on, const std::string& reason) {
    const auto found = std::ranges::find(plan.effects, name, &Effect::name);
    if (found == plan.effects.end()) {
        plan.effects.push_back({.name = name, .on = on, .reason = reason});
    } else {
        found->on = on;
        found->reason = reason;
    }
}

void drawWith(LayerPlan& plan, const Layer& host) {
    plan.evaluator = Evaluator::kMeshWalk;
    plan.drawnWith = host.id;
    set(plan, kCellsOfLevels, false, "one walk finds all levels");
    set(plan, kSharedWalk, true, "drawn in the walk of layer \"" + host.id + "\"");
}

/// The only layer that is not opaque, if that is a volume drawn by a walk; else -1.
int onlyVolume(const scene::Scene& scene, const FramePlan& frame) {
    int found = -1;
    for (std::size_t i = 0; i < scene.layers.size(); ++i) {
        if (!frame.layers[i].drawn || scene::row(scene.layers[i].model).opaque) continue;
        if (found >= 0 || scene.layers[i].model != RayModel::kVolume) return -1;
        found = static_cast<int>(i);
    }
    if (found >= 0 && !scene.layers[static_cast<std::size_t>(found)].shader.code.empty()) return -1;
    const bool walks = found >= 0 && frame.layers[static_cast<std::size_t>(found)].evaluator ==
                                         Evaluator::kMeshWalk;
    return walks ? found : -1;
}

/// Lets every isosurface from `first` on that fits be drawn with layer `host`. Returns how many.
int join(const scene::Scene& scene, FramePlan& frame, std::size_t host, std::size_t first) {
    int joined = 0;
    const Layer* lead = nullptr;
    for (std::size_t i = first; i < scene.layers.size(); ++i) {
        const Layer& layer = scene.layers[i];
        if (i == host || !frame.layers[i].drawnWith.empty() ||
            !isPlainIsosurface(layer, frame.layers[i]) ||
            !mayWalk(layer, frame.layers[i], scene.layers[host]) ||
            !sameData(layer, scene.layers[host])) {
            continue;
        }
        const Layer& light = scene.layers[host].model == RayModel::kIsosurface ? scene.layers[host]
                             : lead == nullptr                                 ? layer
                                                                               : *lead;
        if (layer.headlight != light.headlight) continue;
        lead = &light;
        drawWith(frame.layers[i], scene.layers[host]);
        ++joined;
    }
    return joined;
}

bool anyOwnOpaque(const scene::Scene& scene, const FramePlan& frame) {
    for (std::size_t i = 0; i < scene.layers.size(); ++i) {
        if (frame.layers[i].drawn && frame.layers[i].drawnWith.empty() &&
            scene::row(scene.layers[i].model).opaque) {
            return true;
        }
    }
    return false;
}

void joinVolume(const scene::Scene& scene, FramePlan& frame, std::size_t volume) {
    const int joined = join(scene, frame, volume, 0);
    if (joined == 0) return;
    LayerPlan& plan = frame.layers[volume];
    set(plan, kLevelsInVolume, true,
        std::to_string(joined) + " isosurface layer(s) of the same field end this walk's rays");
    const bool lit = std::ranges::any_of(scene.layers, [&](const Layer& layer) {
        return layer.model == RayModel::kIsosurface && sameData(layer, scene.layers[volume]) &&
               layer.headlight;
    });
    set(plan, kEarlyStop, true, "an isosurface ends a ray");
    set(plan, kGradient, lit, lit ? "isosurfaces are lit from the eye" : "isosurfaces are unlit");
    if (!anyOwnOpaque(scene, frame)) {
        set(plan, kEndsAtSurfaces, false, "the opaque layers are in the same walk");
    }
}

}  // namespace

void shareWalks(const scene::Scene& scene, FramePlan& frame) {
    const int volume = onlyVolume(scene, frame);
    if (volume >= 0) joinVolume(scene, frame, static_cast<std::size_t>(volume));
    for (std::size_t i = 0; i < scene.layers.size(); ++i) {
        if (!frame.layers[i].drawnWith.empty() ||
            !isPlainIsosurface(scene.layers[i], frame.layers[i]) ||
            frame.layers[i].evaluator != Evaluator::kMeshWalk) {
            continue;
        }
        if (const int joined = join(scene, frame, i, i + 1); joined > 0) {
            set(frame.layers[i], kSharedWalk, true,
                "draws " + std::to_string(joined) + " more isosurface layer(s) of the same field");
        }
    }
}

}  // namespace volcast::plan
