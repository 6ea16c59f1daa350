#include <ostream>
#include <string>

#include "gmock/gmock.h"
#include <gtest/gtest.h>

#include "renderer/user_shader/check_text.h"

namespace volcast::user_shader {
namespace {

using ::testing::HasSubstr;

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
}

struct BadText {
    std::string code;
    int line;
    std::string message;
};

std::ostream& operator<<(std::ostream& out, const BadText& bad) {
    return out << bad.code.substr(0, 80);
}

class UserShaderText : public ::testing::TestWithParam<BadText> {};

TEST_P(UserShaderText, IsRefusedByLineBeforeAnyParser) {
    const Checked checked = checkText(GetParam().code);
    ASSERT_FALSE(checked.complaints.empty());
    EXPECT_EQ(checked.complaints[0].line, GetParam().line) << checked.complaints[0].message;
    EXPECT_THAT(checked.complaints[0].message, HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Words, UserShaderText,
    ::testing::Values(
        BadText{"void main() {\n#define A 1\n}", 2,
                "#define is not allowed; #uicontrol is the only directive"},
        BadText{"# include <x>\nvoid main() {}", 1, "#include is not allowed"},
        BadText{"#extension GL_ARB_x : enable\nvoid main() {}", 1, "#extension is not allowed"},
        BadText{"void main() {\n\n  gl_FragDepth = 0.0; }", 3, "gl_FragDepth is not allowed"},
        BadText{"void main() {\n while (true) {} }", 2,
                "while is not allowed: only for loops with constant bounds"},
        BadText{"void main() { do {} }", 1, "do is not allowed"},
        BadText{"void main() { discard; }", 1,
                "discard is not allowed: call emitTransparent() and return"},
        BadText{"uniform float x;\nvoid main() {}", 1, "declare a control instead"},
        BadText{"layout(binding = 0) buffer B { float b[]; };\nvoid main() {}", 1,
                "layout is not allowed"},
        BadText{"shared float x;\nvoid main() {}", 1, "shared is not allowed"},
        BadText{"void main() { sampler3D s; }", 1, "sampler3D is not allowed"},
        BadText{"void main() { uimage2D s; }", 1, "uimage2D is not allowed"},
        BadText{"in vec3 position;\nvoid main() {}", 1,
                "in is for the parameters of functions alone"},
        BadText{"void main() { double x; }", 1, "numbers have single precision"},
        BadText{"void main() { dvec3 x; }", 1, "numbers have single precision"},
        BadText{"void main() { float x = 1.0lf; }", 1, "numbers have single precision"},
        BadText{"void main() { float a__b = 1.0; }", 1, "two underscores"},
        BadText{"void main() {\n float x = texture(0.0); }", 2, "there is no function texture"},
        BadText{"void main() { imageStore(1); }", 1, "there is no function imageStore"},
        BadText{"float sin(float x) { return x; }\nvoid main() {}", 1,
                "sin is a function that is there already"},
        BadText{"void emitRGB(vec3 x) {}\nvoid main() {}", 1,
                "emitRGB is a function that is there"},
        BadText{"void main() { float toRaw = 1.0; }", 1, "toRaw is a function; call it"},
        BadText{"void main() { float x = 1 \\\n + 2; }", 1, "the character \\ is not allowed"},
        BadText{"void main() { float x = \"a\"; }", 1, "the character \" is not allowed"},
        BadText{"void main() { float \xC3\xA4; }", 1, "byte 195 is not allowed; code is ASCII"}));

INSTANTIATE_TEST_SUITE_P(
    Shape, UserShaderText,
    ::testing::Values(
        BadText{"float f() { return 1.0; }", 1, "there is no void main() { ... }"},
        BadText{"", 1, "there is no void main() { ... }"},
        BadText{"void main();", 1, "there is no void main() { ... }"},
        BadText{"void main() {}\nvoid main() {}", 2, "main() is defined twice"},
        BadText{"void main() {\n(}", 2, "\"}\" closes nothing"},
        BadText{"void main() {\n", 1, "\"{\" is not closed"},
        BadText{"void main() { " + repeated("(", 60), 1, "brackets are nested more than 48 deep"},
        BadText{"void main() {\n float x[257]; }", 2, "[257]: an array has at most 256 elements"},
        BadText{"void main() {\n float x[100000000000000000000]; }", 2,
                "an array has at most 256 elements"},
        BadText{"void main() { " + repeated("x;", 2001) + "}", 1, "2003 words, at most 2000"},
        BadText{std::string(16385, ' '), 1, "16385 bytes of code, at most 16384"},
        BadText{"#uicontrol float main slider(min=0, max=1)\nvoid main() {}", 1,
                "the control main has a name with a meaning of its own"},
        BadText{"#uicontrol float float slider(min=0, max=1)\nvoid main() {}", 1,
                "the control float has a name"},
        BadText{"#uicontrol invlerp mix\nvoid main() {}", 1, "the control mix has a name"},
        BadText{"#uicontrol float x slider(min=0, max=1)\nvoid main() { x(); }", 2,
                "x is a value of the control slider, not a function"}));

TEST(UserShaderNames, GetAPrefixWhereverTheyStand) {
    const auto body = [](const std::string& code) {
        const Checked checked = checkText(code);
        EXPECT_TRUE(checked.complaints.empty()) << checked.complaints.front().message;
        return checked.body;
    };
    EXPECT_EQ(body("float voxel(vec3 layer) { return layer.x; }\nvoid main() {}"),
              "float uservoxel ( vec3 userlayer ) { return userlayer . x ; } \n"
              "void usermain ( ) { } \n");
    EXPECT_EQ(
        body("void main() { float distance = distance(vec2(0), vec2(1)); }"),
        "void usermain ( ) { float userdistance = distance ( vec2 ( 0 ) , vec2 ( 1 ) ) ; } \n")
        << "a variable may have the name of a function";
    EXPECT_EQ(body("struct S { float a, width; };\nvoid main() { S s; s.a = s.width; }"),
              "struct userS { float a , userwidth ; } ; \n"
              "void usermain ( ) { userS users ; users . a = users . userwidth ; } \n");
    EXPECT_EQ(body("#uicontrol invlerp n\n\nvoid main() { emitGrayscale(n(getDataValue(1))); }"),
              "\n\nvoid usermain ( ) { emitGrayscale ( usern ( getDataValue ( 1 ) ) ) ; } \n")
        << "what the renderer offers keeps its name, and lines keep their numbers";
}

TEST(UserShaderNames, ChannelsByNumberAreToldFromComputedOnes) {
    const Checked numbered = checkText("void main() { getDataValue(); getDataValue(2); }");
    EXPECT_FALSE(numbered.readsAnyChannel);
    EXPECT_EQ(numbered.channels, std::set<int>{2});
    EXPECT_TRUE(checkText("void main() { int i = 1; getDataValue(i); }").readsAnyChannel);
    EXPECT_TRUE(checkText("void main() { getInterpolatedDataValue(1 + 1); }").readsAnyChannel);
}

}  // namespace
}  // namespace volcast::user_shader
