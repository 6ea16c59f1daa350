#include "renderer/scene/default_scene.h"

#include <algorithm>
#include <cmath>

namespace volcast::scene {
namespace {

/// Mean of `field` over the data, as a part of its range; from the histogram.
double meanFraction(const data::FieldSummary& field) {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < field.histogram.size(); ++i) {
        sum += field.histogram[i] * (static_cast<double>(i) + 0.5);
        count += field.histogram[i];
    }
    return count > 0.0 ? sum / (count * static_cast<double>(field.histogram.size())) : 0.5;
}

/// The length that is to be half opaque at the middle of the range, so that a ray through all of
/// the data meets an optical depth of about kDepth. Extinction rises linearly, so the mean is
/// 2 ln 2 / length * meanFraction. Data that is nearly all at one end of its range is not followed
/// beyond kLeast and kMost.
double halfOpaqueLength(const data::Box& bounds, const data::FieldSummary& field) {
    constexpr double kDepth = 2.0;
    constexpr double kLeast = 0.05;
    constexpr double kMost = 0.5;
    const glm::dvec3 side = bounds.max - bounds.min;
    const double mean = (side.x + side.y + side.z) / 3.0;
    const double through = std::max(std::cbrt(side.x * side.y * side.z), mean / 10.0);
    return 2.0 * std::log(2.0) * through * std::clamp(meanFraction(field), kLeast, kMost) / kDepth;
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
    layer.map = data::defaultTransferFunction(shown.range, halfOpaqueLength(summary.bounds, shown));
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
