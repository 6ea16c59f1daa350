// Code that users write, as the program draws it.
#include <algorithm>
#include <cstring>

#include <gmock/gmock.h>

#include "tests/e2e/commands/program.h"

namespace volcast::test {
namespace {

using ::testing::HasSubstr;

constexpr const char* kCode =
    "#uicontrol invlerp contrast(range=[0.2, 1])\n"
    "#uicontrol vec3 tint color(default=\"orange\")\n"
    "#uicontrol float opacity slider(min=0, max=1, default=0.1)\n"
    "void main() { float x = contrast(); emitRGBA(vec4(x * tint, x * opacity)); }\n";

class ShaderCommand : public ::testing::Test {
protected:
    Outcome render(const std::string& code, std::vector<std::string> more) {
        std::vector<std::string> arguments{"render",
                                           "demo:volume",
                                           "--size",
                                           "40",
                                           "40",
                                           "--shader",
                                           folder_.write("code.glsl", code),
                                           "--raw",
                                           folder_.file("a.f32")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runVolcast(arguments);
    }
    /// Largest red, green and blue of the picture.
    std::vector<float> largest() {
        const std::string bytes = contentOf(folder_.file("a.f32"));
        std::vector<float> values(bytes.size() / sizeof(float)), most(3, 0.0F);
        std::memcpy(values.data(), bytes.data(), bytes.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (i % 4 < 3) most[i % 4] = std::max(most[i % 4], values[i]);
        }
        return most;
    }
    Folder folder_;
};

TEST_F(ShaderCommand, DrawsByCodeAndItsControls) {
    const Outcome run = render(kCode, {"--model", "volume", "--explain"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("user shader"));
    const std::vector<float> orange = largest();
    EXPECT_GT(orange[0], 0.1F);
    EXPECT_GT(orange[0], 1.5F * orange[1]);
    EXPECT_EQ(orange[2], 0.0F);
    const Outcome blue =
        render(kCode, {"--control", "tint=#0000ff", "--control", "contrast=[0.4, 0.9]"});
    ASSERT_EQ(blue.exitCode, 0) << blue.err;
    EXPECT_EQ(largest()[0], 0.0F);
    EXPECT_GT(largest()[2], 0.1F);
}

TEST_F(ShaderCommand, RefusesWhatIsWrongByLineAndControl) {
    const auto refused = [&](const std::string& code, const std::vector<std::string>& more) {
        const Outcome run = render(code, more);
        EXPECT_EQ(run.exitCode, 1) << run.err;
        return run.err;
    };
    EXPECT_THAT(refused("void main() {\n  while (true) {}\n}", {}),
                HasSubstr("line 2, column 3: while"));
    EXPECT_THAT(refused("void main() {\n  emitRGB(x);\n}", {}),
                HasSubstr("line 2: 'x' : undeclared identifier"));
    EXPECT_THAT(refused(kCode, {"--control", "gain=1"}), HasSubstr("--control gain: "));
    EXPECT_THAT(refused(kCode, {"--control", "opacity=2"}),
                HasSubstr("the control \"opacity\": 2 is not in 0 to 1"));
    EXPECT_THAT(refused(kCode, {"--control", "opacity=much"}),
                HasSubstr("--control opacity: the value is not a number"));
    EXPECT_THAT(refused(kCode, {"--control", "tint=reddish"}),
                HasSubstr("--control tint: the value is not a CSS colour"));
    EXPECT_THAT(refused(kCode, {"--control", "contrast=[1, 1]"}),
                HasSubstr("--control contrast: Invalid range value: both ends are 1"));
    EXPECT_THAT(refused(kCode, {"--control", "opacity"}), HasSubstr("NAME=VALUE"));
    EXPECT_THAT(refused(kCode, {"--model", "xray"}), HasSubstr("not of xray"));
}

}  // namespace
}  // namespace volcast::test
