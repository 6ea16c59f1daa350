#include "renderer/scene/shown_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/plan/effects.h"
#include "renderer/scene/layer_fields.h"
#include "renderer/scene/scale.h"
#include "renderer/scene/user_controls.h"

namespace volcast::scene {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Adds [first, last] behind all others; nothing where that is empty.
void add(volume::ShownValues& shown, float first, float last) {
    if (!(first <= last)) return;
    if (!shown.empty() && first <= shown.back().y) {
        shown.back().y = std::max(shown.back().y, last);
    } else {
        shown.emplace_back(first, last);
    }
}

/// What of `shown` is in an interval.
volume::ShownValues within(const volume::ShownValues& shown, data::Range interval) {
    volume::ShownValues inside;
    for (const glm::vec2& part : shown) {
        add(inside, std::max(part.x, interval.min), std::min(part.y, interval.max));
    }
    return inside;
}

volume::ShownValues shownByModel(const Layer& layer, const data::DatasetSummary& summary) {
    if (runsUserCode(layer)) return kAllValues;
    if (layer.model == RayModel::kVolume || layer.model == RayModel::kXray) {
        const LayerMaps maps = layerMaps(layer, summary);
        return absorbingValues(maps.density.points.empty() ? maps.main : maps.density);
    }
    if (layer.model != RayModel::kIsosurface) return kAllValues;
    const FieldUse use = mainField(layer, summary);
    const ScaleFunction scale{use.scale, use.field->range};
    volume::ShownValues shown;
    for (const float level : levelsOf(layer)) {
        add(shown, scale.ofPoint(level), scale.ofPoint(level));
    }
    return shown;
}

}  // namespace

volume::ShownValues absorbingValues(const data::TransferFunction& map) {
    const std::vector<data::ControlPoint>& points = map.points;
    volume::ShownValues shown;
    if (points.front().extinction > 0.0F) add(shown, -kInfinity, points.front().value);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const data::ControlPoint &from = points[i], &to = points[i + 1];
        const bool begins = from.extinction > 0.0F, ends = to.extinction > 0.0F;
        if (!begins && !ends) continue;
        add(shown, begins ? from.value : std::nextafter(from.value, kInfinity),
            ends ? to.value : std::nextafter(to.value, -kInfinity));
    }
    if (points.back().extinction > 0.0F) add(shown, points.back().value, kInfinity);
    return shown;
}

volume::ShownValues shownValues(const Layer& layer, const plan::LayerPlan& plan,
                                const data::DatasetSummary& summary) {
    volume::ShownValues shown = shownByModel(layer, summary);
    if (!plan.has(plan::kInterval)) return shown;
    const ScaleFunction scale{layer.scale, findField(summary, layer.field)->range};
    return within(shown, {.min = scale.ofPoint(layer.interval->min),
                          .max = scale.ofPoint(layer.interval->max)});
}

volume::ShownValues shownValues(const DrawnChannel& channel) {
    const volume::ShownValues shown = absorbingValues(channel.map);
    return channel.interval ? within(shown, *channel.interval) : shown;
}

}  // namespace volcast::scene
