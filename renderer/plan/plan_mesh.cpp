#include <algorithm>

#include "renderer/plan/effects.h"
#include "renderer/plan/matter.h"
#include "renderer/plan/method.h"
#include "renderer/scene/ray_models.h"
#include "renderer/scene/scale.h"

namespace volcast::plan {
namespace {

using scene::Layer;
using scene::RayModel;

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

void planMethod(LayerPlan& plan, const Matter& matter, const scene::Accuracy& wish,
                std::span<const Evidence> evidence) {
    const bool constant = !varies(matter.field) && !(matter.second && varies(matter.second->field));
    const Method method = chooseMethod(matter.layer, scene::row(matter.layer.model).integrators,
                                       wish, constant, evidence);
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

void planSecondField(LayerPlan& plan, const Matter& matter) {
    const bool on = matter.second.has_value();
    add(plan, kSecondField, on,
        on ? "\"" + matter.second->field->name + "\" is the second field"
           : "one field serves for colour and extinction");
}

}  // namespace

void planMeshRays(LayerPlan& plan, const Matter& matter, const scene::Scene& scene,
                  std::span<const Evidence> evidence) {
    plan.evaluator = evaluatorFor(matter.layer);
    const bool constant = !varies(matter.field);
    add(plan, kInterpolation, !constant,
        constant ? "one value a cell" : "values vary within a cell");
    if (!matter.layer.shader.code.empty()) return planMeshCode(plan, matter, scene.camera);
    add(plan, kUserShader, false, "the map says what a ray gathers");
    planMethod(plan, matter, scene.accuracy, evidence);
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

}  // namespace volcast::plan
