// Types of voxels, texture units, steps and maps at the ends of what the march can do.
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "renderer/plan/effects.h"
#include "renderer/scene/ray_models.h"
#include "tests/gl/volume/blobs_fixture.h"
#include "tests/support/edited_renderers.h"

namespace volcast {
namespace {

using scene::RayModel;
using scene::Sampling;

class MarchLimits : public support::BlobsTest {};

// Interpolating in the shader, as is done where the texture unit keeps too few bits, gives the
// same picture.
TEST_F(MarchLimits, InterpolatingInTheShaderAgreesWithTheTextureUnit) {
    const auto byHand = support::rendererWithoutTextureUnit(device());
    byHand->addDataset("volume", volume_);
    scene_.layers[0].stepWorld = 0.11;
    const auto expected = draw(scene_, {64, 48});
    const auto picture = support::must(tryDraw(*byHand, scene_, {64, 48}));
    for (std::size_t i = 0; i < picture.linear.size(); ++i) {
        ASSERT_NEAR(picture.linear[i], expected.linear[i], 2e-4F) << i;
    }
}

TEST_F(MarchLimits, HardMapsAndCamerasGiveFiniteNumbers) {
    data::TransferFunction hard{{{.value = 0.0F, .colour = {1, 0, 0}, .extinction = 0.0F},
                                 {.value = 20.0F, .colour = {1, 0, 0}, .extinction = 1e30F},
                                 {.value = 20.0F, .colour = {0, 1, 0}, .extinction = 0.0F},
                                 {.value = 20.000002F, .colour = {0, 1, 0}, .extinction = 1e38F},
                                 {.value = 1e38F, .colour = {0, 0, 1e6F}, .extinction = 0.0F}}};
    scene_.layers[0].map = hard;
    scene_.camera.up = {0, 0, 1};
    for (const glm::dvec3& offset :
         {glm::dvec3(1e-6, 0, 0), glm::dvec3(40, 0, 0), glm::dvec3(1e9, 1, 1),
          support::kBlobsPlace.direction * glm::dvec3(0, 30, 0)}) {
        scene_.camera.eye = center_ + offset;
        for (const scene::RayModelRow& row : scene::rayModels()) {
            if (!row.onVolumes || row.chunk.empty()) continue;
            scene_.layers[0].model = row.model;
            scene_.layers[0].levels.values = {20.0F, 1e38F};
            const auto picture = draw(scene_, {24, 24});
            for (const float value : picture.linear) {
                ASSERT_TRUE(std::isfinite(value)) << offset.x;
            }
        }
    }
}

TEST_F(MarchLimits, TheStepIsEnlargedAndSaidSoBeforeTheLoopLimitIsReached) {
    scene_.layers[0].stepWorld = 1e-9;
    const auto picture = draw(scene_, {4, 4});
    EXPECT_TRUE(picture.info.plan.layers[0].has(plan::kStepEnlarged));
    const double longest =
        glm::length(support::kBlobsPlace.spacing * glm::dvec3(support::kBlobsPlace.size - 1));
    EXPECT_NEAR(picture.info.plan.layers[0].stepWorld, longest / plan::kMaxRaySamples, 1e-12);
    scene_.layers[0].stepWorld = 0.02;
    const auto coarse = draw(scene_, {4, 4});
    EXPECT_FALSE(coarse.info.plan.layers[0].has(plan::kStepEnlarged));
    scene_.layers[0].stepWorld = 0.01;
    const auto fine = draw(scene_, {4, 4});
    // Samples in the middle of steps are off by the square of a step: halving it takes three
    // fourths of what it is off by, so that the rest is a third of the change; twice that, because
    // control points lie anywhere in their steps.
    float change = 0.0F;
    for (std::size_t i = 0; i < fine.linear.size(); ++i) {
        change = std::max(change, std::abs(fine.linear[i] - coarse.linear[i]));
    }
    // 60'000 sums are rounded by 2^-25 each, in either direction.
    const float allowed = 2.0F / 3.0F * change + 1e-4F;
    for (std::size_t i = 0; i < picture.linear.size(); ++i) {
        EXPECT_NEAR(picture.linear[i], fine.linear[i], allowed) << "cut off by the loop limit?";
    }
}

// Integers of 8 and 16 bits arrive as they are.
TEST_F(MarchLimits, IntegerVoxelsKeepTheirValues) {
    const auto drawInteger = [&](data::VoxelType type, const auto& values) {
        data::VolumeInput input;
        input.size = {2, 2, 2};
        input.type = type;
        input.channels.push_back({.name = "i", .unit = "", .voxels = {}});
        const auto bytes = std::as_bytes(std::span{values});
        input.channels[0].voxels.assign(bytes.begin(), bytes.end());
        renderer_->addDataset("integers", support::must(data::buildVolume(std::move(input))));
        scene::Scene scene;
        scene.layers.push_back(scene_.layers[0]);
        scene.layers[0].dataset = "integers";
        scene.layers[0].model = RayModel::kMip;
        scene.layers[0].sampling = Sampling::kNearest;
        scene.layers[0].map = {{{.value = -65536.0F, .colour = glm::vec3(0.0F)},
                                {.value = 65536.0F, .colour = glm::vec3(1.0F)}}};
        scene.camera = {.eye = {0.4, 0.6, 9}, .center = {0.4, 0.6, 0}};
        return draw(scene, {1, 1}).at(0, 0).r * 131072.0 - 65536.0;
    };
    EXPECT_NEAR(
        drawInteger(data::VoxelType::kU8, std::array<std::uint8_t, 8>{1, 2, 251, 4, 5, 6, 9, 8}),
        251.0, 0.02);
    EXPECT_NEAR(drawInteger(data::VoxelType::kU16,
                            std::array<std::uint16_t, 8>{1, 2, 3, 4, 5, 6, 65535, 8}),
                65535.0, 0.02);
    EXPECT_NEAR(drawInteger(data::VoxelType::kI16,
                            std::array<std::int16_t, 8>{-9, -9, -30000, -9, -9, -9, -32768, -9}),
                -30000.0, 0.02);
}

}  // namespace
}  // namespace volcast
