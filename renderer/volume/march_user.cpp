#include "renderer/plan/effects.h"
#include "renderer/shading/shared.h"
#include "renderer/volume/march.h"

namespace volcast::volume {

shading::Recipe userRecipe(const UserTraits& traits, std::vector<shading::TextChunk> texts,
                           std::vector<shading::Constant> constants) {
    const bool gathers = traits.model == scene::RayModel::kVolume;
    constants.insert(constants.end(),
                     {{"kSampling", static_cast<int>(traits.sampling)},
                      {"kFilterInHardware", traits.filterInHardware},
                      {"kEarlyStop", gathers},
                      {"kLargestCounts", traits.model == scene::RayModel::kMip},
                      {"kInterval", traits.interval},
                      {"kMissing", traits.missing},
                      {"kClipPlanes", traits.clipPlanes},
                      {"kClipsAtStart", true},
                      {"kOtherChannels", traits.otherChannels},
                      // The driver counts the rounds of all loops of a ray together.
                      {"kMaxRaySamples", plan::kMaxRaySamples / (1 + traits.iterations)}});
    return {.evaluator = "volume/march_user.glsl",
            .classify = "classify/user_code.glsl",
            .segment = gathers ? "segment/user_code.glsl" : "",
            .model = gathers ? "model/volume.glsl" : "model/user_extreme.glsl",
            .constants = std::move(constants),
            .texts = std::move(texts)};
}

Result<void> drawUserCode(const DrawInputs& inputs, const UserInputs& user) {
    const UserTraits traits{.model = inputs.layer->model,
                            .sampling = inputs.layer->sampling,
                            .filterInHardware = inputs.filterInHardware,
                            .interval = inputs.plan->has(plan::kInterval),
                            .clipPlanes = inputs.clipPlanes,
                            .otherChannels = static_cast<int>(user.channels.size()) - 1,
                            .iterations = user.iterations,
                            .missing = inputs.plan->has(plan::kVoxelsWithoutValue)};
    const Result<const gpu::Program*> program =
        inputs.programs->ray(userRecipe(traits, user.texts, inputs.constants));
    if (!program) return program.error();
    inputs.target->begin({.blend = gpu::Blend::kOver});
    (*program)->use();
    user.channels.front()->bind(shading::shared::kVoxelUnit);
    for (unsigned i = 1; i < user.channels.size(); ++i) {
        user.channels[i]->bind(shading::shared::kOtherChannelUnit + i - 1);
    }
    inputs.device->draw(gpu::Primitive::kTriangles, 3);
    return {};
}

}  // namespace volcast::volume
