#include "renderer/scene/default_scene.h"

#include <cmath>

#include <gtest/gtest.h>

#include "renderer/scene/ray_models.h"
#include "renderer/scene/validate.h"

namespace volcast::scene {
namespace {

/// A cube of side 3 whose field is spread evenly over [-1, 3].
data::DatasetSummary cube() {
    data::DatasetSummary summary;
    summary.bounds = {.min = {0, 0, 0}, .max = {3, 3, 3}};
    summary.cells = 6;
    summary.fields = {{.name = "f",
                       .unit = {},
                       .range = {.min = -1.0F, .max = 3.0F},
                       .spread = {.percentiles = {},
                                  .usual = {.min = -1.0F, .max = 3.0F},
                                  .histogram = std::vector<std::uint32_t>(256, 10)}}};
    return summary;
}

TEST(DefaultScene, SuitsEveryRayModelOfMeshes) {
    const data::DatasetSummary summary = cube();
    for (const RayModelRow& row : rayModels()) {
        if (!row.onMeshes) continue;
        Scene scene = defaultScene("data", summary);
        scene.layers = {defaultLayer("data", summary, "f", row.model)};
        EXPECT_TRUE(validate(scene).has_value()) << row.name;
        EXPECT_TRUE(validate(scene, {{"data", summary}}).has_value()) << row.name;
    }
}

TEST(DefaultScene, ShowsOneLevelInTheMiddleOfTheRange) {
    const Layer layer = defaultLayer("data", cube(), "f", RayModel::kIsosurface);
    EXPECT_EQ(layer.levels.values, std::vector<float>{1.0F});
}

TEST(DefaultScene, ExposesXrayAndSplatByTheMapOverTheData) {
    const data::DatasetSummary summary = cube();
    Layer layer = defaultLayer("data", summary, "f", RayModel::kXray);
    layer.map.points = {{.value = 0.0F, .colour = {0.5F, 0.25F, 0.0F}, .extinction = 2.0F}};
    expose(layer, summary);
    // Depth through the cube: 2 * 3; the aim is 1.5. Rounded to float once, tables not involved.
    EXPECT_FLOAT_EQ(layer.extinctionScale, 0.25F);
    EXPECT_FLOAT_EQ(layer.exposure, std::log2(0.7F / (0.5F * 3.0F)));
}

TEST(DefaultScene, ExposesForTheDensestBodyInEmptySpace) {
    const data::DatasetSummary summary = cube();
    Layer layer = defaultLayer("data", summary, "f", RayModel::kXray);
    // 1/64 of the data, the top 4 of 256 bins: as a cube it has 1/4 of the side.
    layer.map.points = {{.value = 2.9375F, .colour = glm::vec3(0.0F), .extinction = 0.0F},
                        {.value = 2.9375F, .colour = {0.0F, 2.0F, 0.0F}, .extinction = 8.0F}};
    expose(layer, summary);
    EXPECT_FLOAT_EQ(layer.extinctionScale, 1.5F / (8.0F * 0.25F * 3.0F));
    EXPECT_FLOAT_EQ(layer.exposure, std::log2(0.7F / (2.0F * 0.25F * 3.0F)));
}

TEST(DefaultScene, AMapThatShowsNothingKeepsTheNeutralExposure) {
    const data::DatasetSummary summary = cube();
    Layer layer = defaultLayer("data", summary, "f", RayModel::kSplat);
    layer.map.points = {{.value = 0.0F, .colour = glm::vec3(0.0F), .extinction = 0.0F}};
    expose(layer, summary);
    EXPECT_EQ(layer.extinctionScale, 1.0F);
    EXPECT_EQ(layer.exposure, 0.0F);
}

}  // namespace
}  // namespace volcast::scene
