#include <algorithm>

#include "renderer/plan/effects.h"
#include "renderer/scene/ray_models.h"
#include "renderer/shading/shared.h"
#include "renderer/volume/march.h"

namespace volcast::volume {

shading::Recipe userRecipe(const UserTraits& traits, std::vector<shading::TextChunk> texts,
                           std::vector<shading::Constant> constants) {
    const bool gathers = traits.model == scene::RayModel::kVolume;
    const bool planes = traits.model == scene::RayModel::kCrossSections;
    const int most = plan::rayLimits(traits.field.bricked, traits.field.coarserLevels).samples;
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
                      {"kByDistance", traits.byDistance},
                      {"kJitters", false},
                      // The driver counts the rounds of all loops of a ray together.
                      {"kMaxRaySamples", most / (1 + traits.iterations)}});
    shading::Recipe recipe{
        .evaluator = planes ? "volume/cross_sections_user.glsl" : "volume/march_user.glsl",
        .classify = "classify/user_code.glsl",
        .segment = gathers ? "segment/user_code.glsl" : "",
        .model = gathers ? "model/volume.glsl" : "model/user_extreme.glsl",
        .constants = std::move(constants),
        .texts = std::move(texts)};
    if (planes) recipe.model.clear();
    addField(recipe, traits.field);
    return recipe;
}

Result<void> drawUserCode(const DrawInputs& inputs, const UserInputs& user) {
    const UserTraits traits{
        .model = inputs.layer->model,
        .sampling = inputs.layer->sampling,
        .filterInHardware = inputs.filterInHardware,
        .interval = inputs.plan->has(plan::kInterval),
        .clipPlanes = inputs.clipPlanes,
        .otherChannels = std::max(static_cast<int>(user.channels.size()) - 1, 0),
        .iterations = user.iterations,
        .missing = inputs.plan->has(plan::kVoxelsWithoutValue),
        .byDistance = inputs.emptySpace != nullptr,
        .field = fieldTraits(inputs)};
    const Result<const gpu::Program*> program =
        inputs.programs->ray(userRecipe(traits, user.texts, inputs.constants));
    if (!program) return program.error();
    const bool opaque = scene::row(inputs.layer->model).opaque;
    inputs.target->begin(opaque ? gpu::PassState{.depth = gpu::DepthTest::kNearest}
                                : gpu::PassState{.blend = gpu::Blend::kOver});
    (*program)->use();
    if (inputs.bricks != nullptr) bindField(inputs);
    for (unsigned i = 0; i < user.channels.size(); ++i) {
        user.channels[i]->bind(i == 0 ? shading::shared::kVoxelUnit
                                      : shading::shared::kOtherChannelUnit + i - 1);
    }
    if (inputs.emptySpace != nullptr) inputs.emptySpace->bind();
    drawCover(inputs);
    return {};
}

}  // namespace volcast::volume
