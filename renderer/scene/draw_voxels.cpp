#include "renderer/scene/layer_draw.h"

namespace volcast::scene {

namespace {

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
    return {};
}

}  // namespace

Result<void> prepareVoxels(DrawContext& context, LayerDraw& draw) {
    if (draw.code) return prepareRawChannels(context, draw);
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
    if (draw.code) {
        return volume::drawUserCode(inputs, {.texts = draw.code->texts,
                                             .channels = draw.rawChannels,
                                             .iterations = draw.code->iterations});
    }
    return draw.plan->evaluator == plan::Evaluator::kCrossSections
               ? volume::drawCrossSections(inputs)
               : volume::drawMarch(inputs);
}

}  // namespace volcast::scene
