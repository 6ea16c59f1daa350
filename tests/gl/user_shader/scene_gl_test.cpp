// Code in a scene: the picture of a map, the cost of a change, what else a layer has.
#include <gmock/gmock.h>

#include "renderer/plan/effects.h"
#include "tests/gl/user_shader/user_shader_fixture.h"

namespace volcast {
namespace {

using scene::RayModel;
using ::testing::HasSubstr;

class UserShaderScene : public support::UserShaderTest {
protected:
    static data::Volume waves() {
        return support::volumeOf({.size = {17, 17, 17}}, [](const glm::dvec3& p) {
            return 0.5 +
                   0.4 * std::sin(0.5 * p.x) * std::cos(0.4 * p.y) * std::sin(0.3 * p.z + 1.0);
        });
    }
};

// The same matter once as a map and once as code: linear in the value, from transparent black to
// orange of extinction 0.4.
TEST_F(UserShaderScene, IdentityShowsTheMapsOwnPicture) {
    for (const auto sampling :
         {scene::Sampling::kNearest, scene::Sampling::kTrilinear, scene::Sampling::kTricubic}) {
        scene::Scene scene = sceneOf(waves(), "");
        scene::Layer& layer = scene.layers[0];
        layer.sampling = sampling;
        layer.map.points = {{.value = 0.0F, .colour = {0, 0, 0}, .extinction = 0.0F},
                            {.value = 1.0F, .colour = {1.0F, 0.5F, 0.1F}, .extinction = 0.4F}};
        const auto byMap = draw(scene, {48, 48}, 1);
        // An extinction s has the opacity 1 - exp(-s d) over the reference distance d.
        const double reference = std::sqrt(3.0) * 16.0 / 64.0;
        layer.shader.code =
            "#uicontrol invlerp value(range=[0, 1], clamp=false)\n"
            "void main() { float v = clamp(value(), 0.0, 1.0);\n"
            "emitRGBA(vec4(v * vec3(1.0, 0.5, 0.1), 1.0 - exp(-0.4 * v * " +
            std::to_string(reference) + "))); }";
        const auto byCode = draw(scene, {48, 48}, 2);
        EXPECT_GT(drawnShare(byMap), 0.15);
        EXPECT_LT(largestDifference(byMap, byCode), 2e-5)
            << "sampling " << static_cast<int>(sampling);
    }
}

TEST_F(UserShaderScene, IdentityOfMaximaShowsTheMapsOwnPicture) {
    for (const RayModel model : {RayModel::kMip, RayModel::kMinip}) {
        scene::Scene scene = sceneOf(waves(), "", model);
        scene::Layer& layer = scene.layers[0];
        layer.map.points = {{.value = 0.1F, .colour = {1, 0, 0}, .extinction = 1.0F},
                            {.value = 0.9F, .colour = {0, 0, 1}, .extinction = 1.0F}};
        const auto byMap = draw(scene, {48, 48}, 1);
        layer.shader.code =
            "#uicontrol transferFunction map(controlPoints=[[0.1, \"red\", 1], [0.9, \"blue\", "
            "1]])\n"
            "void main() { vec4 c = map(); emitIntensity(toRaw(getInterpolatedDataValue()));\n"
            "emitRGB(c.rgb); }";
        const auto byCode = draw(scene, {48, 48}, 2);
        EXPECT_GT(drawnShare(byMap), 0.15);
        EXPECT_LT(largestDifference(byMap, byCode), 2e-5);
    }
}

constexpr const char* kControlled =
    "#uicontrol float s slider(min=0, max=1, default=0.5)\n"
    "#uicontrol vec3 c color(default=\"red\")\n"
    "#uicontrol int o select(options={\"a\": 1, \"b\": 2})\n"
    "#uicontrol bool b checkbox\n"
    "#uicontrol invlerp n(range=[0, 1])\n"
    "#uicontrol transferFunction t(controlPoints=[[0, \"red\", 0], [1, \"blue\", 1]])\n"
    "void main() { vec4 m = t(); emitRGBA(vec4(c * s + m.rgb * float(o) * (b ? 0.0 : 0.1), "
    "m.a * n())); }";

TEST_F(UserShaderScene, AChangeOfAControlIsOneUpload) {
    scene::Scene scene = sceneOf(waves(), kControlled);
    auto before = draw(scene, {32, 32});
    EXPECT_EQ(before.info.work.programsBuilt, 2U) << "the march and the resolve";
    const auto change = [&](scene::ControlState state) {
        std::erase_if(scene.layers[0].shader.controls,
                      [&](const scene::ControlState& old) { return old.name == state.name; });
        scene.layers[0].shader.controls.push_back(std::move(state));
        auto after = draw(scene, {32, 32});
        EXPECT_GT(largestDifference(before, after), 1e-3);
        before = after;
        return after.info.work;
    };
    const std::vector<scene::ControlState> states{
        {.name = "s", .value = 0.75},
        {.name = "c", .value = glm::vec3(0.0F, 1.0F, 0.0F)},
        {.name = "o", .value = 2.0},
        {.name = "n", .value = scene::InvlerpState{.range = data::Range{.min = 0.8F, .max = 0.2F}}},
        {.name = "t",
         .value =
             scene::MapState{.points = {{.value = 0.2F, .colour = {0, 1, 0}, .opacity = 0.5F}}}}};
    for (const scene::ControlState& state : states) {
        const scene::Counters work = change(state);
        EXPECT_EQ(work.programsBuilt, 0U) << state.name;
        EXPECT_EQ(work.bufferUploads, 1U) << state.name;
        EXPECT_EQ(work.textureUploads, 0U) << state.name;
        EXPECT_LT(work.uploadedBytes, 1000U) << state.name;
    }
    EXPECT_EQ(change({.name = "b", .value = true}).programsBuilt, 1U)
        << "a checkbox is a constant of the program";
    EXPECT_EQ(change({.name = "b", .value = false}).programsBuilt, 0U) << "and was built before";
}

TEST_F(UserShaderScene, OnlyChannelsThatAreReadAreUploaded) {
    const data::Volume volume = slab<std::uint8_t>(data::VoxelType::kU8, 10, 4);
    const auto info =
        draw(slabScene(volume, "void main() { emitGrayscale(toNormalized(getDataValue(2))); }"),
             {4, 4})
            .info;
    EXPECT_EQ(info.work.textureUploads, 2U) << "the layer's channel and the one that is read";
}

TEST_F(UserShaderScene, ThePlanSaysWhy) {
    const auto picture = draw(sceneOf(waves(), kControlled), {8, 8});
    const plan::LayerPlan& plan = picture.info.plan.layers[0];
    EXPECT_EQ(plan.integrator, "user shader");
    EXPECT_TRUE(plan.has(plan::kUserShader));
    EXPECT_FALSE(plan.has(plan::kEmptyBricks));
}

TEST_F(UserShaderScene, IntervalsAndClipPlanesCutIt) {
    const std::string code = "void main() { emitRGB(vec3(1.0)); }";
    scene::Scene scene = sceneOf(waves(), code);
    const double whole = drawnShare(draw(scene, {32, 32}));
    scene.clipPlanes = {{.normal = {1, 0, 0}, .offset = 12.0}};
    EXPECT_LT(drawnShare(draw(scene, {32, 32})), 0.7 * whole);
    scene.clipPlanes.clear();
    scene.layers[0].interval = data::Range{.min = 0.8F, .max = 1.0F};
    EXPECT_LT(drawnShare(draw(scene, {32, 32})), 0.9 * whole);
}

TEST_F(UserShaderScene, WhatIsWrongLeavesTheViewAsItWas) {
    scene::Scene scene = sceneOf(waves(), kControlled);
    const auto good = draw(scene, {16, 16});
    const auto refused = [&](const std::string& code) {
        scene.layers[0].shader = {.code = code, .controls = {}};
        const auto drawn = tryDraw(*renderer_, scene, {16, 16});
        EXPECT_FALSE(drawn.has_value()) << code;
        return drawn ? Error{} : drawn.error();
    };
    const Error error = refused("void main() {\n  emitRGB(c);\n}");
    EXPECT_EQ(error.code, ErrorCode::kInvalidArgument);
    EXPECT_EQ(error.field, "layers[0].shader.code");
    EXPECT_EQ(error.message, "layers[0].shader.code:\nline 2: 'c' : undeclared identifier");
    EXPECT_THAT(refused("void main() { for (;;) {} }").message, HasSubstr("line 1: the loop"));
    scene.layers[0].shader = {.code = kControlled, .controls = {}};
    const auto again = draw(scene, {16, 16});
    EXPECT_FALSE(again.info.drawn) << "the last good picture is still there";
    EXPECT_EQ(largestDifference(good, again), 0.0);
}

// Long loops of the code take from the samples of a ray: the driver counts both together, and ends
// them without a word.
TEST_F(UserShaderScene, LoopsOfTheCodeLeaveNoRayUnfinished) {
    const std::string code =
        "void main() { float sum = 0.0; for (int i = 0; i < 200; ++i) sum += float(i) * "
        "getDataValue();\nemitRGBA(vec4(sum / 19900.0, 0.0, 0.0, 0.01)); }";
    scene::Scene scene = slabScene(slab<float>(data::VoxelType::kF32, 1.0F), code);
    scene.layers[0].stepWorld = 0.004;
    const double alpha = 1.0 - std::pow(1.0 - 0.01, 4.0 * 64.0 / 12.0);
    EXPECT_NEAR(draw(scene, {4, 4}).at(2, 1).a, alpha, 1e-4);
}

}  // namespace
}  // namespace volcast
