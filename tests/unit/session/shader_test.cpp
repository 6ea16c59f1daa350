// Code of users in a session: its description, and what a view does after code that failed.
#include <gtest/gtest.h>

#include "server/session/catalogue.h"
#include "server/session/shader_description.h"
#include "server/session/view_scene.h"

namespace volcast::session {
namespace {

v1::ShaderDescription described(const std::string& code, const scene::Summaries& summaries = {}) {
    v1::DescribeShader message;
    message.set_request(7);
    message.set_code(code);
    message.set_dataset("d");
    return shaderDescription(message, summaries);
}

TEST(ShaderDescription, ListsControlsWithTheirDefaults) {
    const auto description = described(
        "#uicontrol float s slider(min=-1, max=1)\n#uicontrol vec3 c color(default=\"red\")\n"
        "#uicontrol bool b checkbox(default=true)\n"
        "#uicontrol string_t o select(options={\"A\": \"x\", \"B\": \"y\"}, default=\"y\")\n"
        "#uicontrol invlerp n(range=[9, 1], channel=2)\n#uicontrol transferFunction t\n"
        "void main() {}\n");
    EXPECT_EQ(description.request(), 7U);
    EXPECT_TRUE(description.complaints().empty());
    ASSERT_EQ(description.controls_size(), 6);
    EXPECT_EQ(description.controls(0).name(), "s");
    EXPECT_EQ(description.controls(0).slider().type(), "float");
    EXPECT_EQ(description.controls(0).slider().min(), -1.0);
    EXPECT_EQ(description.controls(0).slider().step(), 0.02);
    EXPECT_EQ(description.controls(1).color().r(), 1.0F);
    EXPECT_TRUE(description.controls(2).checkbox());
    EXPECT_EQ(description.controls(3).select().options(1).label(), "B");
    EXPECT_EQ(description.controls(3).select().options(1).text(), "y");
    EXPECT_EQ(description.controls(3).select().initial(), 1U);
    EXPECT_EQ(description.controls(4).line(), 5U);
    EXPECT_EQ(description.controls(4).invlerp().range().min(), 9.0) << "inverted";
    EXPECT_EQ(description.controls(4).invlerp().window().min(), 1.0) << "in order";
    EXPECT_EQ(description.controls(4).invlerp().channel(), 2);
    EXPECT_EQ(description.controls(5).transfer_function().points_size(), 2);
    EXPECT_EQ(description.controls(5).transfer_function().window().max(), 1.0);
}

TEST(ShaderDescription, RangesAreThoseOfTheDatasetsType) {
    data::DatasetSummary summary;
    summary.voxelType = data::VoxelType::kI16;
    const auto description = described("#uicontrol invlerp n\nvoid main() {}", {{"d", summary}});
    ASSERT_EQ(description.controls_size(), 1);
    EXPECT_EQ(description.controls(0).invlerp().range().min(), -32768.0);
    EXPECT_EQ(description.controls(0).invlerp().range().max(), 32767.0);
}

TEST(ShaderDescription, ComplaintsHaveTheUsersPlace) {
    const auto description = described("#uicontrol float s slider(min=2, max=1)\nvoid main() {}");
    EXPECT_TRUE(description.controls().empty());
    ASSERT_EQ(description.complaints_size(), 1);
    EXPECT_EQ(description.complaints(0).line(), 1U);
    EXPECT_EQ(description.complaints(0).column(), 31U);
    EXPECT_EQ(description.complaints(0).message(), "min must not be above max: 2 to 1");
}

}  // namespace
}  // namespace volcast::session
