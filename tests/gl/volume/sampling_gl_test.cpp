// How many samples rays take, where they are, and how much they weigh.
#include <algorithm>
#include <cmath>
#include <string>

#include "renderer/plan/effects.h"
#include "tests/support/phantoms.h"
#include "tests/support/render_test.h"

namespace volcast {
namespace {

using scene::RayModel;

constexpr glm::ivec2 kSize{24, 20};

/// A cube of edge 8 whose value is its depth, seen along it.
class SamplingTest : public support::RenderTest {
protected:
    SamplingTest() {
        renderer_->addDataset(
            "cube", support::volumeOf({.size = glm::ivec3(9)}, [](const auto& p) { return p.z; }));
        scene::Layer layer;
        layer.id = "layer";
        layer.dataset = "cube";
        layer.map = {{{.value = 0.0F, .colour = glm::vec3(0.0F), .extinction = 0.02F},
                      {.value = 8.0F, .colour = glm::vec3(1.0F), .extinction = 0.3F}}};
        scene_.layers.push_back(layer);
        scene_.camera = {.eye = {4, 4, 20}, .center = {4, 4, 4}};
        scene_.camera.projection = scene::Projection::kOrthographic;
        scene_.camera.orthographicHeight = 6.0;
    }
    scene::Layer& layer() { return scene_.layers[0]; }

    scene::Scene scene_;
};

// The largest sample of n in the middle of equal steps is half a step before the nearest face.
TEST_F(SamplingTest, DepthSamplesAreThoseOfARayThroughTheData) {
    layer().model = RayModel::kMip;
    for (const int samples : {1, 4, 5, 64}) {
        layer().depthSamples = samples;
        const auto picture = draw(scene_, kSize);
        const double step = 8.0 / samples;
        EXPECT_NEAR(picture.info.plan.layers[0].stepWorld, step, 1e-12);
        EXPECT_NEAR(picture.at(12, 10).r, (8.0 - 0.5 * step) / 8.0, 1e-6) << samples;
    }
}

TEST_F(SamplingTest, GainMultipliesExtinctionByItsExponential) {
    layer().map = support::constantMap({0.5F, 1.0F, 0.25F}, 0.05F);
    for (const float gain : {-2.0F, 0.0F, 1.0F, 10.0F}) {
        layer().gain = gain;
        const double alpha = -std::expm1(-0.05F * std::exp(static_cast<double>(gain)) * 8.0);
        const auto picture = draw(scene_, kSize);
        EXPECT_NEAR(picture.at(12, 10).a, alpha, 2e-6) << gain;
        EXPECT_NEAR(picture.at(12, 10).b, 0.25 * alpha, 2e-6) << gain;
    }
}

// Opacity is that of the length, not of the number of samples.
TEST_F(SamplingTest, OpacityDoesNotDependOnTheNumberOfSamples) {
    layer().map = support::constantMap(glm::vec3(1.0F), 0.1F);
    for (const int samples : {1, 3, 64, 1000}) {
        layer().depthSamples = samples;
        EXPECT_NEAR(draw(scene_, kSize).at(12, 10).a, -std::expm1(-0.8), 2e-6) << samples;
    }
}

TEST_F(SamplingTest, JitterIsOffByDefaultAndTheSameForTheSameSeed) {
    layer().depthSamples = 8;
    layer().model = RayModel::kMip;
    const auto plain = draw(scene_, kSize);
    EXPECT_FALSE(plain.info.plan.layers[0].has(plan::kJitter));
    layer().jitter = 7;
    const auto first = draw(scene_, kSize, 1), second = draw(scene_, kSize, 2);
    EXPECT_TRUE(first.info.plan.layers[0].has(plan::kJitter));
    EXPECT_EQ(first.linear, second.linear);
    layer().jitter = 0x80000007U;
    const auto other = draw(scene_, kSize, 3);
    // The last sample of each ray is anywhere in its step: 1/8 of the way, evenly spread.
    float least = 1.0F, most = 0.0F, sum = 0.0F;
    int same = 0;
    for (int y = 0; y < kSize.y; ++y) {
        for (int x = 0; x < kSize.x; ++x) {
            const float value = first.at(x, y).r;
            least = std::min(least, value);
            most = std::max(most, value);
            sum += value;
            same += value == other.at(x, y).r ? 1 : 0;
        }
    }
    const float count = 24 * 20;
    EXPECT_GE(least, 7.0F / 8 - 1e-5F);
    EXPECT_LE(most, 1.0F + 1e-5F);
    EXPECT_LT(least, 7.0F / 8 + 0.01F);
    EXPECT_GT(most, 1.0F - 0.01F);
    // The mean of 480 even shares has a deviation of 1 / sqrt(12 480) = 0.013.
    EXPECT_NEAR((sum / count - 7.0F / 8) * 8, 0.5F, 0.05F);
    EXPECT_LT(same, 5);
}

TEST_F(SamplingTest, JitterChangesNothingWherePiecesLieBetweenSamples) {
    layer().integrator = scene::Integrator::kExact;
    const auto plain = draw(scene_, kSize);
    layer().jitter = 7;
    const auto moved = draw(scene_, kSize);
    EXPECT_FALSE(moved.info.plan.layers[0].has(plan::kJitter));
    EXPECT_EQ(plain.linear, moved.linear);
}

TEST_F(SamplingTest, RefusesWhatIsNoSampling) {
    const auto refusal = [&](const std::string& field) {
        const auto drawn = tryDraw(*renderer_, scene_, kSize);
        EXPECT_FALSE(drawn.has_value()) << field;
        if (drawn) return ErrorCode::kIo;
        EXPECT_EQ(drawn.error().field, "layers[0]." + field) << drawn.error().message;
        layer().depthSamples = 0;
        layer().stepWorld = 0.0;
        layer().gain = 0.0F;
        layer().integrator = scene::Integrator::kAuto;
        return drawn.error().code;
    };
    layer().depthSamples = -1;
    EXPECT_EQ(refusal("depth_samples"), ErrorCode::kInvalidArgument);
    layer().depthSamples = 1'000'000'000;
    EXPECT_EQ(refusal("depth_samples"), ErrorCode::kLimitExceeded);
    layer().depthSamples = 64;
    layer().stepWorld = 0.5;
    EXPECT_EQ(refusal("depth_samples"), ErrorCode::kInvalidArgument);
    layer().gain = std::nanf("");
    EXPECT_EQ(refusal("gain"), ErrorCode::kInvalidArgument);
    layer().gain = 11.0F;
    EXPECT_EQ(refusal("gain"), ErrorCode::kLimitExceeded);
    layer().integrator = scene::Integrator::kPsiTable;
    EXPECT_EQ(refusal("integrator"), ErrorCode::kUnsupported);
    EXPECT_TRUE(tryDraw(*renderer_, scene_, kSize).has_value());
}

// A volume of one voxel along an axis is a plane without thickness.
TEST_F(SamplingTest, APlaneOfVoxelsIsSeenByItsValuesAlone) {
    renderer_->addDataset(
        "plane", support::volumeOf({.size = {9, 9, 1}}, [](const auto& p) { return p.x; }));
    layer().dataset = "plane";
    for (const auto integrator :
         {scene::Integrator::kAverage, scene::Integrator::kExact, scene::Integrator::kAdaptive}) {
        for (const auto sampling : {scene::Sampling::kNearest, scene::Sampling::kTrilinear}) {
            layer().model = RayModel::kVolume;
            layer().integrator = integrator;
            layer().sampling = sampling;
            EXPECT_EQ(draw(scene_, kSize).at(12, 10), glm::vec4(0.0F));
        }
    }
    layer().integrator = scene::Integrator::kAuto;
    layer().sampling = scene::Sampling::kTrilinear;
    layer().model = RayModel::kMip;
    // Pixel 12 of 24 is at x = 4 + 0.5 * 6 / 20; its colour that of an eighth of the value.
    EXPECT_NEAR(draw(scene_, kSize).at(12, 10).r, (4.0 + 0.15) / 8.0, 1e-5);
}

}  // namespace
}  // namespace volcast
