// Code of users in views of a real server.
#include <gmock/gmock.h>

#include "tests/e2e/server/test_client.h"

namespace volcast::test {
namespace {

using ::testing::HasSubstr;

// Drawn at once with no rounds; with all of them longer than the deadline, by far.
constexpr const char* kCode =
    "#uicontrol int rounds slider(min=0, max=200, default=0)\n"
    "void main() { float x = 0.5; for (int i = 0; i < 200; ++i) { if (i >= rounds) break;\n"
    "x = sin(x + getDataValue()); x = cos(x * 1.1); x = exp(-x * x); x = sin(x + 2.0);\n"
    "x = cos(x * 1.3); x = exp(-x); x = sin(x + 1.0); x = cos(x * 1.7); }\n"
    "emitRGBA(vec4(x, x, x, 0.01)); }";

class ShaderViews : public ::testing::Test {
protected:
    void SetUp() override {
        ASSERT_TRUE(server_.ready()) << server_.log();
        client_ = std::make_unique<TestClient>(server_.port());
        ASSERT_TRUE(client_->ok());
        client_->openView(1, "demo:volume", 512, 512);
        const auto opened = client_->waitFor(
            [](const v1::ServerMessage& message) { return message.has_view_opened(); });
        ASSERT_TRUE(opened) << server_.log();
        scene_ = opened->view_opened().scene();
        ASSERT_TRUE(client_->waitForFrame(1, 1));
    }

    void show(std::uint64_t seq, const std::string& code, double rounds) {
        auto& layer = *scene_.mutable_layers(0);
        layer.clear_shader();
        if (!code.empty()) {
            layer.mutable_shader()->set_code(code);
            auto& control = *layer.mutable_shader()->add_controls();
            control.set_name("rounds");
            control.set_number(rounds);
        }
        layer.set_step_world(1e-3);
        v1::ClientMessage message;
        message.mutable_update()->set_view(1);
        message.mutable_update()->set_input_seq(seq);
        *message.mutable_update()->mutable_scene() = scene_;
        client_->send(message);
    }

    ServerProcess server_{{"--frame-deadline-ms", "8000"}};
    std::unique_ptr<TestClient> client_;
    v1::Scene scene_;
};

TEST_F(ShaderViews, AHangByAControlLeavesTheViewWithItsLastGoodPicture) {
    show(2, kCode, 0);
    const auto good = client_->waitForLossless(1, 2);
    ASSERT_TRUE(good) << server_.log();
    show(3, kCode, 200);
    const auto error = client_->waitForError();
    ASSERT_TRUE(error) << server_.log();
    EXPECT_EQ(error->field(), "scene.layers[0].shader.code");
    EXPECT_THAT(error->message(), HasSubstr("#uicontrol int rounds slider"));
    EXPECT_THAT(error->message(), HasSubstr("is not run again with these controls"));
    ASSERT_TRUE(client_->waitForState(1, v1::VIEW_STATE_ACTIVE)) << server_.log();
    const auto back = client_->waitForLossless(1, 3);
    ASSERT_TRUE(back) << server_.log();
    EXPECT_EQ(decode(*back).pixels, decode(*good).pixels);
    client_->look(1, 4, 0.4);
    const auto moved = client_->waitForFrame(1, 4);
    ASSERT_TRUE(moved) << "it lives on: " << server_.log();
    EXPECT_GT(meanDifference(decode(*moved), decode(*good)), 0.5);
    for (const v1::ServerMessage& message : client_->messages) {
        EXPECT_NE(message.view_status().state(), v1::VIEW_STATE_FAILED);
    }
}

}  // namespace
}  // namespace volcast::test
