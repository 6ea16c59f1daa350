#include "renderer/scene/layer_draw.h"

namespace volcast::scene {

Result<void> prepareVoxels(DrawContext& context, LayerDraw& draw) {
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
