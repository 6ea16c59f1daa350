#include <ostream>
#include <string>

#include "gmock/gmock.h"
#include <gtest/gtest.h>

#include "renderer/user_shader/parse.h"

namespace volcast::user_shader {
namespace {

using ::testing::HasSubstr;

struct BadLine {
    std::string line;
    int column;
    std::string message;  ///< Or what it begins with.
};

std::ostream& operator<<(std::ostream& out, const BadLine& bad) {
    return out << bad.line;
}

class UserShaderComplaints : public ::testing::TestWithParam<BadLine> {};

TEST_P(UserShaderComplaints, NameLineColumnAndWhatIsWrong) {
    const Parsed parsed = parse("\n\n" + GetParam().line + "\nvoid main() {}\n");
    ASSERT_EQ(parsed.complaints.size(), 1U);
    EXPECT_EQ(parsed.complaints[0].line, 3);
    EXPECT_EQ(parsed.complaints[0].column, GetParam().column) << parsed.complaints[0].message;
    EXPECT_THAT(parsed.complaints[0].message, HasSubstr(GetParam().message));
    EXPECT_TRUE(parsed.controls.empty()) << "a control with an error is none";
}

const std::string kSyntax =
    "Invalid #uicontrol syntax, expected: #uicontrol <type> <name> "
    "<control>(<param>=<value>, ...)";
const std::string kParameters =
    "Invalid #uicontrol parameter syntax, expected: <param>=<value>, ...";

INSTANTIATE_TEST_SUITE_P(
    Syntax, UserShaderComplaints,
    ::testing::Values(
        BadLine{"#uicontrol", 11, kSyntax + "; there is no type"},
        BadLine{"#uicontrol float", 17, kSyntax + "; there is no name"},
        BadLine{"#uicontrol 3d x slider(min=0, max=1)", 12, kSyntax},
        BadLine{"#uicontrol float X slider(min=0, max=1)", 18,
                kSyntax + "; a name begins with a lower-case letter"},
        BadLine{"#uicontrol float _x slider(min=0, max=1)", 18, kSyntax},
        BadLine{"#uicontrol float x slider(min=0, max=1", 26,
                kSyntax + "; the \"(\" is not closed in its line"},
        BadLine{"#uicontrol float x slider(min=0, max=1) y", 41,
                kSyntax + "; found \"y\" after the \")\""},
        BadLine{"#uicontrol float x slider min=0", 27, kSyntax},
        BadLine{"#uicontrol float x slider(0, 1)", 27, kParameters},
        BadLine{"#uicontrol float x slider(min 0)", 27, kParameters},
        BadLine{"#uicontrol float x slider(min=0 max=1)", 33, kParameters},
        BadLine{"#uicontrol float x slider(min=, max=1)", 31,
                "Invalid #uicontrol parameter value for min: "},
        BadLine{"#uicontrol float x slider(min=.5, max=1)", 31,
                "Invalid #uicontrol parameter value for min: "},
        BadLine{"#uicontrol float x slider(min=+1, max=2)", 31,
                "Invalid #uicontrol parameter value for min: "},
        BadLine{"#uicontrol vec3 x color(default='red')", 33,
                "Invalid #uicontrol parameter value for default: "},
        BadLine{"#uicontrol vec3 x color(default=null)", 33,
                "Invalid #uicontrol parameter value for default: null has no meaning"},
        BadLine{"#uicontrol invlerp x(range=[0, null])", 28,
                "Invalid #uicontrol parameter value for range: null has no meaning"},
        BadLine{"#uicontrol float x slider(min=0, min=1, max=2)", 34,
                "Duplicate #uicontrol parameter: min"},
        BadLine{"#uicontrol float x dial(min=0)", 20, "Invalid control type dial"},
        BadLine{"#uicontrol float x", 12, "Invalid control type float"},
        BadLine{"#uicontrol bool b checkbox(deflt=true)", 28, "Invalid parameter: deflt"}));

INSTANTIATE_TEST_SUITE_P(
    Slider, UserShaderComplaints,
    ::testing::Values(
        BadLine{"#uicontrol vec3 x slider(min=0, max=1)", 12, "type must be float, int or uint"},
        BadLine{"#uicontrol float x slider(max=1)", 20, "min must be specified"},
        BadLine{"#uicontrol float x slider(min=1)", 20, "max must be specified"},
        BadLine{"#uicontrol float x slider(min=2, max=1)", 31, "min must not be above max: 2 to 1"},
        BadLine{"#uicontrol float x slider(min=\"0\", max=1)", 31,
                "Expected min argument to be a number"},
        BadLine{"#uicontrol float x slider(min=0, max=1e39)", 38,
                "Expected max argument to be a number of single precision, not 1e+39"},
        BadLine{"#uicontrol int x slider(min=0.5, max=2)", 29,
                "Expected min argument to be an integer, not 0.5"},
        BadLine{"#uicontrol uint x slider(min=-1, max=2)", 30,
                "Expected min argument to be an unsigned integer of 32 bits, not -1"},
        BadLine{"#uicontrol int x slider(min=0, max=3000000000)", 36,
                "Expected max argument to be an integer of 32 bits"},
        BadLine{"#uicontrol float x slider(min=0, max=1, default=2)", 49,
                "default must be within valid range: 2 is not in 0 to 1"},
        BadLine{"#uicontrol float x slider(min=0, max=1, step=0)", 46,
                "step must be above 0, not 0"}));

INSTANTIATE_TEST_SUITE_P(
    Others, UserShaderComplaints,
    ::testing::Values(
        BadLine{"#uicontrol float c color", 12, "type must be vec3"},
        BadLine{"#uicontrol vec3 c color(default=7)", 33,
                "Expected default argument to be a string"},
        BadLine{"#uicontrol vec3 c color(default=\"reddish\")", 33,
                "Invalid default value: \"reddish\" is not a CSS colour"},
        BadLine{"#uicontrol vec3 c color(default=\"#12345\")", 33, "is not a CSS colour"},
        BadLine{"#uicontrol int b checkbox", 12, "type must be bool"},
        BadLine{"#uicontrol bool b checkbox(default=1)", 36,
                "Expected default argument to be a boolean"},
        BadLine{"#uicontrol vec3 s select(options=[1])", 12,
                "type must be string_t, int, uint or float"},
        BadLine{"#uicontrol int s select", 18, "options must be specified"},
        BadLine{"#uicontrol int s select(options=[])", 33, "options must not be empty"},
        BadLine{"#uicontrol int s select(options=3)", 33,
                "Expected options argument to be a list, or labels with values"},
        BadLine{"#uicontrol int s select(options=[1.5])", 33,
                "Invalid options value: 1.5E0 is not a int"},
        BadLine{"#uicontrol string_t s select(options=[1])", 38,
                "Invalid options value: 1 is not a string"},
        BadLine{"#uicontrol int s select(options=[1, 2, 1])", 33,
                "Invalid options value: 1 is listed twice"},
        BadLine{"#uicontrol int s select(options=[1, 2], default=3)", 49,
                "default must be one of the options, not 3"},
        BadLine{"#uicontrol float i invlerp(range=[0, 1])", 12, "type must be invlerp"},
        BadLine{"#uicontrol invlerp i(range=[1, 1])", 28, "Invalid range value: both ends are 1"},
        BadLine{"#uicontrol invlerp i(range=[1])", 28,
                "Invalid range value: expected two numbers, [from, to], not [1]"},
        BadLine{"#uicontrol invlerp i(window=[2, 1])", 29,
                "Invalid window value: 2 is above 1; the lower end goes first"},
        BadLine{"#uicontrol invlerp i(channel=-1)", 30,
                "Invalid channel value: expected a channel's number, from 0, not -1"},
        BadLine{"#uicontrol invlerp i(channel=[0, 1])", 30, "Invalid channel value"},
        BadLine{"#uicontrol invlerp i(clamp=0)", 28, "Expected clamp argument to be a boolean"},
        BadLine{"#uicontrol vec4 t transferFunction", 12, "type must be transferFunction"},
        BadLine{"#uicontrol transferFunction t(controlPoints=3)", 45,
                "Expected controlPoints argument to be a list of points"},
        BadLine{"#uicontrol transferFunction t(controlPoints=[[0, \"red\", 1.5]])", 45,
                "is not [value, \"#rrggbb\", opacity from 0 to 1]"},
        BadLine{"#uicontrol transferFunction t(points=[[0, 1, 2, 3, 256]])", 38,
                "is not [value, r, g, b, a], the last four from 0 to 255"},
        BadLine{"#uicontrol transferFunction t(points=[], controlPoints=[])", 42,
                "Invalid parameter: controlPoints"}));

TEST(UserShaderComplaints, SecondControlOfANameIsRefused) {
    const Parsed parsed =
        parse("#uicontrol bool a checkbox\n#uicontrol float a slider(min=0, max=1)\n");
    ASSERT_EQ(parsed.complaints.size(), 1U);
    EXPECT_EQ(parsed.complaints[0],
              (Complaint{.line = 2,
                         .column = 18,
                         .message = "Duplicate definition for control a; the first is in line 1"}));
    EXPECT_EQ(parsed.controls.size(), 1U);
}

TEST(UserShaderComplaints, AllOfThemAreListed) {
    const Parsed parsed = parse(
        "#uicontrol float a slider(min=1)\n#uicontrol bool b checkbox\n#uicontrol int c dial\n");
    ASSERT_EQ(parsed.complaints.size(), 2U);
    EXPECT_EQ(parsed.complaints[0].line, 1);
    EXPECT_EQ(parsed.complaints[1].line, 3);
    EXPECT_EQ(parsed.controls.size(), 1U);
}

TEST(UserShaderComplaints, ControlsPointsAndOptionsAreLimited) {
    std::string many;
    for (std::size_t i = 0; i <= kMaxControls; ++i) {
        many += "#uicontrol bool b" + std::to_string(i) + " checkbox\n";
    }
    ASSERT_EQ(parse(many).complaints.size(), 1U);
    EXPECT_EQ(parse(many).complaints[0].message, "more than 64 controls");
    std::string points = "#uicontrol transferFunction t(controlPoints=[[0, \"red\", 1]";
    for (std::size_t i = 0; i < TransferFunction::kMaxPoints; ++i) points += ", [0, \"red\", 1]";
    ASSERT_EQ(parse(points + "])").complaints.size(), 1U);
    EXPECT_EQ(parse(points + "])").complaints[0].message, "257 points, at most 256");
    std::string options = "#uicontrol int s select(options=[0";
    for (int i = 1; i <= 64; ++i) options += ", " + std::to_string(i);
    ASSERT_EQ(parse(options + "])").complaints.size(), 1U);
    EXPECT_EQ(parse(options + "])").complaints[0].message, "65 options, at most 64");
}

TEST(UserShaderComplaints, DeeplyNestedValuesAreRefused) {
    const std::string open(10'000, '[');
    const Parsed parsed = parse("#uicontrol int s select(options=" + open);
    ASSERT_EQ(parsed.complaints.size(), 1U);
    EXPECT_THAT(parsed.complaints[0].message,
                HasSubstr("Invalid #uicontrol parameter value for options: "));
}

}  // namespace
}  // namespace volcast::user_shader
