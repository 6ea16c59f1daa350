#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "renderer/user_shader/parse.h"

namespace volcast::user_shader {
namespace {

/// The one control of a line.
template <class Kind>
Kind only(const std::string& line) {
    const Parsed parsed = parse(line);
    EXPECT_TRUE(parsed.complaints.empty()) << line << ": " << parsed.complaints.front().message;
    if (parsed.controls.size() != 1 || !std::holds_alternative<Kind>(parsed.controls[0].kind)) {
        ADD_FAILURE() << line << " declares something else";
        return {};
    }
    return std::get<Kind>(parsed.controls[0].kind);
}

TEST(UserShaderControls, SliderHasTheDefaultsOfItsType) {
    const auto real = only<Slider>("#uicontrol float x slider(min=-1, max=3)");
    EXPECT_EQ(real, (Slider{.min = -1.0, .max = 3.0, .step = 0.04, .initial = 1.0}));
    const auto whole = only<Slider>("#uicontrol int x slider(min=2, max=9)");
    EXPECT_EQ(
        whole,
        (Slider{.type = NumberType::kInt, .min = 2.0, .max = 9.0, .step = 1.0, .initial = 2.0}));
    const auto given = only<Slider>("#uicontrol uint x slider(min=0, max=9, default=7, step=3)");
    EXPECT_EQ(
        given,
        (Slider{.type = NumberType::kUint, .min = 0.0, .max = 9.0, .step = 3.0, .initial = 7.0}));
    const auto point = only<Slider>("#uicontrol float x slider(min=2, max=2)");
    EXPECT_EQ(point.initial, 2.0);
    EXPECT_GT(point.step, 0.0);
}

TEST(UserShaderControls, ColourIsAnyCssColourAndWhiteByDefault) {
    EXPECT_EQ(only<Colour>("#uicontrol vec3 c color").initial, glm::vec3(1.0F));
    EXPECT_EQ(only<Colour>("#uicontrol vec3 c color()").initial, glm::vec3(1.0F));
    EXPECT_EQ(only<Colour>("#uicontrol vec3 c color(default=\"#ff0000\")").initial,
              glm::vec3(1.0F, 0.0F, 0.0F));
    EXPECT_EQ(only<Colour>("#uicontrol vec3 c color(default=\"#0F0\")").initial,
              glm::vec3(0.0F, 1.0F, 0.0F));
    EXPECT_EQ(only<Colour>("#uicontrol vec3 c color(default=\"Orange\")").initial,
              glm::vec3(255.0F, 165.0F, 0.0F) / 255.0F);
    EXPECT_EQ(only<Colour>("#uicontrol vec3 c color(default=\"rgb(0, 50%, 255)\")").initial,
              glm::vec3(0.0F, 0.5F, 1.0F));
}

TEST(UserShaderControls, CheckboxIsOffByDefault) {
    EXPECT_FALSE(only<Checkbox>("#uicontrol bool b checkbox").initial);
    EXPECT_TRUE(only<Checkbox>("#uicontrol bool b checkbox(default=true)").initial);
}

TEST(UserShaderControls, SelectTakesAListOrLabels) {
    const auto list = only<Select>("#uicontrol int s select(options=[3, 1], default=1)");
    ASSERT_EQ(list.options.size(), 2U);
    EXPECT_EQ(list.options[0].label, "3");
    EXPECT_EQ(std::get<double>(list.options[1].value), 1.0);
    EXPECT_EQ(list.initial, 1U);
    const auto labelled =
        only<Select>("#uicontrol float s select(options={\"Low\": 0.5, \"High\": 2})");
    ASSERT_EQ(labelled.options.size(), 2U);
    EXPECT_EQ(labelled.options[0].label, "Low");
    EXPECT_EQ(std::get<double>(labelled.options[1].value), 2.0);
    EXPECT_EQ(labelled.initial, 0U);
    const auto texts =
        only<Select>("#uicontrol string_t s select(options=[\"a, b\", \"c)\"], default=\"c)\")");
    EXPECT_TRUE(texts.texts);
    EXPECT_EQ(texts.options[0].label, "a, b");
    EXPECT_EQ(texts.initial, 1U);
}

TEST(UserShaderControls, InvLerpStandsInPlaceOfAType) {
    const auto plain = only<InvLerp>("#uicontrol invlerp contrast");
    EXPECT_EQ(plain, InvLerp{});
    const auto given = only<InvLerp>(
        "#uicontrol invlerp contrast(range=[9, 1], window=[0, 20], channel=2, clamp=false)");
    EXPECT_EQ(given.range, (Interval{.from = 9.0, .to = 1.0})) << "an inverted range is legal";
    EXPECT_EQ(given.window, (Interval{.from = 0.0, .to = 20.0}));
    EXPECT_EQ(given.channel, 2);
    EXPECT_FALSE(given.clamp);
    EXPECT_EQ(only<InvLerp>("#uicontrol invlerp c(channel=[])").channel, std::nullopt);
    EXPECT_EQ(only<InvLerp>("#uicontrol invlerp c(channel=[1])").channel, 1);
}

TEST(UserShaderControls, TransferFunctionTakesBothForms) {
    const auto given = only<TransferFunction>(
        "#uicontrol transferFunction tf(window=[0, 9], controlPoints=[[5, \"#ffffff\", 1], "
        "[1, \"#ff0000\", 0.25]], channel=[1], defaultColor=\"#00ff00\")");
    ASSERT_TRUE(given.points.has_value());
    EXPECT_EQ(*given.points, (std::vector<OpacityPoint>{
                                 {.value = 1.0, .colour = {1.0F, 0.0F, 0.0F}, .opacity = 0.25},
                                 {.value = 5.0, .colour = glm::vec3(1.0F), .opacity = 1.0}}))
        << "points are sorted";
    EXPECT_EQ(given.channel, 1);
    EXPECT_EQ(given.defaultColour, glm::vec3(0.0F, 1.0F, 0.0F));
    const auto old = only<TransferFunction>(
        "#uicontrol transferFunction tf(channel=0, color=\"red\", range=[0, 9], "
        "points=[[1, 255, 0, 0, 51]])");
    ASSERT_TRUE(old.points.has_value());
    EXPECT_EQ(old.points->front().colour, glm::vec3(1.0F, 0.0F, 0.0F));
    EXPECT_DOUBLE_EQ(old.points->front().opacity, 0.2);
    EXPECT_EQ(old.window, (Interval{.from = 0.0, .to = 9.0}));
    const auto none = only<TransferFunction>("#uicontrol transferFunction tf(controlPoints=[])");
    EXPECT_TRUE(none.points && none.points->empty()) << "no points: transparent";
    EXPECT_FALSE(only<TransferFunction>("#uicontrol transferFunction tf").points.has_value());
}

TEST(UserShaderControls, DefaultPointsLieAtTwoFifthsAndSevenTenths) {
    const std::vector<OpacityPoint> points = defaultPoints({.from = 100.0, .to = 200.0});
    ASSERT_EQ(points.size(), 2U);
    EXPECT_DOUBLE_EQ(points[0].value, 140.0);
    EXPECT_DOUBLE_EQ(points[1].value, 170.0);
    EXPECT_EQ(points[0].opacity, 0.0);
    EXPECT_EQ(points[1].opacity, 1.0);
    EXPECT_EQ(points[1].colour, glm::vec3(1.0F));
}

TEST(UserShaderControls, DirectivesBecomeEmptyLinesAndCommentsBlanks) {
    const Parsed parsed = parse(
        "// #uicontrol float no slider(min=0, max=1)\n"
        " # uicontrol float x slider(min=0, /* c */ max=1) // note\n"
        "/* two\nlines */ void main() {}\n"
        "#uicontrol vec3 c color(default=\"#ff00ff\")  \t\n"
        "#uicontrol string_t s select(options=[\"/* kept */\", \"// kept\"])\n");
    EXPECT_TRUE(parsed.complaints.empty()) << parsed.complaints.front().message;
    EXPECT_EQ(parsed.body, std::string(43, ' ') + "\n\n      \n         void main() {}\n\n\n");
    ASSERT_EQ(parsed.controls.size(), 3U);
    EXPECT_EQ(parsed.controls[0].name, "x");
    EXPECT_EQ(parsed.controls[0].line, 2);
    EXPECT_EQ(std::get<Select>(parsed.controls[2].kind).options[0].label, "/* kept */");
    EXPECT_EQ(std::get<Select>(parsed.controls[2].kind).options[1].label, "// kept");
}

TEST(UserShaderControls, OtherDirectivesStayInTheBodyForTheLexer) {
    const Parsed parsed = parse("#uicontrols float x\n#define A 1");
    EXPECT_TRUE(parsed.controls.empty());
    EXPECT_EQ(parsed.body, "#uicontrols float x\n#define A 1\n");
}

}  // namespace
}  // namespace volcast::user_shader
