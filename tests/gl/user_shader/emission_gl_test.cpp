// What code that users write shows, where the answer is known.
#include <cmath>

#include "tests/gl/user_shader/user_shader_fixture.h"

namespace volcast {
namespace {

using data::VoxelType;
using scene::RayModel;

class UserShader : public support::UserShaderTest {
protected:
    /// What one sample shows: the slab is as good as opaque after one, whatever its opacity.
    glm::vec3 shown(const data::Volume& volume, const std::string& code) {
        return glm::vec3(draw(slabScene(volume, code), {4, 4}).at(2, 1));
    }
    /// A grayscale that `expression` gives.
    float valueOf(const data::Volume& volume, const std::string& expression,
                  const std::string& before = "") {
        return shown(volume, before + "\nvoid main() { emitRGB(vec3(" + expression + ")); }").r;
    }
};

TEST_F(UserShader, DataIsTypedAndReadRawOrNormalized) {
    const data::Volume u8 = slab<std::uint8_t>(VoxelType::kU8, 51);
    EXPECT_NEAR(valueOf(u8, "toNormalized(getDataValue())"), 0.2F, 1e-6F);
    EXPECT_NEAR(valueOf(u8, "toRaw(getDataValue()) == 51u ? 0.75 : 0.0"), 0.75F, 1e-6F);
    EXPECT_NEAR(valueOf(u8, "toNormalized(getInterpolatedDataValue())"), 0.2F, 1e-6F);
    const data::Volume u16 = slab<std::uint16_t>(VoxelType::kU16, 13107);
    EXPECT_NEAR(valueOf(u16, "toNormalized(getDataValue())"), 0.2F, 1e-6F);
    const data::Volume i16 = slab<std::int16_t>(VoxelType::kI16, -32768);
    EXPECT_NEAR(valueOf(i16, "-0.5 * toNormalized(getDataValue())"), 0.5F, 1e-6F);
    EXPECT_NEAR(valueOf(i16, "toRaw(getDataValue()) == -32768 ? 0.75 : 0.0"), 0.75F, 1e-6F);
    const data::Volume f32 = slab<float>(VoxelType::kF32, 0.375F);
    EXPECT_NEAR(valueOf(f32, "toRaw(getDataValue())"), 0.375F, 1e-6F);
    EXPECT_NEAR(valueOf(f32, "getDataValue()"), 0.375F, 1e-6F);
}

TEST_F(UserShader, ChannelsAreReadByNumber) {
    const data::Volume volume = slab<std::uint8_t>(VoxelType::kU8, 10, 4);
    const std::string scale = " / 100.0";
    EXPECT_NEAR(valueOf(volume, "float(toRaw(getDataValue()))" + scale), 0.10F, 1e-6F);
    EXPECT_NEAR(valueOf(volume, "float(toRaw(getDataValue(2)))" + scale), 0.12F, 1e-6F);
    EXPECT_NEAR(valueOf(volume, "float(toRaw(getInterpolatedDataValue(3)))" + scale), 0.13F, 1e-6F);
    EXPECT_NEAR(
        valueOf(volume, "float(toRaw(getDataValue(one + 1)))" + scale, "const int one = 1;"), 0.12F,
        1e-6F);
    EXPECT_NEAR(valueOf(volume, "n()", "#uicontrol invlerp n(range=[3, 23], channel=3)"), 0.5F,
                1e-6F);
}

// A sample's opacity is that of a 64th of the diagonal.
TEST_F(UserShader, OpacityIsCorrectedForTheLengthOfASample) {
    const data::Volume volume = slab<float>(VoxelType::kF32, 1.0F);
    scene::Scene scene = slabScene(volume, "void main() { emitRGBA(vec4(0.9, 0.5, 0.1, 0.03)); }");
    const double diagonal = std::sqrt(8.0 * 8.0 + 8.0 * 8.0 + 4.0 * 4.0);
    const double alpha = 1.0 - std::pow(1.0 - 0.03, 4.0 / (diagonal / 64.0));
    for (const double step : {3.0, 0.7, 0.013}) {
        scene.layers[0].stepWorld = step;
        const auto picture = draw(scene, {4, 4});
        EXPECT_NEAR(picture.at(2, 1).a, alpha, 2e-5) << "step " << step;
        EXPECT_NEAR(picture.at(2, 1).r, 0.9 * alpha, 2e-5) << "step " << step;
    }
    scene.layers[0].gain = 1.0F;
    const double more = 1.0 - std::pow(1.0 - alpha, std::exp(1.0));
    EXPECT_NEAR(draw(scene, {4, 4}).at(2, 1).a, more, 2e-5) << "gain is a factor e^gain";
}

TEST_F(UserShader, EmissionOfEachKind) {
    const data::Volume volume = slab<float>(VoxelType::kF32, 1.0F);
    const auto pixel = [&](const std::string& body) {
        return draw(slabScene(volume, "void main() { " + body + " }"), {4, 4}).at(2, 1);
    };
    EXPECT_EQ(pixel("emitTransparent();"), glm::vec4(0.0F));
    EXPECT_EQ(pixel(""), glm::vec4(0.0F)) << "code that emits nothing";
    EXPECT_EQ(pixel("emitRGBA(vec4(1.0, 1.0, 1.0, 0.0));"), glm::vec4(0.0F));
    EXPECT_EQ(pixel("float z = getDataValue() - 1.0; emitRGBA(vec4(z / z));"), glm::vec4(0.0F))
        << "what is no number is transparent";
    EXPECT_GT(pixel("emitGrayscale(0.5);").a, 0.99F);
    EXPECT_NEAR(pixel("emitGrayscale(0.5);").g, 0.5F, 0.01F);
    EXPECT_NEAR(pixel("emitRGBA(vec4(0.25, 0.5, 0.75, 9.0));").b, 0.75F, 1e-5F);
    EXPECT_NEAR(pixel("emitRGB(vec3(VOLUME_RENDERING ? 1.0 : 0.0));").r, 1.0F, 1e-5F);
}

TEST_F(UserShader, ControlsHaveTheirDeclaredValues) {
    const data::Volume volume = slab<std::uint8_t>(VoxelType::kU8, 51);
    EXPECT_NEAR(valueOf(volume, "x", "#uicontrol float x slider(min=0, max=1, default=0.25)"),
                0.25F, 1e-6F);
    EXPECT_NEAR(valueOf(volume, "x == -7 ? 0.5 : 0.0",
                        "#uicontrol int x slider(min=-9, max=1, default=-7)"),
                0.5F, 1e-6F);
    EXPECT_NEAR(valueOf(volume, "x == 4000000000u ? 0.5 : 0.0",
                        "#uicontrol uint x slider(min=0, max=4000000001, default=4000000000)"),
                0.5F, 1e-6F);
    EXPECT_NEAR(valueOf(volume, "x ? 0.5 : 0.0", "#uicontrol bool x checkbox(default=true)"), 0.5F,
                1e-6F);
    EXPECT_NEAR(valueOf(volume, "x == 1 ? 0.5 : 0.0",
                        "#uicontrol string_t x select(options=[\"a\", \"b\"], default=\"b\")"),
                0.5F, 1e-6F);
    EXPECT_NEAR(valueOf(volume, "c.g", "#uicontrol vec3 c color(default=\"#ff8000\")"), 0.2158605F,
                1e-5F);
    EXPECT_NEAR(valueOf(volume, "n()", "#uicontrol invlerp n"), 0.2F, 1e-6F);
    EXPECT_NEAR(valueOf(volume, "n(getDataValue())", "#uicontrol invlerp n(range=[102, 0])"), 0.5F,
                1e-6F);
    EXPECT_NEAR(valueOf(volume, "0.5 * n()", "#uicontrol invlerp n(range=[0, 10])"), 0.5F, 1e-6F)
        << "clamped";
    EXPECT_NEAR(valueOf(volume, "0.1 * n()", "#uicontrol invlerp n(range=[0, 10], clamp=false)"),
                0.51F, 1e-6F);
}

TEST_F(UserShader, TransferFunctionsAreLinearBetweenPoints) {
    const std::string points =
        "#uicontrol transferFunction t(controlPoints=[[20, \"#ff0000\", 0.25], [60, \"#0000ff\", "
        "0.75], [60, \"#00ff00\", 0.5], [80, \"#ffffff\", 1]])";
    const auto at = [&](std::uint8_t value, const char* part) {
        return valueOf(slab<std::uint8_t>(VoxelType::kU8, value), std::string{"t()."} + part,
                       points);
    };
    EXPECT_EQ(at(19, "a"), 0.0F) << "below the first point";
    EXPECT_NEAR(at(20, "a"), 0.25F, 1e-6F);
    EXPECT_NEAR(at(30, "a"), 0.375F, 1e-6F);
    EXPECT_NEAR(at(30, "r"), 0.75F, 1e-6F);
    EXPECT_NEAR(at(60, "a"), 0.5F, 1e-6F) << "of points with one value the last counts";
    EXPECT_NEAR(at(70, "r"), 0.5F, 1e-6F);
    EXPECT_NEAR(at(255, "a"), 1.0F, 1e-6F) << "above the last point";
    EXPECT_EQ(valueOf(slab<std::uint8_t>(VoxelType::kU8, 51), "t().a",
                      "#uicontrol transferFunction t(controlPoints=[])"),
              0.0F);
    EXPECT_NEAR(
        valueOf(slab<std::uint8_t>(VoxelType::kU8, 153), "t().a", "#uicontrol transferFunction t"),
        2.0F / 3.0F, 1e-5F)
        << "0.6 of the range, between the default points at 0.4 and 0.7";
}

TEST_F(UserShader, ManyPointsAreFoundByHalving) {
    std::string points = "#uicontrol transferFunction t(controlPoints=[";
    for (int i = 0; i < 256; ++i) {
        points += (i == 0 ? "[" : ", [") + std::to_string(i * i) + ", \"#fff\", " +
                  std::to_string(i / 255.0) + "]";
    }
    points += "])";
    for (const int i : {0, 1, 2, 77, 127, 128, 129, 200, 254, 255}) {
        const auto value = static_cast<std::uint16_t>(i * i);
        EXPECT_NEAR(valueOf(slab<std::uint16_t>(VoxelType::kU16, value), "t().a", points),
                    static_cast<float>(i / 255.0), 1e-5F)
            << i;
    }
}

TEST_F(UserShader, ExtremesTakeTheSampleOfTheIntensity) {
    const data::Volume ramp =
        support::volumeOf({.size = {9, 9, 9}}, [](const glm::dvec3& p) { return p.z / 8.0; });
    const auto pixel = [&](const std::string& code, RayModel model) {
        scene::Scene scene = slabScene(ramp, code, model);
        scene.layers[0].stepWorld = 0.05;
        return draw(scene, {4, 4}).at(2, 1);
    };
    const std::string byValue = "void main() { emitRGB(vec3(toRaw(getInterpolatedDataValue()))); }";
    EXPECT_NEAR(pixel(byValue, RayModel::kMip).r, 1.0F, 0.01F);
    EXPECT_NEAR(pixel(byValue, RayModel::kMinip).r, 0.0F, 0.01F);
    EXPECT_EQ(pixel(byValue, RayModel::kMinip).a, 1.0F);
    const std::string byIntensity =
        "void main() { float v = toRaw(getInterpolatedDataValue());\n"
        "emitIntensity(1.0 - abs(v - 0.25)); emitRGBA(vec4(v, 0.0, 0.0, 0.5)); }";
    EXPECT_NEAR(pixel(byIntensity, RayModel::kMip).r, 0.125F, 0.005F) << "premultiplied";
    EXPECT_NEAR(pixel(byIntensity, RayModel::kMip).a, 0.5F, 1e-6F);
    const std::string byLookUp =
        "#uicontrol invlerp n(range=[1, 0])\n"
        "void main() { n(); emitRGB(vec3(toRaw(getInterpolatedDataValue()))); }";
    EXPECT_NEAR(pixel(byLookUp, RayModel::kMip).r, 0.0F, 0.01F)
        << "the last invlerp is the intensity";
    const std::string nothing = "void main() { emitIntensity(0.0); emitRGB(vec3(1.0)); }";
    EXPECT_EQ(pixel(nothing, RayModel::kMip), glm::vec4(0.0F)) << "nothing shows at 0";
    const std::string full = "void main() { emitIntensity(1.0); emitRGB(vec3(1.0)); }";
    EXPECT_EQ(pixel(full, RayModel::kMinip), glm::vec4(0.0F)) << "nothing shows at 1";
}

}  // namespace
}  // namespace volcast
