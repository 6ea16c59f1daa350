#include "renderer/plan/plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "renderer/plan/effects.h"

namespace volcast::plan {
namespace {

using data::DatasetSummary;
using data::FieldSummary;
using scene::Layer;
using scene::RayModel;

std::string number(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.4g", value);
    return text.data();
}

/// Smallest and largest extinction that the map gives to values in `range`.
data::Range extinctionOver(const data::TransferFunction& map, data::Range range) {
    const float first = data::evaluate(map, range.min).a;
    data::Range found{.min = first, .max = first};
    const auto include = [&found](float extinction) {
        found.min = std::min(found.min, extinction);
        found.max = std::max(found.max, extinction);
    };
    include(data::evaluate(map, range.max).a);
    for (const data::ControlPoint& point : map.points) {
        if (point.value >= range.min && point.value <= range.max) include(point.extinction);
    }
    return found;
}

const FieldSummary* fieldOf(const Layer& layer, const DatasetSummary& summary) {
    if (summary.fields.empty()) return nullptr;
    const auto found = std::ranges::find(summary.fields, layer.field, &FieldSummary::name);
    return found == summary.fields.end() ? &summary.fields.front() : &*found;
}

void add(LayerPlan& plan, const char* name, bool on, std::string reason) {
    plan.effects.push_back({.name = name, .on = on, .reason = std::move(reason)});
}

/// What the rays of one layer meet.
struct Matter {
    const Layer& layer;
    const DatasetSummary& summary;
    const FieldSummary* field;
    data::Range extinction;  // Of the field's values; volume model only.
    double diagonal;         // Of the bounds, world units.
};

void planVisible(LayerPlan& plan, const Matter& matter) {
    if (!matter.layer.visible) {
        plan.drawn = false;
        add(plan, kVisible, false, "the layer is hidden");
    } else if (matter.layer.model == RayModel::kVolume && matter.extinction.max <= 0.0F) {
        plan.drawn = false;
        add(plan, kVisible, false,
            "the map has no extinction in the data's range, " + number(matter.field->range.min) +
                " to " + number(matter.field->range.max));
    } else {
        add(plan, kVisible, true, "the layer is shown");
    }
}

void planEarlyStop(LayerPlan& plan, const Matter& matter) {
    // Opacity 1 - 1e-6 is the depth at which model/volume.glsl calls a ray finished.
    constexpr double kFinishedDepth = 13.8;
    const double depth = static_cast<double>(matter.extinction.max) * matter.diagonal;
    if (matter.layer.model != RayModel::kVolume) {
        add(plan, kEarlyStop, false, "a larger value may come until the ray's end");
    } else if (depth < kFinishedDepth) {
        add(plan, kEarlyStop, false,
            "the deepest ray has an optical depth of " + number(depth) +
                " at most and stays translucent");
    } else {
        add(plan, kEarlyStop, true, "rays may become opaque on their way");
    }
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

void planMeshRays(LayerPlan& plan, const Matter& matter) {
    plan.evaluator = Evaluator::kMeshWalk;
    if (matter.layer.model == RayModel::kVolume) plan.integrator = "average";
    const bool constant = matter.field->association == data::Association::kCell;
    add(plan, kInterpolation, !constant,
        constant ? "one value a cell, so the average is exact" : "values vary within a cell");
    add(plan, kReEntry, !matter.summary.convex,
        matter.summary.convex ? "the mesh is convex: a ray leaves it once"
                              : "the mesh is not convex: rays may come back");
    planEarlyStop(plan, matter);
}

void planSurface(LayerPlan& plan, const Matter& matter) {
    plan.evaluator = Evaluator::kMeshRaster;
    const Layer& layer = matter.layer;
    add(plan, kColourByValue, layer.coloured,
        layer.coloured ? "coloured by the field" : "one colour, so no field is needed");
    add(plan, kHeadlight, layer.headlight,
        layer.headlight ? "lit from the eye" : "unlit, so no normals are needed");
    const bool varies = layer.coloured && matter.field != nullptr &&
                        matter.field->association != data::Association::kCell;
    add(plan, kInterpolation, varies, varies ? "values vary on a face" : "one colour on each face");
}

void planStep(LayerPlan& plan, const Matter& matter) {
    const glm::dvec3 spacing = matter.summary.spacing;
    const double wanted = matter.layer.stepWorld > 0.0
                              ? matter.layer.stepWorld
                              : 0.5 * std::min({spacing.x, spacing.y, spacing.z});
    const double longest = glm::length(spacing * glm::dvec3(matter.summary.voxels - 1));
    const double smallest = longest / kMaxRaySamples;
    plan.stepWorld = std::max(wanted, smallest);
    const bool enlarged = wanted < smallest;
    add(plan, kStepEnlarged, enlarged,
        enlarged
            ? "a step of " + number(wanted) + " needs more than " + std::to_string(kMaxRaySamples) +
                  " samples on a ray: drawn with " + number(smallest)
            : "the step is as asked for");
}

void planBricks(LayerPlan& plan, const Matter& matter) {
    const glm::ivec3 intervals = matter.summary.voxels - 1;
    const bool several =
        std::max({intervals.x, intervals.y, intervals.z}) > data::Volume::kBrickSize;
    if (!several) {
        add(plan, kEmptyBricks, false, "the volume is a single brick");
    } else if (matter.layer.model == RayModel::kMip) {
        add(plan, kEmptyBricks, true, "a brick that cannot raise the maximum is passed over");
    } else if (matter.extinction.min > 0.0F) {
        add(plan, kEmptyBricks, false, "the map has extinction everywhere in the data's range");
    } else {
        add(plan, kEmptyBricks, true, "the map has no extinction in a part of the data's range");
    }
}

void planVoxels(LayerPlan& plan, const Matter& matter) {
    plan.evaluator = Evaluator::kVolumeMarch;
    plan.integrator = "march";
    const bool trilinear = matter.layer.sampling == scene::Sampling::kTrilinear;
    add(plan, kInterpolation, trilinear,
        trilinear ? "trilinear between grid points" : "the nearest grid point's value");
    planStep(plan, matter);
    planBricks(plan, matter);
    planEarlyStop(plan, matter);
}

LayerPlan planLayer(const scene::Scene& scene, const Layer& layer, const DatasetSummary& summary,
                    bool hasSurfaces) {
    Matter matter{.layer = layer,
                  .summary = summary,
                  .field = fieldOf(layer, summary),
                  .extinction = {},
                  .diagonal = glm::length(summary.bounds.max - summary.bounds.min)};
    if (layer.model == RayModel::kVolume && matter.field != nullptr) {
        matter.extinction = extinctionOver(layer.map, matter.field->range);
    }
    LayerPlan plan;
    plan.layer = layer.id;
    planVisible(plan, matter);
    if (layer.model == RayModel::kSurface) {
        planSurface(plan, matter);
        return plan;
    }
    if (summary.isMesh) {
        planMeshRays(plan, matter);
    } else {
        planVoxels(plan, matter);
    }
    planCamera(plan, matter, scene.camera);
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

FramePlan plan(const scene::Scene& scene, const scene::Summaries& summaries) {
    const bool hasSurfaces = std::ranges::any_of(scene.layers, [](const Layer& layer) {
        return layer.visible && layer.model == RayModel::kSurface;
    });
    FramePlan frame;
    for (const Layer& layer : scene.layers) {
        frame.layers.push_back(planLayer(scene, layer, summaries.at(layer.dataset), hasSurfaces));
    }
    frame.id = idOf(frame.layers);
    return frame;
}

}  // namespace volcast::plan
