#include "renderer/plan/matter.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "renderer/plan/effects.h"
#include "renderer/scene/channels.h"
#include "renderer/scene/scale.h"

namespace volcast::plan {

using data::DatasetSummary;
using data::FieldSummary;
using scene::Layer;
using scene::RayModel;

std::string number(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.4g", value);
    return text.data();
}

void add(LayerPlan& plan, const char* name, bool on, std::string reason) {
    plan.effects.push_back({.name = name, .on = on, .reason = std::move(reason)});
}

bool varies(const FieldSummary* field) {
    return field != nullptr && field->association != data::Association::kCell;
}

bool absorbs(RayModel model) {
    return model == RayModel::kVolume || model == RayModel::kXray;
}

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

namespace {

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

/// Of all channels that are shown together.
data::Range extinctionOfChannels(const Layer& layer, const DatasetSummary& summary) {
    data::Range sum{.min = 0.0F, .max = 0.0F};
    for (const scene::ChannelMap* channel : scene::shownChannels(layer)) {
        const FieldSummary* field = scene::findField(summary, channel->field);
        data::Range range = field->range;
        if (layer.sampling == scene::Sampling::kTricubic) {
            const float overshoot = kTricubicOvershoot * (range.max - range.min);
            range = {.min = range.min - overshoot, .max = range.max + overshoot};
        }
        if (channel->interval) {
            range = {.min = std::max(range.min, channel->interval->min),
                     .max = std::min(range.max, channel->interval->max)};
            if (range.min > range.max) continue;
        }
        const data::TransferFunction map = layer.model == RayModel::kVolume
                                               ? scene::withGain(channel->map, layer.gain)
                                               : channel->map;
        const data::Range one = extinctionOver(map, range);
        sum.min += channel->interval ? 0.0F : one.min;
        sum.max += one.max;
    }
    return sum;
}

}  // namespace

Matter matterOf(const Layer& layer, const DatasetSummary& summary) {
    Matter matter{.layer = layer,
                  .summary = summary,
                  .field = scene::mainField(layer, summary).field,
                  .second = scene::secondField(layer, summary),
                  .maps = scene::layerMaps(layer, summary),
                  .extinction = {},
                  .diagonal = glm::length(summary.bounds.max - summary.bounds.min)};
    if (absorbs(layer.model) && layer.shader.code.empty()) {
        matter.extinction =
            layer.channels.empty() ? extinctionOf(matter) : extinctionOfChannels(layer, summary);
    }
    return matter;
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

void planHeadlight(LayerPlan& plan, const Layer& isosurface) {
    add(plan, kGradient, isosurface.headlight,
        isosurface.headlight ? "lit from the eye" : "unlit, so no gradient is needed");
}

}  // namespace volcast::plan
