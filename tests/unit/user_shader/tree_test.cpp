#include <chrono>
#include <ostream>
#include <string>

#include "gmock/gmock.h"
#include <gtest/gtest.h>

#include "renderer/shading/assemble.h"
#include "renderer/user_shader/check_text.h"
#include "renderer/user_shader/generate.h"
#include "renderer/user_shader/tree_check.h"

namespace volcast::user_shader {
namespace {

using ::testing::HasSubstr;

/// All checks, as a program is built.
TreeReport check(const std::string& code, ValueType type = ValueType::kF32) {
    const Checked checked = checkText(code);
    if (!checked.complaints.empty()) return {.complaints = checked.complaints};
    const std::vector<shading::TextChunk> texts{
        {.path = kValuesChunk, .text = valuesText(type, true)},
        {.path = kControlsChunk, .text = controlsText(checked.controls, {}, type)},
        {.path = kBodyChunk, .text = checked.body}};
    const shading::ChunkSource files = shading::embeddedChunks();
    const auto source = shading::expand("user/code.glsl", {}, shading::withTexts(texts, files));
    EXPECT_TRUE(source.has_value()) << source.error().message;
    return checkTree({.source = source->source,
                      .userLine =
                          [&source](int number) {
                              const std::size_t index = static_cast<std::size_t>(number) - 1;
                              return index < source->lines.size() &&
                                             source->lines[index].file == kBodyChunk
                                         ? source->lines[index].line
                                         : 0;
                          },
                      .controls = checked.controls});
}

TEST(UserShaderTree, TakesWhatUsersWrite) {
    const std::string code = R"(
#uicontrol invlerp contrast(range=[0, 9])
#uicontrol transferFunction tf(controlPoints=[[0, "red", 0.1]], channel=1)
#uicontrol vec3 tint color(default="orange")
#uicontrol float gain slider(min=-3, max=3)
#uicontrol int count slider(min=1, max=3)
#uicontrol uint mask slider(min=1, max=3)
#uicontrol bool invert checkbox(default=true)
#uicontrol string_t mode select(options=["a", "b"])
struct Pair { float x, weight; };
const int kTimes = 4;
Pair pair(float v) { return Pair(v, 0.5 * v); }
void main() {
  float x = invert ? 1.0 - contrast() : contrast(getDataValue());
  for (int i = 0; i < kTimes; ++i) { x += pair(x).weight; }
  if (mode == 1 && (mask & 1u) == 1u && count > 1 && VOLUME_RENDERING) { emitTransparent(); return; }
  x += toNormalized(getInterpolatedDataValue(1)) + float(toRaw(getDataValue()));
  vec4 c = tf() + tf(getDataValue(1));
  emitRGBA(vec4(tint, x * exp(gain)) + c);
  emitRGB(tint); emitGrayscale(x); emitIntensity(x);
}
)";
    for (const ValueType type :
         {ValueType::kU8, ValueType::kU16, ValueType::kI16, ValueType::kF32}) {
        const TreeReport report = check(code, type);
        EXPECT_TRUE(report.complaints.empty()) << report.complaints.front().message;
        EXPECT_EQ(report.iterations, 4);
        EXPECT_GT(report.cost, 100.0);
        EXPECT_LT(report.cost, 3000.0);
    }
}

struct BadCode {
    std::string code;
    int line;
    std::string message;
};

std::ostream& operator<<(std::ostream& out, const BadCode& bad) {
    return out << bad.code.substr(0, 120);
}

class UserShaderTree : public ::testing::TestWithParam<BadCode> {};

TEST_P(UserShaderTree, IsRefusedByLineWithinASecond) {
    check("void main() {}");  // glslang makes its tables once a process.
    const auto begin = std::chrono::steady_clock::now();
    const TreeReport report = check(GetParam().code);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds{1});
    ASSERT_FALSE(report.complaints.empty());
    EXPECT_EQ(report.complaints[0].line, GetParam().line) << report.complaints[0].message;
    EXPECT_THAT(report.complaints[0].message, HasSubstr(GetParam().message));
}

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
}

std::string inMain(const std::string& body) {
    return "void main() {\n" + body + "\n}";
}

INSTANTIATE_TEST_SUITE_P(
    Errors, UserShaderTree,
    ::testing::Values(
        BadCode{inMain("float x = y;"), 2, "'y' : undeclared identifier"},
        BadCode{inMain("\nfloat x = vec3(1.0);"), 3, "cannot convert"},
        BadCode{inMain("emitRGB(1.0);"), 2, "'emitRGB' : no matching overloaded function"},
        BadCode{inMain("float x = 1.0"), 3, "syntax error"},
        BadCode{"#uicontrol float x slider(min=0, max=1)\nvoid main() {\n x = 1.0;\n}", 3,
                "x is a control; code cannot change it"},
        BadCode{"#uicontrol bool b checkbox\nvoid main() {\n b = true;\n}", 3,
                "can't modify a const"}));

INSTANTIATE_TEST_SUITE_P(
    Loops, UserShaderTree,
    ::testing::Values(
        BadCode{inMain("for (;;) {}"), 2, "the loop's counter does not start at a constant"},
        BadCode{inMain("for (int i = 0; true; ++i) {}"), 2, "is not compared with a constant"},
        BadCode{inMain("for (int i = 0; i < int(toRaw(getDataValue())); ++i) {}"), 2,
                "is not compared with a constant"},
        BadCode{inMain("for (int i = 0; i < 8;) {}"), 2, "does not change by a constant"},
        BadCode{inMain("for (int i = 0; i < 8; i *= 2) {}"), 2, "does not change by a constant"},
        BadCode{inMain("for (int i = 0; i < 8; ++i) { i = 0; }"), 2,
                "the loop's counter is changed in its body"},
        BadCode{"void f(inout int i) { i = 0; }\n" + inMain("for (int i = 0; i < 8; ++i) f(i);"), 3,
                "the loop's counter is changed in its body"},
        BadCode{inMain("for (int i = 0; i < 8; i += 0) {}"), 2,
                "the loop runs more than 256 times"},
        BadCode{inMain("for (int i = 0; i >= 0; ++i) {}"), 2, "the loop runs more than 256 times"},
        BadCode{inMain("for (float x = 0.0; x < 1.0; x += 1e-9) {}"), 2,
                "the loop runs more than 256 times"},
        BadCode{inMain("for (int i = 0; i < 200; ++i) {\n for (int j = 0; j < 200; ++j) {}}"), 1,
                "all loops of a sample together run 40200 times, at most 256"}));

INSTANTIATE_TEST_SUITE_P(
    Bombs, UserShaderTree,
    ::testing::Values(
        BadCode{"float f(float x);\nfloat g(float x) {\n return f(x); }\n"
                "float f(float x) { return g(x); }\nvoid main() { f(1.0); }",
                3, "f() calls itself"},
        BadCode{"void main() {\n main(); }", 2, "main() calls itself"},
        // Each function calls the one before twice: 2^30 calls.
        BadCode{[] {
                    std::string code = "float f0(float x) { return sin(x); }\n";
                    for (int i = 1; i <= 30; ++i) {
                        const std::string before = "f" + std::to_string(i - 1);
                        code += "float f" + std::to_string(i) + "(float x) { return " + before +
                                "(x) + " + before + "(x); }\n";
                    }
                    return code + "void main() { f30(1.0); }";
                }(),
                1, "operations, at most 20000"},
        BadCode{inMain("float x = 1.0; x = x" + repeated(" + x", 900) + ";"), 2,
                "nested more than 200 deep"},
        BadCode{inMain("bool x = true; x = " + repeated("!", 15000) + "x;"), 2, ""},
        BadCode{inMain(repeated("if (true) ", 900) + ";"), 2, "nested more than 200 deep"},
        BadCode{inMain("float x[100][100]; x[0][0] = 1.0;"), 2,
                "x holds 10000 numbers, at most 1024"},
        BadCode{"const int n = 1000000;\n" + inMain("float x[n * 1000]; x[0] = 1.0;"), 3,
                "x holds 1e+09 numbers, at most 1024"},
        BadCode{"struct A { float v[256]; };\nstruct B { A v[256]; };\nstruct C { B v[256]; };\n" +
                    inMain("C c; c.v[0].v[0].v[0] = 1.0;"),
                5, "c holds 16777216 numbers, at most 1024"}));

}  // namespace
}  // namespace volcast::user_shader
