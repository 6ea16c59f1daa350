#include "renderer/plan/plan.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <span>

#include "renderer/plan/effects.h"
#include "renderer/plan/matter.h"
#include "renderer/plan/shared_walks.h"
#include "renderer/scene/channels.h"
#include "renderer/scene/layer_fields.h"
#include "renderer/scene/ray_models.h"
#include "renderer/scene/scale.h"

namespace volcast::plan {
namespace {

using data::DatasetSummary;
using scene::Layer;
using scene::RayModel;

void planVisible(LayerPlan& plan, const Matter& matter) {
    if (!matter.layer.visible) {
        plan.drawn = false;
        add(plan, kVisible, false, "the layer is hidden");
    } else if (!matter.layer.channels.empty() && scene::shownChannels(matter.layer).empty()) {
        plan.drawn = false;
        add(plan, kVisible, false, "all of its channels are hidden");
    } else if (matter.layer.model == RayModel::kCrossSections &&
               !glm::any(matter.layer.crossSections.shown)) {
        plan.drawn = false;
        add(plan, kVisible, false, "none of the three planes is shown");
    } else if (!matter.layer.shader.code.empty()) {
        add(plan, kVisible, true, "nobody knows what the code shows before it runs");
    } else if (matter.layer.model == RayModel::kVolume && matter.extinction.max <= 0.0F) {
        plan.drawn = false;
        add(plan, kVisible, false,
            "the map has no extinction in the data's range, " + number(matter.field->range.min) +
                " to " + number(matter.field->range.max));
    } else if (matter.layer.model == RayModel::kIsosurface &&
               scene::levelsOf(matter.layer).empty()) {
        plan.drawn = false;
        add(plan, kVisible, false, "no level is in the interval");
    } else {
        add(plan, kVisible, true, "the layer is shown");
    }
}

/// Cells that are left out: not marked, or without a value.
void planCells(LayerPlan& plan, const Matter& matter) {
    if (!matter.summary.isMesh) return;
    std::uint64_t without = 0;
    if (scene::needsField(matter.layer) && matter.field != nullptr) {
        without = matter.field->cellsWithoutValue;
        if (matter.second) without += matter.second->field->cellsWithoutValue;
    }
    const bool marked = !matter.layer.markers.field.empty();
    std::string reason = "all cells are drawn";
    if (marked) reason = "only cells marked in \"" + matter.layer.markers.field + "\" are drawn";
    if (without > 0) {
        reason = (marked ? reason + "; " : std::string{}) + std::to_string(without) +
                 " cell(s) without a value (NaN) are left out";
    }
    add(plan, kCellsLeftOut, marked || without > 0, reason);
}

void planSelection(LayerPlan& plan, const Matter& matter, const scene::Scene& scene) {
    const Layer& layer = matter.layer;
    // Of isosurfaces the levels are chosen by it once; rays need not look.
    const bool interval = layer.interval && layer.model != RayModel::kIsosurface;
    const std::vector<const scene::ChannelMap*> shown = scene::shownChannels(layer);
    const auto cut = std::ranges::count_if(
        shown, [](const scene::ChannelMap* channel) { return channel->interval.has_value(); });
    add(plan, kInterval, interval || cut > 0,
        cut > 0    ? "of " + std::to_string(cut) + " channel(s) only values in an interval count"
        : interval ? "only values from " + number(layer.interval->min) + " to " +
                         number(layer.interval->max) + " count"
        : layer.interval ? "levels outside of it are left out"
                         : "all values count");
    const std::size_t planes = scene.clipPlanes.size();
    add(plan, kClipPlanes, planes > 0,
        planes > 0 ? std::to_string(planes) + " plane(s) cut the data" : "no plane cuts the data");
    planCells(plan, matter);
    const bool scaled = scene::mainField(layer, matter.summary).scale != scene::Scale{};
    add(plan, kScale, scaled,
        scaled ? "values are scaled once, when they are uploaded" : "values are taken as they are");
}

void planCamera(LayerPlan& plan, const Matter& matter, const scene::Camera& camera) {
    const data::Box& box = matter.summary.bounds;
    const bool inside = glm::all(glm::greaterThanEqual(camera.eye, box.min)) &&
                        glm::all(glm::lessThanEqual(camera.eye, box.max));
    // Rays of an orthographic camera start on a plane, which may cut the data anywhere.
    const bool plane = camera.projection == scene::Projection::kOrthographic &&
                       glm::length(camera.eye - 0.5 * (box.min + box.max)) < matter.diagonal;
    add(plan, kCameraInside, inside || plane,
        inside  ? "the eye is within the bounds"
        : plane ? "the plane of the eye may cut the bounds"
                : "the eye is outside the bounds");
}

LayerPlan planLayer(const scene::Scene& scene, const Layer& layer, const DatasetSummary& summary,
                    bool hasSurfaces, std::span<const Evidence> evidence, const Limits& limits,
                    const Residency& all) {
    const Matter matter = matterOf(layer, summary);
    LayerPlan plan;
    plan.layer = layer.id;
    planVisible(plan, matter);
    planSelection(plan, matter, scene);
    const scene::RayModelRow& row = scene::row(layer.model);
    if (layer.model == RayModel::kCrossSections) {
        planCrossSections(plan, matter);
        planResidency(plan, matter, limits, all);
        planCamera(plan, matter, scene.camera);
        return plan;
    }
    if (row.chunk.empty()) {
        planSurface(plan, matter);
        return plan;
    }
    if (summary.isMesh) {
        planMeshRays(plan, matter, scene, evidence);
    } else {
        planVoxels(plan, matter, scene, evidence);
        planResidency(plan, matter, limits, all);
    }
    planCamera(plan, matter, scene.camera);
    if (row.opaque) {
        add(plan, kEndsAtSurfaces, false, "opaque layers share one depth");
        return plan;
    }
    add(plan, kEndsAtSurfaces, hasSurfaces,
        hasSurfaces ? "an opaque layer may stand in the way" : "the scene has no opaque layer");
    return plan;
}

/// FNV-1a over all that a plan says.
class Hash {
public:
    void add(const std::string& text) {
        for (const char c : text) mix(static_cast<unsigned char>(c));
        mix(0);
    }
    [[nodiscard]] std::string text() const {
        std::array<char, 17> digits{};
        std::snprintf(digits.data(), digits.size(), "%016llx",
                      static_cast<unsigned long long>(value_));
        return std::string{digits.data()}.substr(0, 12);
    }

private:
    void mix(unsigned char byte) { value_ = (value_ ^ byte) * 1099511628211ULL; }
    std::uint64_t value_ = 14695981039346656037ULL;
};

std::string idOf(const std::vector<LayerPlan>& layers) {
    Hash hash;
    for (const LayerPlan& layer : layers) {
        hash.add(layer.layer);
        hash.add(std::to_string(static_cast<int>(layer.evaluator)));
        hash.add(layer.integrator);
        hash.add(number(layer.stepWorld));
        hash.add(layer.drawn ? "drawn" : "left out");
        hash.add(layer.drawnWith);
        for (const Effect& effect : layer.effects) {
            hash.add(effect.name);
            hash.add(effect.on ? "on" : "off");
            hash.add(effect.reason);
        }
    }
    return hash.text();
}

}  // namespace

bool LayerPlan::has(const std::string& name) const {
    return std::ranges::any_of(
        effects, [&](const Effect& effect) { return effect.name == name && effect.on; });
}

FramePlan plan(const scene::Scene& scene, const scene::Summaries& summaries,
               const SceneEvidence& evidence, const Limits& limits) {
    const bool hasSurfaces = std::ranges::any_of(scene.layers, [](const Layer& layer) {
        return layer.visible && scene::row(layer.model).opaque;
    });
    const Residency all = residencyOf(scene, summaries);
    FramePlan frame;
    for (const Layer& layer : scene.layers) {
        const auto known = evidence.find(layer.id);
        frame.layers.push_back(planLayer(
            scene, layer, summaries.at(layer.dataset), hasSurfaces,
            known == evidence.end() ? std::span<const Evidence>{} : known->second, limits, all));
    }
    shareWalks(scene, frame);
    frame.id = idOf(frame.layers);
    return frame;
}

}  // namespace volcast::plan
