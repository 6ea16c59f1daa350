// Which bricks are loaded for a picture, and in whose turn.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "renderer/plan/effects.h"
#include "tests/gl/bricks/bricks_fixture.h"

namespace volcast {
namespace {

using data::VoxelType;
using scene::RayModel;
using scene::Sampling;

class BrickLoading : public support::BricksTest {};

// Of two types there are two pools, which share the budget; of two layers each has its part of one.
TEST_F(BrickLoading, LayersShareTheBudget) {
    const data::Volume bytes = support::volumeAs<std::uint8_t>(VoxelType::kU8, support::blobs);
    const data::Volume floats = support::volumeAs<float>(VoxelType::kF32, support::linear);
    const std::size_t budget = 80 * volume::BrickPool::brickBytes(VoxelType::kF32);
    auto renderer = support::must(
        scene::Renderer::create(device(), shading::embeddedChunks(), {.volumeBytes = budget}));
    for (scene::Renderer* each : {renderer.get(), renderer_.get()}) {
        each->addDataset("volume", bytes);
        each->addDataset("other", floats);
    }
    scene_.layers[0].sampling = Sampling::kNearest;
    scene_.camera.orthographicHeight = 20.0;  // 0.36 a pixel: most bricks of level 0.
    scene_.layers.push_back(scene_.layers[0]);
    scene_.layers[1].id = "other";
    scene_.layers[1].dataset = "other";
    scene_.layers[1].map = support::mapOver(-160.0F, 380.0F);
    scene_.layers.push_back(scene_.layers[1]);
    scene_.layers[2].id = "third";
    scene_.layers[2].model = RayModel::kXray;
    // What all take together decides: 2 channels of 8.5 MiB, although each alone has room.
    const std::uint64_t voxels = std::uint64_t{150} * 121 * 117 * 4;
    ASSERT_LT(voxels, budget);
    ASSERT_GT(2 * voxels, budget);
    const support::Drawn whole = draw(scene_, support::kBricksSize);
    const support::Drawn parts = complete(*renderer);
    ASSERT_EQ(parts.info.bricks.size(), 3U);
    for (const auto& layer : parts.info.bricks) {
        EXPECT_TRUE(layer.report.ready());
        // Half of it for 160 bricks of bytes; 64, the least of a pool, for two layers of floats.
        const bool alone = layer.layer == "layer";
        EXPECT_LE(layer.report.needed, alone ? 160U : 32U) << layer.layer;
        EXPECT_EQ(layer.report.limited, !alone) << layer.layer;
    }
    EXPECT_GT(largest(whole), 0.3F);
    // Alone the first has room as a whole.
    scene_.layers.resize(1);
    const support::Drawn one = complete(*renderer);
    EXPECT_FALSE(one.info.plan.layers[0].has(plan::kBricks));
    EXPECT_LE(largestDifference(draw(scene_, support::kBricksSize), one), 2e-6);
}

TEST_F(BrickLoading, PicturesGetBetterUntilTheyAreReady) {
    const data::Volume volume = support::volumeAs<std::uint8_t>(VoxelType::kU8, support::blobs);
    showAll();
    scene_.camera.orthographicHeight = 20.0;
    scene_.layers[0].map = support::mapOver(-100.0F, 200.0F);  // Everything shows.
    const support::Drawn best = complete(*bricked(volume, 100));
    const auto renderer = bricked(volume, 100, 10);
    double before = 1e9;
    std::size_t resident = 0;
    int pictures = 0;
    for (bool ready = false; !ready; ++pictures) {
        ASSERT_LT(pictures, 20);
        const support::Drawn drawn =
            support::must(tryDraw(*renderer, scene_, support::kBricksSize));
        const volume::BrickReport& report = drawn.info.bricks.at(0).report;
        EXPECT_TRUE(drawn.info.drawn);
        EXPECT_LE(report.loadedBytes, 10 * volume::BrickPool::brickBytes(volume.type));
        EXPECT_GT(report.resident, resident);
        resident = report.resident;
        ready = drawn.info.ready;
        EXPECT_EQ(ready, report.resident == report.needed);
        double sum = 0.0;
        for (std::size_t i = 0; i < drawn.linear.size(); ++i) {
            sum += std::abs(drawn.linear[i] - best.linear[i]);
        }
        EXPECT_LE(sum, before + 1e-3);
        before = sum;
    }
    EXPECT_GT(pictures, 2);
    EXPECT_EQ(before, 0.0);
    const support::Drawn again = support::must(tryDraw(*renderer, scene_, support::kBricksSize));
    EXPECT_FALSE(again.info.drawn) << "a ready picture is not drawn again";
    EXPECT_TRUE(again.info.ready);
    EXPECT_EQ(again.info.bricks.at(0).report.resident, resident);
}

// Each wants most of the pool.
TEST_F(BrickLoading, TwoViewsTakeTurnsAndBothGetReady) {
    const data::Volume volume = support::volumeAs<std::uint8_t>(VoxelType::kU8, support::blobs);
    const auto renderer = bricked(volume, 80, 7);
    scene_.layers[0].map = support::mapOver(-100.0F, 200.0F);
    showAll();
    scene_.camera.orthographicHeight = 20.0;
    scene::Scene other = scene_;
    other.camera.eye = center_ - glm::dvec3(60, 40, -70);
    bool first = false, second = false;
    int pictures = 0;
    for (; pictures < 60 && !(first && second); ++pictures) {
        if (!first)
            first = support::must(tryDraw(*renderer, scene_, support::kBricksSize, 1)).info.ready;
        if (!second)
            second = support::must(tryDraw(*renderer, other, support::kBricksSize, 2)).info.ready;
    }
    EXPECT_TRUE(first && second);
}

TEST_F(BrickLoading, AViewThatIsGoneDoesNotKeepItsTurn) {
    const data::Volume volume = support::volumeAs<std::uint8_t>(VoxelType::kU8, support::blobs);
    const auto renderer = bricked(volume, 100, 2);
    scene_.layers[0].map = support::mapOver(-100.0F, 200.0F);
    EXPECT_FALSE(support::must(tryDraw(*renderer, scene_, support::kBricksSize, 1)).info.ready);
    const auto loaded = [&] {
        return support::must(tryDraw(*renderer, scene_, support::kBricksSize, 2))
            .info.bricks.at(0)
            .report.loadedBytes;
    };
    EXPECT_EQ(loaded(), 0U) << "it is not its turn";
    renderer->dropView(1);
    EXPECT_GT(loaded(), 0U);
}

TEST_F(BrickLoading, AllIsLoadedAtOnceWhereThatIsAskedFor) {
    const data::Volume volume = support::volumeAs<std::uint8_t>(VoxelType::kU8, support::blobs);
    const auto renderer = bricked(volume, 100, 2);
    const auto info =
        support::must(renderer->render(1, scene_, support::kBricksSize, {.complete = true}));
    EXPECT_TRUE(info.ready);
}

}  // namespace
}  // namespace volcast
