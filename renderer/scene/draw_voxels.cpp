#include "renderer/scene/layer_draw.h"

namespace volcast::scene {

Result<void> prepareVoxels(DrawContext& context, LayerDraw& draw) {
    const Result<const volume::ChannelGpu*> channel =
        draw.dataset->channel(*context.device, *draw.layer, context.frame);
    if (!channel) return channel.error();
    draw.channel = *channel;
    if (!draw.code) return {};
    for (const int number : draw.code->otherChannels) {
        const std::string& name =
            draw.dataset->summary().fields[static_cast<std::size_t>(number)].name;
        const auto other = draw.dataset->channel(*context.device, name, context.frame);
        if (!other) return other.error();
        draw.otherChannels.push_back(*other);
    }
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
    if (draw.code) {
        return volume::drawUserCode(inputs, {.texts = draw.code->texts,
                                             .otherChannels = draw.otherChannels,
                                             .iterations = draw.code->iterations});
    }
    return draw.plan->evaluator == plan::Evaluator::kCrossSections
               ? volume::drawCrossSections(inputs)
               : volume::drawMarch(inputs);
}

}  // namespace volcast::scene
