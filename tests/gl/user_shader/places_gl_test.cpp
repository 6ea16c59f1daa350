// Code where volumes are larger than what the GPU may hold of them, and on cross-sections.
#include <cmath>

#include <gmock/gmock.h>

#include "renderer/plan/effects.h"
#include "renderer/volume/brick_pool.h"
#include "tests/gl/user_shader/user_shader_fixture.h"

namespace volcast {
namespace {

using scene::RayModel;
using scene::Sampling;
using ::testing::HasSubstr;

class UserShaderBricks : public support::UserShaderTest {
protected:
    /// 16 bits; 129 voxels a side, 8.2 MiB of the float32 that a whole channel takes.
    static data::Volume waves(int channels = 1) {
        constexpr int kSide = 129;
        data::VolumeInput input;
        input.size = glm::ivec3(kSide);
        input.type = data::VoxelType::kU16;
        for (int c = 0; c < channels; ++c) {
            std::vector<std::uint16_t> values;
            for (int z = 0; z < kSide; ++z) {
                for (int y = 0; y < kSide; ++y) {
                    for (int x = 0; x < kSide; ++x) {
                        values.push_back(static_cast<std::uint16_t>(
                            20000.0 *
                            (1.0 + std::sin(0.2 * x + c) * std::cos(0.17 * y + 0.1 * z))));
                    }
                }
            }
            data::ChannelInput channel{.name = "c" + std::to_string(c), .unit = "", .voxels = {}};
            const auto bytes = std::as_bytes(std::span{values});
            channel.voxels.assign(bytes.begin(), bytes.end());
            input.channels.push_back(std::move(channel));
        }
        return support::must(data::buildVolume(std::move(input)));
    }

    /// Holds less than a whole channel; level 0 is needed at the picture's size.
    static std::unique_ptr<scene::Renderer> bricked(const data::Volume& volume) {
        const std::size_t each = volume::BrickPool::brickBytes(volume.type);
        auto renderer = support::must(
            scene::Renderer::create(device(), shading::embeddedChunks(),
                                    {.volumeBytes = 64 * each, .pictureBytes = 1000 * each}));
        renderer->addDataset("volume", volume);
        return renderer;
    }

    scene::Scene wavesScene(const data::Volume& volume, const std::string& code,
                            RayModel model = RayModel::kVolume) {
        scene::Scene scene = sceneOf(volume, code, model);
        // A pixel is an eighth of a voxel.
        scene.camera = {.eye = {180, 150, 210}, .center = {60, 60, 60}};
        scene.camera.projection = scene::Projection::kOrthographic;
        scene.camera.orthographicHeight = 6.0;
        return scene;
    }
};

constexpr const char* kNormalized =
    "void main() { float v = toNormalized(getInterpolatedDataValue());\n"
    "float n = toNormalized(getDataValue());\n"
    "emitRGBA(vec4(v, n, 0.5 * v, 0.2 * v)); }";

// Bricks hold the voxels themselves, so that only the order of operations differs: interpolation
// from 16 bits, some 200 samples a ray of opacity below 0.1 each. 2e-5 is 170 roundings of 1.
TEST_F(UserShaderBricks, ShowWhatTheWholeVolumeShows) {
    const data::Volume volume = waves();
    const auto renderer = bricked(volume);
    for (const RayModel model : {RayModel::kVolume, RayModel::kMip, RayModel::kCrossSections}) {
        for (const Sampling sampling : {Sampling::kNearest, Sampling::kTricubic}) {
            scene::Scene scene = wavesScene(volume, kNormalized, model);
            scene.layers[0].sampling = sampling;
            const auto whole = draw(scene, {40, 32});
            EXPECT_FALSE(whole.info.plan.layers[0].has(plan::kBricks));
            auto parts = support::must(tryDraw(*renderer, scene, {40, 32}));
            ASSERT_TRUE(parts.info.ready);
            EXPECT_TRUE(parts.info.plan.layers[0].has(plan::kBricks));
            EXPECT_GT(drawnShare(whole), 0.9);
            EXPECT_LT(largestDifference(whole, parts), 2e-5)
                << static_cast<int>(model) << ' ' << static_cast<int>(sampling);
        }
    }
}

TEST_F(UserShaderBricks, AMapThatIsTransparentLeavesNoBrickOut) {
    const data::Volume volume = waves();
    const auto renderer = bricked(volume);
    scene::Scene scene = wavesScene(volume, "void main() { emitRGBA(vec4(0.02)); }");
    scene.layers[0].map.points = {{.value = 0.0F, .colour = {1, 1, 1}, .extinction = 0.0F}};
    const auto parts = support::must(tryDraw(*renderer, scene, {16, 16}));
    ASSERT_EQ(parts.info.bricks.size(), 1U);
    EXPECT_EQ(parts.info.bricks[0].report.hidden, 0U) << "the map is not used";
    EXPECT_LT(largestDifference(parts, draw(scene, {16, 16})), 2e-5);
}

TEST_F(UserShaderBricks, CodeThatReadsOtherChannelsNeedsAllOfThem) {
    const data::Volume volume = waves(2);
    const auto renderer = bricked(volume);
    scene::Scene scene =
        wavesScene(volume, "void main() { emitGrayscale(0.02 * toNormalized(getDataValue(1))); }");
    const auto parts = support::must(tryDraw(*renderer, scene, {16, 16}));
    EXPECT_FALSE(parts.info.plan.layers[0].has(plan::kBricks));
    EXPECT_EQ(largestDifference(parts, draw(scene, {16, 16})), 0.0);
}

class UserShaderPlanes : public support::UserShaderTest {
protected:
    /// x + 10 y + 100 z at grid points; looked at along -z, planes meet in the middle.
    scene::Scene planes(const std::string& code) {
        scene::Scene scene =
            slabScene(support::volumeOf({.size = {9, 9, 5}},
                                        [](const auto& p) { return p.x + 10 * p.y + 100 * p.z; }),
                      code, RayModel::kCrossSections);
        scene.layers[0].crossSections.shown = {false, false, true};
        scene.layers[0].crossSections.point = glm::dvec3{4.0, 4.0, 1.5};
        return scene;
    }
};

TEST_F(UserShaderPlanes, ShowTheColourEmittedAtTheirPoint) {
    const auto picture = draw(
        planes("void main() { emitRGBA(vec4(getInterpolatedDataValue() / 1000.0, 0.25, 1.0, 0.1));"
               " }"),
        {4, 4});
    // The pixel (2, 1) is a quarter of a unit to the right and above the middle.
    EXPECT_NEAR(picture.at(2, 1).r, (4.35 + 10 * 4.15 + 150) / 1000.0, 1e-5);
    EXPECT_EQ(picture.at(2, 1).a, 1.0F) << "opaque, as planes are";
    EXPECT_NEAR(picture.at(2, 1).g, 0.25F, 1e-6F) << "the colour is not multiplied by the opacity";
}

TEST_F(UserShaderPlanes, AreLookedThroughWhereTheCodeIsTransparent) {
    const std::string code =
        "void main() { if (getInterpolatedDataValue() > 195.0) emitTransparent();\n"
        "else emitRGB(vec3(VOLUME_RENDERING ? 0.25 : 0.75)); }";
    const auto picture = draw(planes(code), {4, 4});
    EXPECT_EQ(picture.at(2, 1), glm::vec4(0.0F)) << 195.85;
    EXPECT_EQ(picture.at(2, 2).a, 1.0F) << "191 two rows below";
    EXPECT_NEAR(picture.at(2, 2).r, 0.75F, 1e-6F) << "not what rays gather";
    scene::Scene scene = planes(code);
    scene.layers[0].interval = data::Range{.min = 0.0F, .max = 100.0F};
    EXPECT_EQ(draw(scene, {4, 4}).at(2, 2).a, 0.0F) << "outside of the interval";
}

TEST_F(UserShaderPlanes, EndRaysOfOtherLayersAndChangeByUploads) {
    scene::Scene scene = planes(
        "#uicontrol float s slider(min=0, max=1, default=0.5)\n"
        "void main() { emitRGB(vec3(s)); }");
    scene.layers.push_back(scene.layers[0]);
    scene.layers[1].id = "fog";
    scene.layers[1].model = RayModel::kVolume;
    scene.layers[1].shader.code = "void main() { emitRGBA(vec4(1.0, 0.0, 0.0, 0.03)); }";
    const auto before = draw(scene, {4, 4});
    const double diagonal = std::sqrt(8.0 * 8.0 + 8.0 * 8.0 + 4.0 * 4.0);
    const double fog = 1.0 - std::pow(1.0 - 0.03, 2.5 / (diagonal / 64.0));
    EXPECT_NEAR(before.at(2, 1).r, fog + 0.5 * (1.0 - fog), 2e-5) << "2.5 of fog before the plane";
    scene.layers[0].shader.controls = {{.name = "s", .value = 0.25}};
    const auto after = draw(scene, {4, 4});
    EXPECT_NEAR(after.at(2, 1).r, fog + 0.25 * (1.0 - fog), 2e-5);
    EXPECT_EQ(after.info.work.programsBuilt, 0U);
    EXPECT_EQ(after.info.work.bufferUploads, 1U);
    EXPECT_TRUE(after.info.plan.layers[0].has(plan::kUserShader));
}

TEST_F(UserShaderPlanes, LightHasAReasonNotToBe) {
    scene::Scene scene = planes("void main() { emitRGB(vec3(1.0)); }");
    scene.layers[0].model = RayModel::kVolume;
    scene.layers[0].light = scene::Light{};
    const auto drawn = tryDraw(*renderer_, scene, {4, 4});
    ASSERT_FALSE(drawn.has_value());
    EXPECT_EQ(drawn.error().field, "layers[0].light");
    EXPECT_THAT(drawn.error().message, HasSubstr("light needs the gradient of a field"));
}

}  // namespace
}  // namespace volcast
