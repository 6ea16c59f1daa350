#include "renderer/data/volume_builder.h"
#include "renderer/plan/effects.h"
#include "renderer/scene/brick_view.h"
#include "renderer/scene/layer_draw.h"
#include "renderer/scene/layer_fields.h"

namespace volcast::scene {

namespace {

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
        .capacity = context.bricks.capacity(**pool)};
    auto report =
        draw.state->bricks.prepare(*context.device, **pool, request, context.bricks.loadBytes());
    if (!report) return report.error();
    draw.state->brickReport = *report;
    draw.pool = *pool;
    return {};
}

}  // namespace

Result<void> prepareVoxels(DrawContext& context, const Frame& frame, LayerDraw& draw) {
    draw.state->brickReport.reset();
    if (draw.plan->has(plan::kBricks)) return prepareBricks(context, frame, draw);
    const Result<const volume::ChannelGpu*> channel =
        draw.dataset->channel(*context.device, *draw.layer, context.frame);
    if (!channel) return channel.error();
    draw.channel = *channel;
    return {};
}

Result<void> drawVoxels(const DrawContext& context, const Frame& frame, const LayerDraw& draw,
                        const gpu::Target& target) {
    const volume::DrawInputs inputs{.device = context.device,
                                    .programs = context.programs,
                                    .channel = draw.channel,
                                    .bricks = draw.pool != nullptr ? &draw.state->bricks : nullptr,
                                    .pool = draw.pool,
                                    .volume = &std::get<data::Volume>(draw.dataset->data()),
                                    .layer = draw.layer,
                                    .plan = draw.plan,
                                    .clipPlanes = static_cast<int>(frame.scene->clipPlanes.size()),
                                    .filterInHardware = context.filterInHardware,
                                    .constants = draw.constants,
                                    .target = &target};
    switch (draw.plan->evaluator) {
        case plan::Evaluator::kCrossSections: return volume::drawCrossSections(inputs);
        case plan::Evaluator::kVolumeSlices:
        case plan::Evaluator::kVolumeSliceInstances:
            return volume::drawSlices(inputs, std::get<data::Volume>(draw.dataset->data()),
                                      frame.scene->camera, frame.depths.nearest, frame.size,
                                      draw.state->slices);
        default: return volume::drawMarch(inputs);
    }
}

}  // namespace volcast::scene
