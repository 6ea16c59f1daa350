#include <algorithm>

#include "renderer/data/volume_builder.h"
#include "renderer/plan/effects.h"
#include "renderer/scene/brick_view.h"
#include "renderer/scene/channels.h"
#include "renderer/scene/cover.h"
#include "renderer/scene/layer_draw.h"
#include "renderer/scene/layer_fields.h"
#include "renderer/scene/scale.h"
#include "renderer/scene/shown_values.h"

namespace volcast::scene {
namespace {

/// Brings what rays pass over empty space by, if anything. `shown`: of each channel.
Result<void> prepareSkipping(DrawContext& context, LayerDraw& draw,
                             std::vector<volume::ShownChannel> shown) {
    if (volume::readsRanges(*draw.layer, *draw.plan)) {
        const auto ranges = draw.dataset->rangeTable(*context.device, *draw.layer, context.frame);
        if (!ranges) return ranges.error();
        draw.ranges = *ranges;
    }
    if (!volume::passesOverEmptySpace(*draw.layer, *draw.plan)) return {};
    draw.emptySpace = &draw.state->emptySpace;
    return draw.state->emptySpace.set(*context.device, std::move(shown));
}

/// Brings several channels and their maps.
Result<void> prepareChannels(DrawContext& context, LayerDraw& draw) {
    const float gain = draw.layer->model == RayModel::kVolume ? draw.layer->gain : 0.0F;
    std::vector<DrawnChannel> drawn;
    for (const ChannelMap* shown : shownChannels(*draw.layer)) {
        const data::FieldSummary* field = findField(draw.dataset->summary(), shown->field);
        const ScaleFunction scale{Scale{}, field->range};
        drawn.push_back({.map = scaled(withGain(shown->map, gain), scale), .interval = {}});
        if (!shown->interval) continue;
        drawn.back().interval = data::Range{.min = scale.ofPoint(shown->interval->min),
                                            .max = scale.ofPoint(shown->interval->max)};
    }
    if (auto set = draw.state->channels.set(*context.device, drawn); !set) return set;
    const std::vector<shading::Constant> constants = draw.state->channels.constants();
    draw.constants.insert(draw.constants.end(), constants.begin(), constants.end());
    const auto channels = draw.dataset->channels(*context.device, *draw.layer, context.frame);
    if (!channels) return channels.error();
    draw.channels = *channels;
    std::vector<volume::ShownChannel> shown;
    if (volume::passesOverEmptySpace(*draw.layer, *draw.plan)) {
        const auto maps = shownChannels(*draw.layer);
        for (std::size_t i = 0; i < maps.size(); ++i) {
            shown.push_back({.ranges = draw.dataset->ranges(maps[i]->field, *draw.layer),
                             .shown = shownValues(drawn[i])});
        }
    }
    return prepareSkipping(context, draw, std::move(shown));
}

/// What is known of the layer's own channel.
Result<void> prepareOwnSkipping(DrawContext& context, LayerDraw& draw) {
    std::vector<volume::ShownChannel> shown;
    if (volume::passesOverEmptySpace(*draw.layer, *draw.plan)) {
        shown.push_back({.ranges = draw.dataset->ranges(draw.layer->field, *draw.layer),
                         .shown = shownValues(*draw.layer, *draw.plan, draw.dataset->summary())});
    }
    return prepareSkipping(context, draw, std::move(shown));
}

Result<void> prepareRawChannels(DrawContext& context, LayerDraw& draw) {
    std::vector<std::string> names{draw.layer->field};
    for (const int number : draw.code->otherChannels) {
        names.push_back(draw.dataset->summary().fields[static_cast<std::size_t>(number)].name);
    }
    for (const std::string& name : names) {
        const auto channel = draw.dataset->rawChannel(*context.device, name, context.frame);
        if (!channel) return channel.error();
        draw.rawChannels.push_back(*channel);
    }
    return prepareOwnSkipping(context, draw);
}

Result<void> prepareBricks(DrawContext& context, const Frame& frame, LayerDraw& draw) {
    const auto& volume = std::get<data::Volume>(draw.dataset->data());
    auto pool = context.bricks.pool(*context.device, volume.type);
    if (!pool) return pool.error();
    const data::DatasetSummary& summary = draw.dataset->summary();
    const auto channel =
        static_cast<std::uint64_t>(findField(summary, draw.layer->field) - summary.fields.data());
    const volume::BrickRequest request{
        .volume = &volume,
        .channel = &volume.channels[channel],
        .number = draw.dataset->generation() * data::kMaxChannels + channel,
        .view = brickView(*frame.scene, frame.size, *draw.layer, *draw.plan, volume, summary),
        .capacity = context.bricks.capacity(volume.type)};
    auto report =
        draw.state->bricks.prepare(*context.device, **pool, request, context.bricks.loadBytes());
    if (!report) return report.error();
    draw.state->brickReport = *report;
    draw.pool = *pool;
    return {};
}

/// The pixels that rays through voxels may change.
PixelBox coverOfRays(const Frame& frame, const LayerDraw& draw) {
    // An X-ray is white where nothing is.
    if (draw.layer->model == RayModel::kXray)
        return {.low = {0, 0}, .size = {frame.size.x, frame.size.y}};
    const auto& volume = std::get<data::Volume>(draw.dataset->data());
    const std::array<glm::vec3, 2> all{glm::vec3{0.0F}, glm::vec3{volume.size - 1}};
    return coverOf(frame.scene->camera, frame.size, volume,
                   draw.emptySpace != nullptr ? draw.emptySpace->box() : all);
}

PixelBox within(PixelBox box, Rows rows) {
    const int first = std::max(box.low.y, rows.first);
    const int end = std::min(box.low.y + box.size.y, rows.end);
    return {.low = {box.low.x, first}, .size = {box.size.x, std::max(0, end - first)}};
}

}  // namespace

Result<void> prepareVoxels(DrawContext& context, const Frame& frame, LayerDraw& draw) {
    draw.state->brickReport.reset();
    if (draw.plan->has(plan::kBricks)) return prepareBricks(context, frame, draw);
    if (draw.code) return prepareRawChannels(context, draw);
    if (!draw.layer->channels.empty()) return prepareChannels(context, draw);
    const Result<const volume::ChannelGpu*> channel =
        draw.dataset->channel(*context.device, *draw.layer, context.frame);
    if (!channel) return channel.error();
    draw.channel = *channel;
    return prepareOwnSkipping(context, draw);
}

Result<void> drawVoxels(const DrawContext& context, const Frame& frame, const LayerDraw& draw,
                        const gpu::Target& target, Rows rows) {
    volume::DrawInputs inputs{.device = context.device,
                              .programs = context.programs,
                              .channel = draw.channel,
                              .bricks = draw.pool != nullptr ? &draw.state->bricks : nullptr,
                              .pool = draw.pool,
                              .emptySpace = draw.emptySpace,
                              .ranges = draw.ranges,
                              .volume = &std::get<data::Volume>(draw.dataset->data()),
                              .layer = draw.layer,
                              .plan = draw.plan,
                              .clipPlanes = static_cast<int>(frame.scene->clipPlanes.size()),
                              .filterInHardware = context.filterInHardware,
                              .constants = draw.constants,
                              .target = &target};
    const PixelBox cover = within(coverOfRays(frame, draw), rows);
    inputs.cover = {cover.low, cover.size};
    if (cover.size.x == 0 || cover.size.y == 0) return {};
    if (draw.code) {
        return volume::drawUserCode(inputs, {.texts = draw.code->texts,
                                             .channels = draw.rawChannels,
                                             .iterations = draw.code->iterations});
    }
    if (draw.channels != nullptr) {
        draw.state->channels.bind();
        return volume::drawChannels(inputs, *draw.channels);
    }
    switch (draw.plan->evaluator) {
        case plan::Evaluator::kCrossSections: return volume::drawCrossSections(inputs);
        case plan::Evaluator::kVolumeSlices:
        case plan::Evaluator::kVolumeSliceInstances:
            return volume::drawSlices(inputs, std::get<data::Volume>(draw.dataset->data()),
                                      frame.scene->camera, frame.depths.nearest, frame.size,
                                      draw.state->slices);
        default: break;
    }
    return volume::drawMarch(inputs);
}

}  // namespace volcast::scene
