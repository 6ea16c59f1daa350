#include "renderer/scene/layer_fields.h"

#include <algorithm>
#include <cmath>

#include "renderer/scene/ray_models.h"
#include "renderer/scene/scale.h"

namespace volcast::scene {
namespace {

constexpr double kMostExtinction = 1e30;  // Far beyond opaque in any unit; its sums stay finite.

bool readsDensityAlone(const Layer& layer) {
    return layer.model == RayModel::kXray && !layer.densityField.empty() && !layer.interval;
}

}  // namespace

data::TransferFunction withGain(data::TransferFunction map, float gain) {
    const double factor = std::exp(static_cast<double>(gain));
    for (data::ControlPoint& point : map.points) {
        point.extinction = static_cast<float>(std::min(point.extinction * factor, kMostExtinction));
    }
    return map;
}

const data::FieldSummary* findField(const data::DatasetSummary& summary, const std::string& name) {
    if (summary.fields.empty()) return nullptr;
    const auto found = std::ranges::find(summary.fields, name, &data::FieldSummary::name);
    return found == summary.fields.end() ? &summary.fields.front() : &*found;
}

FieldUse mainField(const Layer& layer, const data::DatasetSummary& summary) {
    if (readsDensityAlone(layer)) {
        return {.field = findField(summary, layer.densityField), .scale = layer.densityScale};
    }
    return {.field = findField(summary, layer.field), .scale = layer.scale};
}

FieldUse asStored(const data::FieldSummary& field) {
    // Nothing is taken off values whose domain is not far from 0.
    const float far = std::max(std::abs(field.range.min), std::abs(field.range.max));
    Scale scale;
    if (far > 0.0F) scale.domain = data::Range{.min = -far, .max = far};
    return {.field = &field, .scale = scale};
}

std::optional<FieldUse> secondField(const Layer& layer, const data::DatasetSummary& summary) {
    if (!row(layer.model).secondField || readsDensityAlone(layer) || layer.densityField.empty()) {
        return std::nullopt;
    }
    const FieldUse second{.field = findField(summary, layer.densityField),
                          .scale = layer.densityScale};
    const FieldUse first = mainField(layer, summary);
    if (second.field == first.field && second.scale == first.scale) return std::nullopt;
    return second;
}

LayerMaps layerMaps(const Layer& layer, const data::DatasetSummary& summary) {
    const FieldUse use = mainField(layer, summary);
    const data::Range none{};
    const ScaleFunction scale{use.scale, use.field == nullptr ? none : use.field->range};
    const bool hasDensityMap = !layer.densityMap.points.empty();
    if (layer.gain != 0.0F && layer.model == RayModel::kVolume) {
        Layer gained = layer;
        gained.gain = 0.0F;
        for (data::TransferFunction* map : {&gained.map, &gained.densityMap})
            *map = withGain(*map, layer.gain);
        return layerMaps(gained, summary);
    }
    if (!row(layer.model).secondField) return {.main = scaled(layer.map, scale), .density = {}};
    const std::optional<FieldUse> second = secondField(layer, summary);
    if (layer.model == RayModel::kXray && !second) {
        return {.main = scaled(hasDensityMap ? layer.densityMap : layer.map, scale), .density = {}};
    }
    LayerMaps maps{.main = scaled(layer.map, scale), .density = {}};
    if (!second && !hasDensityMap) return maps;
    const FieldUse density = second.value_or(use);
    maps.density = scaled(hasDensityMap ? layer.densityMap : layer.map,
                          {density.scale, density.field == nullptr ? none : density.field->range});
    return maps;
}

}  // namespace volcast::scene
