#include "renderer/scene/user_controls.h"

#include <limits>
#include <ostream>

#include "gmock/gmock.h"
#include "gtest/gtest.h"

#include "renderer/scene/ray_models.h"
#include "renderer/scene/validate.h"

namespace volcast::scene {
namespace {

using ::testing::HasSubstr;

constexpr const char* kCode =
    "#uicontrol float s slider(min=0, max=1)\n#uicontrol int i slider(min=0, max=9)\n"
    "#uicontrol vec3 c color\n#uicontrol bool b checkbox\n"
    "#uicontrol int o select(options=[1, 2])\n"
    "#uicontrol string_t w select(options=[\"x\", \"y\"])\n"
    "#uicontrol invlerp n\n#uicontrol transferFunction t\nvoid main() {}\n";

struct BadState {
    ControlState state;
    const char* message;
};

std::ostream& operator<<(std::ostream& out, const BadState& bad) {
    return out << bad.state.name << ": " << bad.message;
}

class UserControls : public ::testing::TestWithParam<BadState> {};

TEST_P(UserControls, StateIsRefusedByName) {
    const auto code = resolved({.code = kCode, .controls = {GetParam().state}}, "layers[0].shader");
    ASSERT_FALSE(code.has_value());
    EXPECT_THAT(code.error().message, HasSubstr(GetParam().message));
    EXPECT_EQ(code.error().field, "layers[0].shader.controls[0]");
}

MapState points(std::vector<MapState::Point> list) {
    return {.points = std::move(list)};
}

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    States, UserControls,
    ::testing::Values(
        BadState{{.name = "z", .value = 1.0},
                 "the code declares no control \"z\"; it declares s, i, c, b, o, w, n, t"},
        BadState{{.name = "s", .value = 1.5}, "the control \"s\": 1.5 is not in 0 to 1"},
        BadState{{.name = "s", .value = double{kNan}}, "is not in 0 to 1"},
        BadState{{.name = "i", .value = 1.5}, "1.5 is not an integer"},
        BadState{{.name = "s", .value = true},
                 "is a slider, whose state is a number, not checked or not"},
        BadState{{.name = "c", .value = 1.0}, "is a color, whose state is a colour, not a number"},
        BadState{{.name = "c", .value = glm::vec3(0.0F, 2.0F, 0.0F)},
                 "its red, green and blue are not all in 0 to 1"},
        BadState{{.name = "b", .value = 1.0},
                 "is a checkbox, whose state is checked or not, not a number"},
        BadState{{.name = "o", .value = 3.0}, "3 is not one of 1, 2"},
        BadState{{.name = "w", .value = std::string{"z"}}, "\"z\" is not one of \"x\", \"y\""},
        BadState{{.name = "w", .value = 1.0}, "whose state is a choice, not a number"},
        BadState{{.name = "n", .value = 1.0}, "whose state is an invlerp state, not a number"},
        BadState{{.name = "n", .value = InvlerpState{.range = data::Range{.min = 1, .max = 1}}},
                 "its range 1 to 1 has no length"},
        BadState{{.name = "n", .value = InvlerpState{.window = data::Range{.min = 2, .max = 1}}},
                 "its window 2 to 1 is not in order"},
        BadState{{.name = "n", .value = InvlerpState{.channel = -1}}, "there is no channel -1"},
        BadState{{.name = "t", .value = InvlerpState{}}, "whose state is a map"},
        BadState{{.name = "t", .value = points({{.value = kNan}})},
                 "point 0: its value is not finite"},
        BadState{{.name = "t", .value = points({{.value = 1.0F}, {.value = 0.0F}})},
                 "point 1: 0 is below the point before"},
        BadState{{.name = "t", .value = points({{.opacity = 1.5F}})},
                 "point 0: the opacity 1.5 is not in 0 to 1"},
        BadState{{.name = "t", .value = points(std::vector<MapState::Point>(257))},
                 "257 points, at most 256"}));

TEST(UserControlsTaken, BecomeTheControlsValues) {
    const auto code =
        resolved({.code = kCode,
                  .controls = {{.name = "s", .value = 0.25},
                               {.name = "w", .value = std::string{"y"}},
                               {.name = "n",
                                .value = InvlerpState{.range = data::Range{.min = 2, .max = 1},
                                                      .channel = 3}}}},
                 "shader");
    ASSERT_TRUE(code.has_value()) << code.error().message;
    EXPECT_EQ(std::get<user_shader::Slider>(code->controls[0].kind).initial, 0.25);
    EXPECT_EQ(std::get<user_shader::Select>(code->controls[5].kind).initial, 1U);
    const auto& lerp = std::get<user_shader::InvLerp>(code->controls[6].kind);
    EXPECT_EQ(lerp.range, (user_shader::Interval{.from = 2.0, .to = 1.0}));
    EXPECT_EQ(lerp.channel, 3);
    data::DatasetSummary summary;
    summary.fields.resize(4);
    EXPECT_EQ(otherChannels(*code, {}, summary), std::vector<int>{3});
}

/// A scene of one volume with `channels` channels, and its summary.
class ShaderLayer : public ::testing::Test {
protected:
    Result<void> valid() {
        Scene scene;
        scene.layers.push_back(layer_);
        if (auto plain = validate(scene); !plain) return plain;
        data::DatasetSummary summary;
        summary.isMesh = mesh_;
        summary.voxels = {4, 4, 4};
        for (int i = 0; i < 10; ++i) {
            data::FieldSummary field;
            field.name = "f" + std::to_string(i);
            field.steps = 1;
            summary.fields.push_back(field);
        }
        return validate(scene, {{"d", summary}});
    }
    void expectRefused(const std::string& message, const char* field) {
        const Result<void> result = valid();
        ASSERT_FALSE(result.has_value());
        EXPECT_THAT(result.error().message, HasSubstr(message));
        EXPECT_EQ(result.error().field, field);
    }

    Layer layer_ = [] {
        Layer layer;
        layer.id = "l";
        layer.dataset = "d";
        layer.field = "f2";
        layer.shader.code = "void main() {}";
        return layer;
    }();
    bool mesh_ = false;
};

TEST_F(ShaderLayer, NeedsNoMap) {
    EXPECT_TRUE(valid().has_value());
    layer_.shader = {};
    EXPECT_FALSE(valid().has_value()) << "without code there must be one";
}

TEST_F(ShaderLayer, ErrorsHaveTheUsersLine) {
    layer_.shader.code = "\nvoid main() {\n  gl_FragCoord;\n}\n#define A";
    expectRefused(
        "layers[0].shader.code:\nline 5: #define is not allowed; #uicontrol is the only directive",
        "layers[0].shader.code");
    layer_.shader.code = "\nvoid main() {\n  gl_FragCoord;\n}";
    expectRefused("line 3, column 3: gl_FragCoord is not allowed", "layers[0].shader.code");
}

TEST_F(ShaderLayer, StatesWithoutCodeAreRefused) {
    layer_.map.points = {{}};
    layer_.shader = {.code = "", .controls = {{.name = "a", .value = 1.0}}};
    expectRefused("there is no code that declares them", "layers[0].shader.controls");
}

TEST_F(ShaderLayer, DoubledStatesAreRefused) {
    layer_.shader = {.code = kCode,
                     .controls = {{.name = "s", .value = 1.0}, {.name = "s", .value = 0.0}}};
    expectRefused("the control \"s\" has a state already", "layers[0].shader.controls[1]");
}

TEST_F(ShaderLayer, ServesWhatHasSamples) {
    for (const RayModel model :
         {RayModel::kVolume, RayModel::kMip, RayModel::kMinip, RayModel::kCrossSections}) {
        layer_.model = model;
        EXPECT_TRUE(valid().has_value());
    }
    for (const RayModel model : {RayModel::kMipColour, RayModel::kXray, RayModel::kSplat,
                                 RayModel::kIsosurface, RayModel::kSurface, RayModel::kWireframe}) {
        layer_.model = model;
        layer_.levels.values = {0.5F};
        expectRefused(
            "code says what samples of volume, mip, minip and cross_sections show, not of " +
                std::string{name(model)},
            "layers[0].shader");
    }
    layer_.model = RayModel::kVolume;
    layer_.light = Light{};
    expectRefused("light needs the gradient of a field", "layers[0].light");
}

TEST_F(ShaderLayer, ServesMeshesByTheirFields) {
    mesh_ = true;
    for (const RayModel model : {RayModel::kVolume, RayModel::kMip, RayModel::kMinip}) {
        layer_.model = model;
        EXPECT_TRUE(valid().has_value());
    }
    layer_.shader.code = "void main() { getDataValue(10); }";
    expectRefused("there is no field 10; \"d\" has 10, from 0", "layers[0].shader");
    layer_.shader.code = "void main() { int i = 0; getDataValue(i); }";
    expectRefused("reads 10 fields, at most 6", "layers[0].shader");
    layer_.shader.code = "void main() { getDataValue(9) + getDataValue(2) + getDataValue(); }";
    EXPECT_TRUE(valid().has_value());
    layer_.scale.domain = data::Range{.min = 0.0F, .max = 0.5F};
    expectRefused("code is given values as they are stored", "layers[0].scale");
}

TEST_F(ShaderLayer, ChannelsMustBeThereAndFew) {
    layer_.shader.code = "void main() { getDataValue(10); }";
    expectRefused("there is no channel 10; \"d\" has 10, from 0", "layers[0].shader");
    layer_.shader.code = "void main() { int i = 0; getDataValue(i); }";
    expectRefused("reads 10 channels, at most 8", "layers[0].shader");
}

}  // namespace
}  // namespace volcast::scene
