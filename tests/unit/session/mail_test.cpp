#include "server/session/mail.h"

#include <gtest/gtest.h>

namespace volcast::session {
namespace {

v1::ServerMessage sceneOf(std::uint64_t seq, float background) {
    v1::ServerMessage message;
    message.mutable_scene_changed()->set_input_seq(seq);
    message.mutable_scene_changed()->mutable_scene()->mutable_background()->set_r(background);
    return message;
}

v1::ServerMessage cameraOf(std::uint64_t seq, double eye) {
    v1::ServerMessage message;
    message.mutable_scene_changed()->set_input_seq(seq);
    message.mutable_scene_changed()->mutable_camera()->mutable_eye()->set_x(eye);
    return message;
}

TEST(Mail, OfCamerasTheNewestAloneIsKept) {
    Mail mail;
    mail.put(cameraOf(1, 1.0));
    mail.put(cameraOf(2, 2.0));
    const auto got = mail.take();
    ASSERT_TRUE(got.has_value());
    EXPECT_EQ(got->scene_changed().input_seq(), 2U);
    EXPECT_EQ(got->scene_changed().camera().eye().x(), 2.0);
    EXPECT_FALSE(mail.take().has_value());
}

TEST(Mail, ACameraBehindASceneThatWasNotReadBecomesItsOwn) {
    Mail mail;
    mail.put(sceneOf(1, 0.5F));
    mail.put(cameraOf(2, 2.0));
    mail.put(cameraOf(3, 3.0));
    const auto got = mail.take();
    ASSERT_TRUE(got.has_value());
    EXPECT_EQ(got->scene_changed().input_seq(), 3U);
    EXPECT_EQ(got->scene_changed().scene().background().r(), 0.5F);
    EXPECT_EQ(got->scene_changed().scene().camera().eye().x(), 3.0);
    EXPECT_FALSE(got->scene_changed().has_camera());
    EXPECT_FALSE(mail.take().has_value());
}

TEST(Mail, ErrorsAreKeptInOrderUpToALimit) {
    Mail mail;
    for (std::uint64_t seq = 1; seq <= Mail::kMost + 3; ++seq) {
        v1::ServerMessage message;
        message.mutable_error()->set_input_seq(seq);
        mail.put(message);
    }
    EXPECT_EQ(mail.take()->error().input_seq(), 4U);
    EXPECT_EQ(mail.take()->error().input_seq(), 5U);
}

}  // namespace
}  // namespace volcast::session
