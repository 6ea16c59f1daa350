#include "renderer/plan/plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <span>

#include "renderer/plan/effects.h"
#include "renderer/plan/method.h"
#include "renderer/plan/shared_walks.h"
#include "renderer/scene/layer_fields.h"
#include "renderer/scene/ray_models.h"
#include "renderer/scene/scale.h"

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

void add(LayerPlan& plan, const char* name, bool on, std::string reason) {
    plan.effects.push_back({.name = name, .on = on, .reason = std::move(reason)});
}

/// What the rays of one layer meet.
struct Matter {
    const Layer& layer;
    const DatasetSummary& summary;
    const FieldSummary* field;              // The one that rays carry.
    std::optional<scene::FieldUse> second;  // g, where it has values of its own.
    scene::LayerMaps maps;
    data::Range extinction;  // Of the field's values; volume and xray.
    double diagonal;         // Of the bounds, world units.
};

bool varies(const FieldSummary* field) {
    return field != nullptr && field->association != data::Association::kCell;
}

/// Smallest and largest extinction on any ray.
data::Range extinctionOf(const Matter& matter) {
    const bool own = !matter.maps.density.points.empty();
    const FieldSummary* field = matter.second ? matter.second->field : matter.field;
    if (field == nullptr) return {};
    const scene::Scale scale =
        matter.second ? matter.second->scale : scene::mainField(matter.layer, matter.summary).scale;
    const scene::ScaleFunction function{scale, field->range};
    data::Range range{.min = function.ofData(field->range.min),
                      .max = function.ofData(field->range.max)};
    if (!matter.summary.isMesh && matter.layer.sampling == scene::Sampling::kTricubic) {
        const float overshoot = kTricubicOvershoot * (range.max - range.min);
        range = {.min = range.min - overshoot, .max = range.max + overshoot};
    }
    return extinctionOver(own ? matter.maps.density : matter.maps.main, range);
}

bool absorbs(RayModel model) {
    return model == RayModel::kVolume || model == RayModel::kXray;
}

void planVisible(LayerPlan& plan, const Matter& matter) {
    if (!matter.layer.visible) {
        plan.drawn = false;
        add(plan, kVisible, false, "the layer is hidden");
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

void planEarlyStop(LayerPlan& plan, const Matter& matter) {
    // A little less than that of lib/finished.glsl.
    constexpr double kFinishedDepth = 13.8;
    const double depth = static_cast<double>(matter.extinction.max) * matter.diagonal;
    if (matter.layer.model == RayModel::kIsosurface) {
        add(plan, kEarlyStop, true, "the nearest level ends a ray");
    } else if (matter.layer.model != RayModel::kVolume) {
        add(plan, kEarlyStop, false, "what is gathered may grow until the ray's end");
    } else if (depth < kFinishedDepth) {
        add(plan, kEarlyStop, false,
            "the deepest ray has an optical depth of " + number(depth) +
                " at most and stays translucent");
    } else {
        add(plan, kEarlyStop, true, "rays may become opaque on their way");
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
    add(plan, kInterval, interval,
        interval ? "only values from " + number(layer.interval->min) + " to " +
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

void planSecondField(LayerPlan& plan, const Matter& matter) {
    const bool on = matter.second.has_value();
    add(plan, kSecondField, on,
        on ? "\"" + matter.second->field->name + "\" is the second field"
           : "one field serves for colour and extinction");
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

/// Each level is drawn by itself; a walk finds any number of them at once, but costs as much as
/// some ten of them.
constexpr std::size_t kMostLevelsDrawn = 8;

bool fewLevels(const Layer& layer) {
    return layer.model == RayModel::kIsosurface &&
           scene::levelsOf(layer).size() <= kMostLevelsDrawn;
}

Evaluator evaluatorFor(const Layer& layer) {
    switch (layer.evaluator) {
        case scene::MeshEvaluator::kAuto:
            return fewLevels(layer) ? Evaluator::kMeshProjection : Evaluator::kMeshWalk;
        case scene::MeshEvaluator::kProjection: return Evaluator::kMeshProjection;
        case scene::MeshEvaluator::kProjectionFaces: return Evaluator::kMeshProjectionFaces;
        case scene::MeshEvaluator::kWalk: break;
    }
    return Evaluator::kMeshWalk;
}

bool oneColour(const data::TransferFunction& map) {
    return std::ranges::all_of(map.points, [&map](const data::ControlPoint& point) {
        return point.colour == map.points.front().colour;
    });
}

/// What is known of the method chosen.
void planEvidence(LayerPlan& plan, std::span<const Evidence> evidence) {
    const auto known = std::ranges::find(evidence, plan.method, &Evidence::integrator);
    if (known == evidence.end()) return;
    plan.predictedMs = known->predictedMs;
    plan.errorBound = known->error;
}

void planMethod(LayerPlan& plan, const Matter& matter, const scene::Accuracy& wish,
                std::span<const Evidence> evidence) {
    const bool constant = !varies(matter.field) && !(matter.second && varies(matter.second->field));
    const Method method = chooseMethod(matter.layer, wish, constant, evidence);
    plan.method = method.integrator;
    planEvidence(plan, evidence);
    const bool choice = scene::row(matter.layer.model).integrators.size() > 1;
    if (choice) plan.integrator = scene::name(method.integrator);
    add(plan, kAccuracy, choice, method.reason);
    const bool splits = choice && matter.layer.model != RayModel::kMipColour &&
                        plan.method == scene::Integrator::kExact;
    add(plan, kSplitting, splits,
        splits ? "pieces are cut where a map bends" : "each cell's piece is taken whole");
    if (matter.layer.model != RayModel::kVolume) return;
    const bool uniform =
        splits && plan.evaluator == Evaluator::kMeshWalk && oneColour(matter.maps.main);
    add(plan, kColours, !uniform,
        uniform ? "the map has one colour: opacity alone is gathered" : "the map has colours");
}

void planHeadlight(LayerPlan& plan, const Layer& isosurface) {
    add(plan, kGradient, isosurface.headlight,
        isosurface.headlight ? "lit from the eye" : "unlit, so no gradient is needed");
}

void planMeshRays(LayerPlan& plan, const Matter& matter, const scene::Accuracy& wish,
                  std::span<const Evidence> evidence) {
    plan.evaluator = evaluatorFor(matter.layer);
    const bool constant = !varies(matter.field);
    add(plan, kInterpolation, !constant,
        constant ? "one value a cell" : "values vary within a cell");
    planMethod(plan, matter, wish, evidence);
    planSecondField(plan, matter);
    const bool levels = matter.layer.model == RayModel::kIsosurface;
    if (levels) {
        const bool own = plan.evaluator != Evaluator::kMeshWalk;
        add(plan, kCellsOfLevels, own,
            own ? "only cells that meet a level are drawn, by what it cuts out of them"
                : "one walk finds all levels");
    }
    if (plan.evaluator == Evaluator::kMeshWalk) {
        add(plan, kReEntry, !matter.summary.convex,
            matter.summary.convex ? "the mesh is convex: a ray leaves it once"
                                  : "the mesh is not convex: rays may come back");
    } else if (!levels) {
        const bool ordered = scene::row(matter.layer.model).combine == scene::Combine::kUnder;
        add(plan, kVisibilityOrder, ordered,
            ordered ? "cells are blended front to back" : "the order of cells makes no difference");
    }
    if (levels) planHeadlight(plan, matter.layer);
    planEarlyStop(plan, matter);
}

void planSurface(LayerPlan& plan, const Matter& matter) {
    plan.evaluator = Evaluator::kMeshRaster;
    const Layer& layer = matter.layer;
    add(plan, kColourByValue, layer.coloured,
        layer.coloured ? "coloured by the field" : "one colour, so no field is needed");
    add(plan, kHeadlight, layer.headlight,
        layer.headlight ? "lit from the eye" : "unlit, so no normals are needed");
    const bool interpolates = layer.coloured && varies(matter.field);
    add(plan, kInterpolation, interpolates,
        interpolates ? "values vary on a face" : "one colour on each face");
    const bool edges = layer.model == RayModel::kWireframe;
    add(plan, kEdges, edges, edges ? "edges are drawn over the faces" : "faces alone");
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

/// Why bricks can be passed over whatever the map; empty where they cannot.
std::string reasonToPassOver(RayModel model) {
    switch (model) {
        case RayModel::kMip: return "a brick that cannot raise the maximum is passed over";
        case RayModel::kMinip: return "a brick that cannot lower the minimum is passed over";
        case RayModel::kIsosurface: return "a brick between two levels is passed over";
        default: return {};
    }
}

void planBricks(LayerPlan& plan, const Matter& matter) {
    const glm::ivec3 intervals = matter.summary.voxels - 1;
    const bool several =
        std::max({intervals.x, intervals.y, intervals.z}) > data::Volume::kBrickSize;
    if (!several) {
        add(plan, kEmptyBricks, false, "the volume is a single brick");
    } else if (plan.has(kInterval)) {
        add(plan, kEmptyBricks, true, "a brick without values in the interval is passed over");
    } else if (!absorbs(matter.layer.model)) {
        const std::string reason = reasonToPassOver(matter.layer.model);
        add(plan, kEmptyBricks, !reason.empty(),
            reason.empty() ? "every value of a brick may add to the ray" : reason);
    } else if (matter.extinction.min > 0.0F) {
        add(plan, kEmptyBricks, false, "the map has extinction everywhere in the data's range");
    } else {
        add(plan, kEmptyBricks, true, "the map has no extinction in a part of the data's range");
    }
}

/// What the model does with samples: a sample's piece is constant, so that cheap ways are right.
scene::Integrator methodOfSamples(RayModel model, bool continuous) {
    const scene::Integrator cheapest = scene::row(model).integrators.front().integrator;
    // A field that is continuous has every value between those of its samples.
    return model == RayModel::kMipColour && continuous ? scene::Integrator::kExact : cheapest;
}

void planLight(LayerPlan& plan, const Layer& volume) {
    const bool lit = volume.light.has_value();
    add(plan, kLight, lit,
        !lit                     ? "matter emits its colour alone, so no gradient is needed"
        : volume.light->position ? "lit from a point of the world"
                                 : "lit from the eye");
}

void planVoxels(LayerPlan& plan, const Matter& matter) {
    plan.evaluator = Evaluator::kVolumeMarch;
    plan.integrator = "march";
    const bool interpolates = matter.layer.sampling != scene::Sampling::kNearest;
    plan.method = methodOfSamples(matter.layer.model, interpolates);
    add(plan, kInterpolation, interpolates,
        interpolates ? std::string{scene::name(matter.layer.sampling)} + " between grid points"
                     : "the nearest grid point's value");
    if (matter.layer.model == RayModel::kIsosurface) planHeadlight(plan, matter.layer);
    if (matter.layer.model == RayModel::kVolume) planLight(plan, matter.layer);
    planStep(plan, matter);
    planBricks(plan, matter);
    planEarlyStop(plan, matter);
}

LayerPlan planLayer(const scene::Scene& scene, const Layer& layer, const DatasetSummary& summary,
                    bool hasSurfaces, std::span<const Evidence> evidence) {
    Matter matter{.layer = layer,
                  .summary = summary,
                  .field = scene::mainField(layer, summary).field,
                  .second = scene::secondField(layer, summary),
                  .maps = scene::layerMaps(layer, summary),
                  .extinction = {},
                  .diagonal = glm::length(summary.bounds.max - summary.bounds.min)};
    if (absorbs(layer.model)) matter.extinction = extinctionOf(matter);
    LayerPlan plan;
    plan.layer = layer.id;
    planVisible(plan, matter);
    planSelection(plan, matter, scene);
    const scene::RayModelRow& row = scene::row(layer.model);
    if (row.chunk.empty()) {
        planSurface(plan, matter);
        return plan;
    }
    if (summary.isMesh) {
        planMeshRays(plan, matter, scene.accuracy, evidence);
    } else {
        planVoxels(plan, matter);
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
               const SceneEvidence& evidence) {
    const bool hasSurfaces = std::ranges::any_of(scene.layers, [](const Layer& layer) {
        return layer.visible && scene::row(layer.model).opaque;
    });
    FramePlan frame;
    for (const Layer& layer : scene.layers) {
        const auto known = evidence.find(layer.id);
        frame.layers.push_back(
            planLayer(scene, layer, summaries.at(layer.dataset), hasSurfaces,
                      known == evidence.end() ? std::span<const Evidence>{} : known->second));
    }
    shareWalks(scene, frame);
    frame.id = idOf(frame.layers);
    return frame;
}

}  // namespace volcast::plan
