// Frames over a real socket from a real worker: what comes, in which order, and what it shows.
#include <cmath>

#include "tests/e2e/server/shared_server.h"

namespace volcast::test {
namespace {

class Frames : public SharedServer {};

TEST_F(Frames, TheWelcomeNamesVersionsModelsLimitsAndData) {
    TestClient client{port()};
    ASSERT_TRUE(client.ok());
    EXPECT_EQ(client.socket().subprotocol(), "volcast.v1");
    const auto welcome = client.waitFor([](const auto& one) { return one.has_welcome(); });
    ASSERT_TRUE(welcome.has_value());
    EXPECT_EQ(welcome->welcome().major(), 1U);
    EXPECT_EQ(welcome->welcome().limits().max_side(), 8192U);
    EXPECT_GT(welcome->welcome().mesh_models_size(), 1);
    const auto list = client.waitFor([](const auto& one) { return one.has_dataset_list(); });
    ASSERT_TRUE(list.has_value());
    ASSERT_EQ(list->dataset_list().datasets_size(), 3);
    EXPECT_EQ(list->dataset_list().datasets(0).id(), "again.node");
}

TEST_F(Frames, TheFirstFrameComesInBothForms) {
    for (const auto form : {TestClient::Form::kBinary, TestClient::Form::kJson}) {
        TestClient client{port(), form};
        ASSERT_TRUE(client.ok());
        client.openView(7, "good.node", 96, 64, 5);
        const auto opened = client.waitFor([](const auto& one) { return one.has_view_opened(); });
        ASSERT_TRUE(opened.has_value());
        EXPECT_EQ(opened->view_opened().scene().layers(0).dataset(), "good.node");
        EXPECT_GT(opened->view_opened().scene().layers(0).transfer_function().points_size(), 0);
        const auto frame = client.waitForFrame(7, 5);
        ASSERT_TRUE(frame.has_value()) << server().log();
        EXPECT_EQ(frame->prefix.sequence, 1U);
        EXPECT_EQ((frame->prefix.flags & protocol::kJsonHeaderFlag) != 0,
                  form == TestClient::Form::kJson);
        EXPECT_EQ(frame->header.codec(), v1::CODEC_JPEG);
        EXPECT_EQ(frame->header.input_seq(), 5U);
        EXPECT_TRUE(frame->header.redrawn());
        EXPECT_FALSE(frame->header.plan_id().empty());
        EXPECT_GE(frame->header.worker_generation(), 1U);
        EXPECT_GE(frame->header.data_version(), 1U);
        EXPECT_GT(frame->header.timings().encode_ms(), 0.0);
        const Decoded picture = decode(*frame);
        EXPECT_EQ(picture.width, 96);
        EXPECT_EQ(picture.height, 64);
    }
}

TEST_F(Frames, AViewLeftAloneGetsTheSamePictureLosslessly) {
    const auto client = clientWithView();
    ASSERT_TRUE(client);
    client->look(1, 2, 0.5);
    const auto jpeg = client->waitForFrame(1, 2);
    const auto png = client->waitForLossless(1, 2);
    ASSERT_TRUE(jpeg.has_value() && png.has_value());
    EXPECT_TRUE(png->header.final());
    EXPECT_FALSE(png->header.redrawn());
    EXPECT_EQ(png->header.input_seq(), 2U);
    EXPECT_EQ(png->prefix.sequence, jpeg->prefix.sequence + 1);
    const Decoded lossy = decode(*jpeg), exact = decode(*png);
    EXPECT_EQ(exact.channels, 4);
    EXPECT_LT(meanDifference(lossy, exact), 4.0);
    // The picture is of something: it is not one colour.
    const auto [low, high] = std::ranges::minmax_element(exact.pixels);
    EXPECT_GT(*high - *low, 30);
}

TEST_F(Frames, EveryInputIsAnsweredByItsOwnPictureOrALaterOne) {
    const auto client = clientWithView();
    ASSERT_TRUE(client);
    constexpr std::uint64_t kInputs = 40;
    for (std::uint64_t seq = 2; seq <= kInputs; ++seq) {
        client->look(1, seq, 0.1 * static_cast<double>(seq));
    }
    std::uint64_t newest = 0;
    std::uint32_t sequence = 0;
    while (newest < kInputs) {
        const auto frame = client->waitForFrame(1, 1);
        ASSERT_TRUE(frame.has_value());
        EXPECT_GE(frame->header.input_seq(), newest);
        EXPECT_GT(frame->prefix.sequence, sequence);
        newest = frame->header.input_seq();
        sequence = frame->prefix.sequence;
    }
    EXPECT_EQ(newest, kInputs);
    EXPECT_LT(sequence, kInputs);  // Latest wins: not every input was drawn.
}

TEST_F(Frames, TheSameStateGivesTheSamePictureAgain) {
    const auto client = clientWithView();
    ASSERT_TRUE(client);
    client->look(1, 2, 0.3);
    const auto before = client->waitForLossless(1, 2);
    client->look(1, 3, 1.9);
    const auto other = client->waitForLossless(1, 3);
    client->look(1, 4, 0.3);
    const auto after = client->waitForLossless(1, 4);
    ASSERT_TRUE(before && other && after);
    EXPECT_EQ(decode(*before).pixels, decode(*after).pixels);
    EXPECT_GT(meanDifference(decode(*before), decode(*other)), 0.5);
}

TEST_F(Frames, AViewportChangesTheSize) {
    const auto client = clientWithView();
    ASSERT_TRUE(client);
    v1::ClientMessage message;
    message.mutable_update()->set_view(1);
    message.mutable_update()->set_input_seq(2);
    message.mutable_update()->mutable_viewport()->set_width(33);
    message.mutable_update()->mutable_viewport()->set_height(21);
    client->send(message);
    const auto frame = client->waitForFrame(1, 2);
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(frame->header.width(), 33U);
    EXPECT_EQ(decode(*frame).height, 21);
}

TEST_F(Frames, AnOlderInputIsIgnored) {
    const auto client = clientWithView();
    ASSERT_TRUE(client);
    client->look(1, 10, 0.4);
    client->look(1, 3, 2.0);
    v1::ClientMessage ping;
    ping.mutable_ping()->set_token(77);
    client->send(ping);
    const auto pong = client->waitFor([](const auto& one) {
        EXPECT_FALSE(one.has_error());
        return one.has_pong();
    });
    ASSERT_TRUE(pong.has_value());
    EXPECT_EQ(pong->pong().token(), 77U);
    const auto png = client->waitForLossless(1, 2);  // That of the first input may have come.
    ASSERT_TRUE(png.has_value());
    EXPECT_EQ(png->header.input_seq(), 10U);
}

TEST_F(Frames, TwoClientsWithSeveralViewsAtOnceGetEachTheirOwn) {
    TestClient one{port()}, two{port(), TestClient::Form::kJson};
    ASSERT_TRUE(one.ok() && two.ok());
    for (std::uint32_t view = 1; view <= 3; ++view) {
        one.openView(view, "good.node", 40 + view, 32, 1);
        two.openView(view, "again.node", 60 + view, 32, 1);
    }
    for (std::uint32_t view = 1; view <= 3; ++view) {
        one.look(view, 2, view);
        two.look(view, 2, -1.0 * view);
    }
    for (std::uint32_t view = 1; view <= 3; ++view) {
        const auto mine = one.waitForFrame([&](const TestFrame& frame) {
            return frame.prefix.view == view && frame.header.input_seq() == 2;
        });
        ASSERT_TRUE(mine.has_value()) << view;
        EXPECT_EQ(mine->header.width(), 40 + view);
        one.frames.clear();
    }
    const auto other = two.waitForFrame(3, 2);
    ASSERT_TRUE(other.has_value());
    EXPECT_EQ(other->header.width(), 63U);
}

// waitForFrame drops what came before, so views are asked for in turn by a later input.
TEST_F(Frames, AClosedViewsNumberCanBeUsedAgain) {
    const auto client = clientWithView();
    ASSERT_TRUE(client);
    v1::ClientMessage close;
    close.mutable_close_view()->set_view(1);
    client->send(close);
    client->openView(1, "again.node", 50, 40, 100);
    const auto frame = client->waitForFrame(1, 100);
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(frame->prefix.sequence, 1U);
    EXPECT_EQ(frame->header.width(), 50U);
}

}  // namespace
}  // namespace volcast::test
