#include "renderer/scene/default_scene.h"

#include <algorithm>

namespace volcast::scene {
namespace {

/// How far a ray goes through what is of interest: a third of the mean side, because features
/// commonly fill a part of the bounds. With the whole side first pictures come out too dark.
double typicalLength(const data::Box& bounds) {
    const glm::dvec3 side = bounds.max - bounds.min;
    return (side.x + side.y + side.z) / 9.0;
}

}  // namespace

Layer defaultLayer(const std::string& datasetId, const data::DatasetSummary& summary,
                   const std::string& field, RayModel model) {
    Layer layer;
    layer.id = "main";
    layer.dataset = datasetId;
    layer.model = model;
    if (summary.fields.empty()) return layer;
    const auto named = std::ranges::find(summary.fields, field, &data::FieldSummary::name);
    const data::FieldSummary& shown =
        named == summary.fields.end() ? summary.fields.front() : *named;
    layer.field = shown.name;
    layer.map = data::defaultTransferFunction(shown.range, typicalLength(summary.bounds));
    layer.coloured = model == RayModel::kSurface;
    return layer;
}

Scene defaultScene(const std::string& datasetId, const data::DatasetSummary& summary) {
    Scene scene;
    scene.camera = fit(summary.bounds);
    const bool surface = summary.isMesh && summary.fields.empty();
    scene.layers.push_back(defaultLayer(datasetId, summary,
                                        summary.fields.empty() ? "" : summary.fields.front().name,
                                        surface ? RayModel::kSurface : RayModel::kVolume));
    return scene;
}

}  // namespace volcast::scene
