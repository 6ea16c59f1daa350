#include "renderer/pick/picker.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "renderer/pick/jitter.h"
#include "renderer/pick/mesh_look.h"
#include "renderer/pick/voxel_look.h"
#include "renderer/plan/effects.h"
#include "renderer/plan/plan.h"
#include "renderer/reference/reference.h"
#include "renderer/scene/ray_models.h"
#include "renderer/scene/validate.h"

namespace volcast::pick {

namespace {

/// What a layer shows, and how much of it is left behind the layers over it.
struct Candidate {
    std::size_t layer = 0;
    Look look;
    double left = 1.0;

    [[nodiscard]] double share() const {
        const glm::dvec4& c = look.shown;
        return left * std::max({c.r, c.g, c.b, c.a});
    }
};

Result<void> checkPixel(scene::PictureSize size, glm::ivec2 pixel) {
    if (pixel.x >= 0 && pixel.y >= 0 && pixel.x < size.x && pixel.y < size.y) return {};
    return fail(ErrorCode::kInvalidArgument,
                "pixel: " + std::to_string(pixel.x) + ", " + std::to_string(pixel.y) +
                    " lies outside of a picture of " + std::to_string(size.x) + " x " +
                    std::to_string(size.y),
                "pixel");
}

}  // namespace

void Picker::forget(const std::string& dataset) {
    known_.erase(dataset);
    bodies_.erase(dataset);
    prepared_ = false;
}

Result<void> Picker::prepare(const scene::Scene& scene, const Datasets& datasets) {
    if (prepared_ && scene.layers == layers_) return {};
    prepared_ = false;
    scene::Summaries summaries;
    for (const scene::Layer& layer : scene.layers) {
        Known& known = known_[layer.dataset];
        if (known.dataset == nullptr) known.dataset = datasets(layer.dataset);
        if (known.dataset == nullptr) {
            known_.erase(layer.dataset);
            continue;
        }
        if (known.summary.fields.empty()) known.summary = data::summarize(*known.dataset);
        summaries.emplace(layer.dataset, known.summary);
        if (known.summary.isMesh && !bodies_.contains(layer.dataset)) {
            bodies_.emplace(layer.dataset, reference::makeBody(*known.dataset));
        }
    }
    if (auto valid = scene::validate(scene, summaries); !valid) return valid;
    layers_ = scene.layers;
    meshLayers_.assign(layers_.size(), {});
    for (std::size_t i = 0; i < layers_.size(); ++i) {
        if (!layers_[i].visible || !known_[layers_[i].dataset].summary.isMesh) continue;
        auto data = reference::prepare(layers_[i], bodies_, "layers[" + std::to_string(i) + "]");
        if (!data) return data.error();
        meshLayers_[i] = *std::move(data);
    }
    prepared_ = true;
    return {};
}

/// Steps of the march, which may depend on the camera.
void Picker::planSteps(const scene::Scene& scene) {
    scene::Summaries summaries;
    for (const scene::Layer& layer : layers_) {
        summaries.emplace(layer.dataset, known_[layer.dataset].summary);
    }
    const plan::FramePlan plan = plan::plan(scene, summaries, {});
    sampled_.clear();
    for (const plan::LayerPlan& layer : plan.layers) {
        sampled_.push_back({.stepWorld = layer.stepWorld, .jitters = layer.has(plan::kJitter)});
    }
}

Result<std::optional<scene::Picked>> Picker::pick(const scene::Scene& scene,
                                                  scene::PictureSize size, glm::ivec2 pixel,
                                                  const Datasets& datasets) {
    Result<void> good = scene::validate(size);
    if (good) good = checkPixel(size, pixel);
    if (good) good = scene::validate(scene);
    if (good) good = prepare(scene, datasets);
    if (!good) return good.error();
    planSteps(scene);
    const reference::Lens lens{scene.camera, size};
    const reference::Ray ray = lens.through(glm::dvec2{pixel} + 0.5);
    reference::Span span = reference::keptBy(scene.clipPlanes, ray);
    const auto look = [&](std::size_t i) -> std::optional<Look> {
        const data::Dataset& dataset = *known_[layers_[i].dataset].dataset;
        if (const auto* volume = std::get_if<data::Volume>(&dataset)) {
            Steps steps{.world = sampled_[i].stepWorld};
            if (sampled_[i].jitters) steps.share = jitterOf(pixel, *layers_[i].jitter);
            return lookAt(*volume, layers_[i], steps, ray, span);
        }
        return lookAt(meshLayers_[i], ray, span, scratch_);
    };
    std::vector<Candidate> candidates;
    for (const bool opaque : {true, false}) {
        for (std::size_t i = 0; i < layers_.size(); ++i) {
            const scene::Layer& layer = layers_[i];
            if (!layer.visible || !layer.shader.code.empty()) continue;
            if (scene::row(layer.model).opaque != opaque) continue;
            auto found = look(i);
            if (!found) continue;
            if (opaque) {
                // Of layers at the same depth the first is seen.
                if (!candidates.empty() && found->place.distance >= span.end) continue;
                candidates.clear();
                span.end = std::min(span.end, found->place.distance);
            }
            for (Candidate& under : candidates) under.left *= 1.0 - found->shown.a;
            candidates.push_back({.layer = i, .look = *std::move(found)});
        }
    }
    const auto best = std::ranges::max_element(candidates, {}, &Candidate::share);
    if (best == candidates.end()) return std::optional<scene::Picked>{};
    scene::Picked picked = std::move(best->look.place);
    picked.layer = layers_[best->layer].id;
    return std::optional{std::move(picked)};
}

}  // namespace volcast::pick
