// Every row of the table of ray models builds for every kind of data it claims.
#include <cstddef>

#include "renderer/scene/ray_models.h"
#include "renderer/shading/program_cache.h"
#include "renderer/shading/shared.h"
#include "renderer/volume/march.h"
#include "tests/support/gl_test.h"
#include "tests/support/layer_constants.h"
#include "tests/support/march_variants.h"

namespace volcast {
namespace {

using support::must;

class Recipes : public support::GlTest {
protected:
    shading::ProgramCache programs_{device(), shading::embeddedChunks()};
};

TEST_F(Recipes, EveryModelOfVolumesMarchesInEveryVariant) {
    int built = 0;
    for (const scene::RayModelRow& row : scene::rayModels()) {
        if (!row.onVolumes || row.chunk.empty()) continue;
        for (int variant = 0; variant < support::kMarchVariants; ++variant) {
            const auto program = programs_.ray(volume::marchRecipe(
                support::marchTraits(row, variant), support::layerConstants(variant)));
            ASSERT_TRUE(program.has_value()) << program.error().message;
            ++built;
        }
    }
    EXPECT_EQ(built, 7 * support::kMarchVariants);
}

TEST_F(Recipes, TheLayerBlockLiesInMemoryAsTheDriverSeesIt) {
    const auto* program =
        must(programs_.ray(volume::marchRecipe({.clipPlanes = 1}, support::layerConstants(2))));
    using shading::shared::LayerBlock;
    EXPECT_EQ(program->blockBytes("LayerUniforms"), static_cast<int>(sizeof(LayerBlock)));
    const auto offset = [&](const char* member) {
        return program->uniformOffset((std::string{"LayerUniforms.layer."} + member).c_str());
    };
    const auto either = [&](const char* member) {
        const int direct = program->uniformOffset((std::string{"layer."} + member).c_str());
        return direct >= 0 ? direct : offset(member);
    };
    EXPECT_EQ(either("rayStart"), static_cast<int>(offsetof(LayerBlock, rayStart)));
    EXPECT_EQ(either("rayStartRight"), static_cast<int>(offsetof(LayerBlock, rayStartRight)));
    EXPECT_EQ(either("rayStartUp"), static_cast<int>(offsetof(LayerBlock, rayStartUp)));
    EXPECT_EQ(either("rayDirection"), static_cast<int>(offsetof(LayerBlock, rayDirection)));
    EXPECT_EQ(either("rayDirectionUp"), static_cast<int>(offsetof(LayerBlock, rayDirectionUp)));
    EXPECT_EQ(either("viewport"), static_cast<int>(offsetof(LayerBlock, viewport)));
    EXPECT_EQ(either("gridFromData"), static_cast<int>(offsetof(LayerBlock, gridFromData)));
    EXPECT_EQ(either("clipPlanes[0]"), static_cast<int>(offsetof(LayerBlock, clipPlanes)));
    EXPECT_EQ(either("grid"), static_cast<int>(offsetof(LayerBlock, grid)));
}

TEST_F(Recipes, ThePlansOfTheTableMatchTheEnumerators) {
    using scene::RayModel;
    const auto nameOf = [](RayModel model) {
        return scene::rayModels()[static_cast<std::size_t>(model)].name;
    };
    EXPECT_EQ(nameOf(RayModel::kSurface), "surface");
    EXPECT_EQ(nameOf(RayModel::kMip), "mip");
    EXPECT_EQ(nameOf(RayModel::kVolume), "volume");
}

}  // namespace
}  // namespace volcast
