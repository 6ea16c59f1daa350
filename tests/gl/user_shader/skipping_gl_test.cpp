// Code is not asked of values outside of an interval: where a brick has no others it is passed
// over.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "renderer/plan/effects.h"
#include "renderer/scene/ray_models.h"
#include "tests/gl/user_shader/user_shader_fixture.h"
#include "tests/support/edited_renderers.h"

namespace volcast {
namespace {

using scene::RayModel;
using scene::Sampling;
using ::testing::HasSubstr;

/// Shows something of every value, also of those outside of any interval.
constexpr const char* kCode =
    "void main() { float v = toNormalized(getInterpolatedDataValue());\n"
    "emitIntensity(v); emitRGBA(vec4(1.0 - v, v, 0.5, 0.2)); }";

class UserShaderSkipping : public support::UserShaderTest {
protected:
    /// Two balls in a box of zeros.
    static data::Volume balls(double outside = 0.0) {
        return support::volumeOf({.size = {50, 44, 60}}, [outside](const glm::dvec3& p) {
            const double ball = std::max(1.0 - glm::length(p - glm::dvec3(12, 30, 40)) / 8.0,
                                         1.0 - glm::length(p - glm::dvec3(37, 10, 15)) / 6.0);
            return ball > 0.0 ? ball : outside;
        });
    }

    static void lookAtBalls(scene::Scene& scene) {
        scene.camera = {.eye = {120, 90, 150}, .center = {25, 22, 30}};
        scene.camera.fovyDegrees = 22.0;
    }

    static const plan::Effect& emptyBricks(const support::Drawn& drawn) {
        const auto& effects = drawn.info.plan.layers[0].effects;
        return *std::ranges::find(effects, plan::kEmptyBricks, &plan::Effect::name);
    }
};

TEST_F(UserShaderSkipping, DrawsWhatIsDrawnWithoutIt) {
    const auto passingOverNothing = support::rendererWithoutSkipping(device());
    passingOverNothing->addDataset("volume", balls());
    for (const RayModel model : {RayModel::kVolume, RayModel::kMip, RayModel::kMinip}) {
        for (const Sampling sampling :
             {Sampling::kNearest, Sampling::kTrilinear, Sampling::kTricubic}) {
            scene::Scene scene = sceneOf(balls(), kCode, model);
            lookAtBalls(scene);
            scene.layers[0].sampling = sampling;
            scene.layers[0].interval = data::Range{.min = 0.3F, .max = 0.8F};
            const auto passed = draw(scene, {48, 40});
            const auto all = support::must(tryDraw(*passingOverNothing, scene, {48, 40}));
            EXPECT_TRUE(emptyBricks(passed).on);
            EXPECT_EQ(passed.linear, all.linear) << scene::name(model) << ' ' << scene::name(sampling);
            EXPECT_GT(drawnShare(passed), 0.02);
            EXPECT_LT(drawnShare(passed), 0.5);
        }
    }
}

TEST_F(UserShaderSkipping, ThePlanSaysWhatIsKnown) {
    scene::Scene scene = sceneOf(balls(), kCode);
    const auto unknown = draw(scene, {8, 8});
    EXPECT_FALSE(emptyBricks(unknown).on);
    EXPECT_THAT(emptyBricks(unknown).reason, HasSubstr("nobody knows what the code shows"));
    EXPECT_EQ(unknown.info.work.bufferUploads, 2U) << "the controls and the blocks";
    scene.layers[0].interval = data::Range{.min = 0.3F, .max = 0.8F};
    const auto known = draw(scene, {8, 8});
    EXPECT_THAT(emptyBricks(known).reason, HasSubstr("whatever the code shows"));
    EXPECT_EQ(known.info.work.bufferUploads, 2U) << "the empty space and the blocks";
    // Where all voxels of a brick lack a value there is nothing to ask of either.
    scene = sceneOf(balls(std::nan("")), kCode);
    lookAtBalls(scene);
    const auto missing = draw(scene, {48, 40});
    EXPECT_TRUE(emptyBricks(missing).on);
    EXPECT_THAT(emptyBricks(missing).reason, HasSubstr("without any value"));
    EXPECT_GT(drawnShare(missing), 0.0);
}

}  // namespace
}  // namespace volcast
