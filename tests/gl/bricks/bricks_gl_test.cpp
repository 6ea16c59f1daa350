// Volumes drawn from bricks of level 0, against the same volumes as a whole on the GPU.
#include <cmath>
#include <string>
#include <vector>

#include "renderer/plan/effects.h"
#include "renderer/scene/ray_models.h"
#include "tests/gl/bricks/bricks_fixture.h"

namespace volcast {
namespace {

using data::VoxelType;
using scene::RayModel;
using scene::Sampling;

class Bricks : public support::BricksTest {};

// Both interpolate in the shader, the same numbers in the same order. Compilers may fuse products
// into sums in one of the programs alone: by 2^-24 of values, which maps make a tenth of, over 100
// samples.
constexpr double kRounding = 2e-6;

TEST_F(Bricks, EveryVoxelTypeIsDrawnAsIfItWereThereAsAWhole) {
    const std::vector<data::Volume> volumes{
        support::volumeAs<std::uint8_t>(VoxelType::kU8, support::blobs),
        support::volumeAs<std::uint16_t>(VoxelType::kU16, support::blobs),
        support::volumeAs<std::int16_t>(
            VoxelType::kI16, [](const glm::dvec3& p) { return support::blobs(p) - 100.0; }),
        support::volumeAs<float>(VoxelType::kF32, support::blobs)};
    for (const data::Volume& volume : volumes) {
        const bool isSigned = volume.type == VoxelType::kI16;
        scene_.layers[0].map =
            isSigned ? support::mapOver(-100.0F, 100.0F) : support::mapOver(0.0F, 200.0F);
        renderer_->addDataset("volume", volume);
        const auto renderer = bricked(volume, 1);
        for (const Sampling sampling :
             {Sampling::kNearest, Sampling::kTrilinear, Sampling::kTricubic}) {
            scene_.layers[0].sampling = sampling;
            const support::Drawn whole = draw(scene_, support::kBricksSize);
            const support::Drawn parts = complete(*renderer);
            ASSERT_EQ(whole.info.bricks.size(), 0U);
            ASSERT_EQ(parts.info.bricks.size(), 1U);
            EXPECT_EQ(parts.info.bricks[0].report.coarsest, 0);
            EXPECT_GT(largest(whole), 0.3F);
            EXPECT_LE(largestDifference(whole, parts), kRounding)
                << static_cast<int>(volume.type) << " " << static_cast<int>(sampling);
        }
    }
}

TEST_F(Bricks, EveryModelIsDrawnAsIfItWereThereAsAWhole) {
    const data::Volume volume = support::volumeAs<std::uint8_t>(VoxelType::kU8, support::blobs);
    renderer_->addDataset("volume", volume);
    const auto renderer = bricked(volume, 1);
    scene::Layer& layer = scene_.layers[0];
    layer.levels.values = {40.0F, 90.0F};
    struct Row {
        RayModel model;
        Sampling sampling = Sampling::kTrilinear;
        bool interval = false, lit = false;
    };
    for (const Row& row :
         {Row{RayModel::kMip}, Row{RayModel::kMinip}, Row{RayModel::kMipColour},
          Row{RayModel::kXray}, Row{RayModel::kSplat}, Row{RayModel::kCrossSections},
          Row{RayModel::kMip, Sampling::kNearest}, Row{RayModel::kMinip, Sampling::kTricubic},
          Row{RayModel::kMip, Sampling::kNearest, true},
          Row{RayModel::kVolume, Sampling::kTrilinear, true},
          Row{RayModel::kVolume, Sampling::kTrilinear, false, true},
          Row{RayModel::kVolume, Sampling::kTricubic, false, true},
          Row{RayModel::kIsosurface, Sampling::kNearest},
          Row{RayModel::kIsosurface, Sampling::kTrilinear},
          Row{RayModel::kIsosurface, Sampling::kTricubic}}) {
        layer.model = row.model;
        layer.sampling = row.sampling;
        layer.light = row.lit ? std::optional{scene::Light{}} : std::nullopt;
        layer.interval = row.interval ? std::optional{data::Range{30.0F, 120.0F}} : std::nullopt;
        const support::Drawn whole = draw(scene_, support::kBricksSize);
        const support::Drawn parts = complete(*renderer);
        ASSERT_EQ(parts.info.bricks.size(), 1U);
        EXPECT_LE(largestDifference(whole, parts), kRounding)
            << scene::name(row.model) << ' ' << scene::name(row.sampling);
        EXPECT_GT(largest(whole), 0.0F) << static_cast<int>(row.model);
    }
}

// Voxels without a value: whole bricks of them, parts of bricks, single ones.
TEST_F(Bricks, WhatHasNoValueIsDrawnAsIfItWereThereAsAWhole) {
    const auto holed = [](const glm::dvec3& p) {
        const bool none = p.x > 61.0 || glm::length(p - glm::dvec3(38, 30, 40)) < 9.0 ||
                          p == glm::dvec3(20, 33, 41);
        return none ? std::nan("") : support::blobs(p);
    };
    const data::Volume volume = support::volumeAs<float>(VoxelType::kF32, holed);
    renderer_->addDataset("volume", volume);
    const auto renderer = bricked(volume, 1);
    scene_.layers[0].levels.values = {40.0F, 60.0F};
    // Within the part that has values.
    scene_.camera.center =
        support::kBricksPlace.origin +
        support::kBricksPlace.direction * (support::kBricksPlace.spacing * glm::dvec3(38, 30, 40));
    scene_.camera.eye = scene_.camera.center + glm::dvec3(60, 40, 70);
    for (const RayModel model : {RayModel::kVolume, RayModel::kMip, RayModel::kIsosurface}) {
        for (const Sampling sampling :
             {Sampling::kNearest, Sampling::kTrilinear, Sampling::kTricubic}) {
            scene_.layers[0].model = model;
            scene_.layers[0].sampling = sampling;
            const support::Drawn whole = draw(scene_, support::kBricksSize);
            const support::Drawn parts = complete(*renderer);
            ASSERT_EQ(parts.info.bricks.size(), 1U);
            EXPECT_GT(parts.info.bricks[0].report.hidden, 0U);
            EXPECT_GT(largest(whole), 0.1F);
            for (const float value : parts.linear) ASSERT_TRUE(std::isfinite(value));
            EXPECT_LE(largestDifference(whole, parts), kRounding)
                << scene::name(model) << ' ' << scene::name(sampling);
        }
    }
}

// Where a brick was left out its coarser one stands in: what is not shown must stay so.
TEST_F(Bricks, WhatCannotShowIsNotLoadedAndNotMissed) {
    const data::Volume volume = support::volumeAs<std::uint8_t>(VoxelType::kU8, support::blobs);
    renderer_->addDataset("volume", volume);
    const auto renderer = bricked(volume, 100);
    scene_.layers[0].sampling = Sampling::kTricubic;
    scene_.layers[0].map = support::mapOver(50.0F, 150.0F);
    scene_.layers[0].levels.values = {100.0F};
    scene_.camera.orthographicHeight = 20.0;  // 0.36 a pixel
    for (const RayModel model : {RayModel::kVolume, RayModel::kIsosurface}) {
        scene_.layers[0].model = model;
        const support::Drawn whole = draw(scene_, support::kBricksSize);
        const support::Drawn parts = complete(*renderer);
        const volume::BrickReport& report = parts.info.bricks.at(0).report;
        EXPECT_EQ(report.coarsest, 0);
        EXPECT_GT(report.hidden, 0U);
        EXPECT_LT(report.needed + report.outside, static_cast<std::size_t>(support::kAllBricks));
        EXPECT_LE(largestDifference(whole, parts), kRounding) << static_cast<int>(model);
        EXPECT_GT(largest(whole), 0.3F);
    }
}

TEST_F(Bricks, VolumesThatFitAreNotCut) {
    const data::Volume volume = support::volumeAs<std::uint8_t>(VoxelType::kU8, support::blobs);
    renderer_->addDataset("volume", volume);
    const support::Drawn whole = draw(scene_, support::kBricksSize);
    EXPECT_FALSE(whole.info.plan.layers[0].has(plan::kBricks));
    EXPECT_TRUE(whole.info.ready);
}

}  // namespace
}  // namespace volcast
