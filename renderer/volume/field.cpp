#include "renderer/volume/field.h"

#include "renderer/shading/shared.h"
#include "renderer/volume/block_ranges.h"
#include "renderer/volume/march.h"

namespace volcast::volume {

namespace {

int voxelKind(data::VoxelType type) {
    switch (type) {
        case data::VoxelType::kU8:
        case data::VoxelType::kU16: return shading::shared::kUnsignedVoxels;
        case data::VoxelType::kI16: return shading::shared::kSignedVoxels;
        case data::VoxelType::kF32: break;
    }
    return shading::shared::kFloatVoxels;
}

}  // namespace

FieldTraits fieldTraits(const DrawInputs& inputs) {
    if (inputs.bricks == nullptr) return {};
    return {.bricked = true,
            .type = inputs.volume->type,
            .coarserLevels = inputs.volume->coarserLevels()};
}

void addField(shading::Recipe& recipe, const FieldTraits& traits) {
    recipe.constants.insert(
        recipe.constants.end(),
        {{"kRangeBlock", kRangeBlock},
         {"kRangeReach", traits.bricked ? shading::shared::kBrickReach : kRangeReach}});
    if (!traits.bricked) return;
    recipe.constants.insert(recipe.constants.end(), {{"kCoarserLevels", traits.coarserLevels},
                                                     {"kVoxelKind", voxelKind(traits.type)}});
    // Whoever reads voxels gets them from bricks.
    recipe.texts.push_back({"volume/voxels.glsl", "#include \"volume/bricked_voxels.glsl\"\n"});
    recipe.texts.push_back(
        {"volume/user_channels.glsl", "#include \"volume/bricked_user_channel.glsl\"\n"});
    recipe.texts.push_back({"volume/ranges.glsl", "#include \"volume/bricked_ranges.glsl\"\n"});
}

VoxelTexels texelsOf(const DrawInputs& inputs) {
    return inputs.channel == nullptr ? VoxelTexels::kTexture : inputs.channel->texels();
}

void bindField(const DrawInputs& inputs) {
    if (inputs.bricks != nullptr) {
        inputs.bricks->bind(*inputs.pool);
    } else {
        inputs.channel->bind();
        if (inputs.ranges != nullptr) inputs.ranges->bind();
    }
}

}  // namespace volcast::volume
