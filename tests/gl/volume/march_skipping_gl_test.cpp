// Rays that pass over bricks draw what rays draw that do not, under every model and integrator.
#include <algorithm>

#include "renderer/plan/effects.h"
#include "renderer/scene/ray_models.h"
#include "tests/gl/volume/blobs_fixture.h"
#include "tests/support/edited_renderers.h"

namespace volcast {
namespace {

using scene::RayModel;
using scene::Sampling;

class MarchSkipping : public support::BlobsTest {};

// A map that is all but transparent keeps the plan from skipping, and changes nothing visible.
TEST_F(MarchSkipping, ChangesNothing) {
    scene_.layers[0].stepWorld = 0.07;
    const auto skipped = draw(scene_, {64, 48});
    scene_.layers[0].map = support::blobsMap(1e-30F);
    const auto full = draw(scene_, {64, 48});
    ASSERT_TRUE(skipped.info.plan.layers[0].has(plan::kEmptyBricks));
    ASSERT_FALSE(full.info.plan.layers[0].has(plan::kEmptyBricks));
    ASSERT_NE(skipped.info.plan.id, full.info.plan.id);
    for (std::size_t i = 0; i < full.linear.size(); ++i) {
        ASSERT_NEAR(skipped.linear[i], full.linear[i], 1e-6F) << i;
    }
}

TEST_F(MarchSkipping, SkippingEmptyBricksChangesNoIntegrator) {
    scene_.layers[0].stepWorld = 0.07;
    for (const scene::IntegratorRow& row : scene::row(RayModel::kVolume).voxelIntegrators) {
        scene_.layers[0].integrator = row.integrator;
        scene_.layers[0].map = support::blobsMap(0.0F);
        const auto skipped = draw(scene_, {64, 48});
        scene_.layers[0].map = support::blobsMap(1e-30F);
        const auto full = draw(scene_, {64, 48});
        ASSERT_TRUE(skipped.info.plan.layers[0].has(plan::kEmptyBricks));
        ASSERT_FALSE(full.info.plan.layers[0].has(plan::kEmptyBricks));
        // Adaptive steps begin anew behind a brick: at other places, each within its error.
        const float most = row.integrator == scene::Integrator::kAdaptive ? 1.0F / 255 : 2e-6F;
        for (std::size_t i = 0; i < full.linear.size(); ++i) {
            ASSERT_NEAR(skipped.linear[i], full.linear[i], most) << row.name << ' ' << i;
        }
    }
}

TEST_F(MarchSkipping, SkippingBricksChangesNoModel) {
    const auto withoutSkipping = support::rendererWithoutSkipping(device());
    withoutSkipping->addDataset("volume", volume_);
    scene_.layers[0].levels.values = {20.0F, 45.0F, 70.0F};
    int skipping = 0;
    for (const scene::RayModelRow& row : scene::rayModels()) {
        if (!row.onVolumes || row.chunk.empty()) continue;
        for (int variant = 0; variant < 6; ++variant) {
            const bool interval = variant % 2 == 1;
            scene_.layers[0].model = row.model;
            scene_.layers[0].sampling = static_cast<Sampling>(variant / 2);
            scene_.layers[0].interval.reset();
            if (interval) scene_.layers[0].interval = data::Range{.min = 15.0F, .max = 60.0F};
            const auto skipped = draw(scene_, {64, 48});
            const auto full = support::must(tryDraw(*withoutSkipping, scene_, {64, 48}));
            skipping += skipped.info.plan.layers[0].has(plan::kEmptyBricks) ? 1 : 0;
            EXPECT_EQ(skipped.linear, full.linear) << row.name << ' ' << variant;
        }
    }
    EXPECT_EQ(skipping, 3 * 12) << "all but mip_colour and splat of all values";
}

// Beside a single voxel of 100 tricubic values are below 0, and between two above 100: what only
// such values show must not be passed over with their bricks, whose voxels show nothing.
TEST_F(MarchSkipping, SkippingBricksSeesTheOvershootOfTricubicValues) {
    const auto withoutSkipping = support::rendererWithoutSkipping(device());
    const data::Volume spikes = support::volumeOf({.size = {50, 50, 50}}, [](const glm::dvec3& p) {
        const glm::ivec3 i{p};
        const bool plate = i.x < 25 && (i.z == 24 || i.z == 25);
        const bool spike = (i.x * 7 + i.y * 11 + i.z * 13) % 53 < 2 && i.z > 15 && i.z < 34;
        return plate || spike ? 100.0 : 0.0;
    });
    renderer_->addDataset("spikes", spikes);
    withoutSkipping->addDataset("spikes", spikes);
    scene::Layer& layer = scene_.layers[0];
    layer.dataset = "spikes";
    layer.sampling = Sampling::kTricubic;
    layer.stepWorld = 0.31;
    layer.headlight = false;
    layer.levels.values = {-4.0F};
    scene_.camera.eye = {80, 60, 90};
    scene_.camera.center = {24, 24, 24};
    const data::TransferFunction below{{{.value = -3.0F, .colour = {1, 1, 1}, .extinction = 1.0F},
                                        {.value = -1.0F, .colour = {1, 1, 1}, .extinction = 0.0F}}};
    const data::TransferFunction above{
        {{.value = 101.0F, .colour = {1, 1, 1}, .extinction = 0.0F},
         {.value = 103.0F, .colour = {1, 1, 1}, .extinction = 1.0F}}};
    for (const RayModel model : {RayModel::kVolume, RayModel::kXray, RayModel::kMip,
                                 RayModel::kMinip, RayModel::kIsosurface}) {
        for (const data::TransferFunction& map : {below, above}) {
            layer.model = model;
            layer.map = map;
            const auto skipped = draw(scene_, {64, 48});
            const auto full = support::must(tryDraw(*withoutSkipping, scene_, {64, 48}));
            EXPECT_EQ(skipped.linear, full.linear) << scene::name(model);
            const bool shows = std::ranges::any_of(full.linear, [](float v) { return v > 0.01F; });
            EXPECT_TRUE(shows) << scene::name(model) << ' ' << map.points[0].value;
        }
    }
}

}  // namespace
}  // namespace volcast
