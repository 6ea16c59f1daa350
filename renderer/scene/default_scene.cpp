#include "renderer/scene/default_scene.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

namespace volcast::scene {
namespace {

/// A number that belongs to some of the data, and how much of it.
struct Portion {
    double number = 0.0;
    double count = 0.0;
};

/// `of` (a value to a number) over the data; from the histogram.
template <class Function>
std::vector<Portion> portions(const data::FieldSummary& field, Function of) {
    const std::size_t bins = field.spread.histogram.size();
    std::vector<Portion> found;
    for (std::size_t i = 0; i < bins; ++i) {
        const double part = (static_cast<double>(i) + 0.5) / static_cast<double>(bins);
        const double value = std::lerp(static_cast<double>(field.spread.usual.min),
                                       static_cast<double>(field.spread.usual.max), part);
        found.push_back({.number = static_cast<double>(of(static_cast<float>(value))),
                         .count = static_cast<double>(field.spread.histogram[i])});
    }
    return found;
}

double countOf(const std::vector<Portion>& all) {
    return std::accumulate(all.begin(), all.end(), 0.0,
                           [](double sum, const Portion& portion) { return sum + portion.count; });
}

/// 1 where there is no data.
double mean(const std::vector<Portion>& all) {
    double sum = 0.0;
    for (const Portion& portion : all) sum += portion.number * portion.count;
    const double count = countOf(all);
    return count > 0.0 ? sum / count : 1.0;
}

/// The mean on a ray through the middle of the densest body in the data. If a share p of the data,
/// of the largest numbers, is one compact body, that takes the cube root of p of the ray. 1 where
/// there is no data.
double densest(std::vector<Portion> all) {
    std::ranges::sort(all, std::ranges::greater{}, &Portion::number);
    const double count = countOf(all);
    double sum = 0.0, taken = 0.0, found = 0.0;
    for (const Portion& portion : all) {
        sum += portion.number * portion.count;
        taken += portion.count;
        if (taken > 0.0) found = std::max(found, sum / taken * std::cbrt(taken / count));
    }
    return count > 0.0 ? found : 1.0;
}

/// How far a ray runs through the data, world units: the side of a cube of the same size as the
/// bounds, or a tenth of their mean side where they are thin.
double lengthThrough(const data::Box& bounds) {
    const glm::dvec3 side = bounds.max - bounds.min;
    return std::max(std::cbrt(side.x * side.y * side.z), (side.x + side.y + side.z) / 30.0);
}

/// The length that is to be half opaque at the middle of the range, so that a ray through all of
/// the data meets an optical depth of about kDepth. Extinction rises linearly, so the mean is
/// 2 ln 2 / length * (mean of the field as a part of its usual range). Data that is nearly all at
/// one end of it is not followed beyond kLeast and kMost.
double halfOpaqueLength(const data::Box& bounds, const data::FieldSummary& field) {
    constexpr double kDepth = 2.0;
    constexpr double kLeast = 0.05;
    constexpr double kMost = 0.5;
    const double min = field.spread.usual.min;
    const double width = static_cast<double>(field.spread.usual.max) - min;
    const double fraction = mean(
        portions(field, [&](float value) { return width > 0.0 ? (value - min) / width : 0.5; }));
    return 2.0 * std::log(2.0) * lengthThrough(bounds) * std::clamp(fraction, kLeast, kMost) /
           kDepth;
}

const data::FieldSummary* fieldNamed(const data::DatasetSummary& summary, const std::string& name) {
    const auto found = std::ranges::find(summary.fields, name, &data::FieldSummary::name);
    if (found != summary.fields.end()) return &*found;
    return summary.fields.empty() ? nullptr : &summary.fields.front();
}

}  // namespace

void expose(Layer& layer, const data::DatasetSummary& summary) {
    constexpr double kXrayDepth = 1.5;  // exp(-1.5) = 0.22: dark, and not yet black.
    constexpr double kSplatLight = 0.7;
    constexpr double kMostStops = 64.0;
    const data::FieldSummary* f = fieldNamed(summary, layer.field);
    if (f == nullptr || layer.map.points.empty()) return;
    const bool second = !layer.densityField.empty();
    const data::FieldSummary& g = second ? *fieldNamed(summary, layer.densityField) : *f;
    const data::TransferFunction& density =
        second && !layer.densityMap.points.empty() ? layer.densityMap : layer.map;
    const double through = lengthThrough(summary.bounds);
    const double depth =
        through *
        densest(portions(g, [&](float value) { return data::evaluate(density, value).a; }));
    const double scale = kXrayDepth / depth;
    layer.extinctionScale = std::isfinite(scale) && scale < 1e30 ? static_cast<float>(scale) : 1.0F;
    const double light = through * densest(portions(*f, [&](float value) {
                             const glm::vec4 colour = data::evaluate(layer.map, value);
                             return std::max({colour.r, colour.g, colour.b});
                         }));
    const double stops = std::log2(kSplatLight / light);
    layer.exposure = std::isfinite(stops)
                         ? static_cast<float>(std::clamp(stops, -kMostStops, kMostStops))
                         : 0.0F;
}

Layer defaultLayer(const std::string& datasetId, const data::DatasetSummary& summary,
                   const std::string& field, RayModel model) {
    Layer layer;
    layer.id = "main";
    layer.dataset = datasetId;
    layer.model = model;
    const data::FieldSummary* shown = fieldNamed(summary, field);
    if (shown == nullptr) return layer;
    layer.field = shown->name;
    layer.map = data::defaultTransferFunction(shown->spread.usual,
                                              halfOpaqueLength(summary.bounds, *shown));
    layer.coloured = model == RayModel::kSurface || model == RayModel::kWireframe;
    layer.levels.values = {std::midpoint(shown->spread.usual.min, shown->spread.usual.max)};
    expose(layer, summary);
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
