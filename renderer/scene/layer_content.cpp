#include "renderer/scene/layer_content.h"

#include <algorithm>

#include "renderer/plan/effects.h"
#include "renderer/scene/layer_fields.h"
#include "renderer/scene/scale.h"

namespace volcast::scene {
namespace {

/// The levels of one isosurface layer in the colours of its map.
void appendLevels(const Layer& layer, const data::DatasetSummary& summary,
                  std::vector<LevelColour>& levels) {
    const FieldUse use = mainField(layer, summary);
    const ScaleFunction scale{use.scale, use.field->range};
    const data::TransferFunction map = scaled(layer.map, scale);
    for (const float level : levelsOf(layer)) {
        const float value = scale.ofPoint(level);
        levels.push_back({.value = value, .colour = glm::vec3(data::evaluate(map, value))});
    }
}

}  // namespace

MapContent layerContent(const Layer& layer, const plan::LayerPlan& plan,
                        std::span<const Layer> layers, std::span<const plan::LayerPlan> plans,
                        const data::DatasetSummary& summary) {
    LayerMaps maps = layerMaps(layer, summary);
    MapContent content{.map = std::move(maps.main), .densityMap = std::move(maps.density)};
    if (layer.model == RayModel::kIsosurface) appendLevels(layer, summary, content.levels);
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (plans[i].drawnWith == layer.id) appendLevels(layers[i], summary, content.levels);
    }
    // Of equal levels the first layer's colour counts.
    std::ranges::stable_sort(content.levels, {}, &LevelColour::value);
    const auto sameValue = [](const auto& a, const auto& b) { return a.value == b.value; };
    content.levels.erase(std::unique(content.levels.begin(), content.levels.end(), sameValue),
                         content.levels.end());
    content.largestColours =
        layer.model == RayModel::kMipColour && plan.method == Integrator::kExact;
    content.preintegrated = plan.method == Integrator::kPreintegrated;
    return content;
}

}  // namespace volcast::scene
