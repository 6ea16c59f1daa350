#include "renderer/user_shader/texels.h"

#include <bit>
#include <cstdint>

#include <gtest/gtest.h>

#include "renderer/user_shader/parse.h"

namespace volcast::user_shader {
namespace {

std::vector<glm::vec4> texelsOf(const std::string& code, ValueType type = ValueType::kF32) {
    const Parsed parsed = parse(code);
    EXPECT_TRUE(parsed.complaints.empty());
    return controlTexels(parsed.controls, type,
                         {.referencesAWorldUnit = 2.5, .intervalShift = 7.0});
}

TEST(UserShaderTexels, HoldNumbersOfTheirType) {
    const auto texels = texelsOf(
        "#uicontrol float a slider(min=0, max=1, default=0.25)\n"
        "#uicontrol int b slider(min=-9, max=1, default=-7)\n"
        "#uicontrol uint c slider(min=0, max=4294967295, default=4294967295)\n"
        "#uicontrol string_t d select(options=[\"x\", \"y\"], default=\"y\")\n"
        "#uicontrol float e select(options=[1.5, 2.5])\n");
    ASSERT_EQ(texels.size(), 6U);
    EXPECT_EQ(texels[0], glm::vec4(2.5F, 7.0F, 0.0F, 0.0F));
    EXPECT_EQ(texels[1].x, 0.25F);
    EXPECT_EQ(std::bit_cast<std::int32_t>(texels[2].x), -7);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(texels[3].x), 4294967295U);
    EXPECT_EQ(std::bit_cast<std::int32_t>(texels[4].x), 1);
    EXPECT_EQ(texels[5].x, 1.5F);
}

TEST(UserShaderTexels, HoldColoursInLinearLight) {
    const auto texels = texelsOf("#uicontrol vec3 c color(default=\"#ff8000\")");
    ASSERT_EQ(texels.size(), 2U);
    EXPECT_EQ(texels[1].r, 1.0F);
    EXPECT_NEAR(texels[1].g, 0.2158605F, 1e-6F) << "((128 / 255 + 0.055) / 1.055)^2.4";
    EXPECT_EQ(texels[1].b, 0.0F);
}

TEST(UserShaderTexels, HoldRangesOfTheDataWhereNoneIsDeclared) {
    const auto lerp = texelsOf("#uicontrol invlerp n", ValueType::kI16);
    EXPECT_EQ(lerp[1].x, -32768.0F);
    EXPECT_FLOAT_EQ(lerp[1].y, 1.0F / 65535.0F);
    const auto inverted = texelsOf("#uicontrol invlerp n(range=[6, 2])");
    EXPECT_EQ(inverted[1].x, 6.0F);
    EXPECT_EQ(inverted[1].y, -0.25F);
}

TEST(UserShaderTexels, HoldPointsBehindTheControls) {
    const auto texels = texelsOf(
        "#uicontrol transferFunction t(window=[0, 4], controlPoints=[[1, \"#ff0000\", 0.5], "
        "[3, \"#ffffff\", 1]])\n#uicontrol transferFunction none(controlPoints=[])\n");
    ASSERT_EQ(texels.size(), 7U);
    EXPECT_EQ(texels[1], glm::vec4(0.0F, 0.25F, 2.0F, 3.0F));
    EXPECT_EQ(texels[2].z, 0.0F);
    EXPECT_EQ(texels[3], glm::vec4(1.0F, 0.0F, 0.0F, 0.5F));
    EXPECT_EQ(texels[4], glm::vec4(1.0F, 0.5F, 0.0F, 0.0F));
    EXPECT_EQ(texels[5], glm::vec4(1.0F));
    EXPECT_EQ(texels[6], glm::vec4(3.0F, 0.0F, 0.0F, 0.0F));
}

}  // namespace
}  // namespace volcast::user_shader
