#include "server/session/view_frames.h"

#include <gtest/gtest.h>

namespace volcast::session {
namespace {

using std::chrono::milliseconds;

/// One view with a clock of its own; the renderer and the socket are played by the test.
class ViewFramesTest : public testing::Test {
protected:
    void input(std::uint64_t seq) {
        frames.input(now);
        frames.want(
            {.scene = {}, .size = {8, 4}, .inputSeq = seq, .dataVersion = 1, .inputAt = now});
    }
    /// Takes what is to be drawn; returns its input_seq, 0 where there is nothing.
    std::uint64_t draw() {
        const auto state = frames.takeDraw(now, tag);
        return state ? state->inputSeq : 0;
    }
    bool finish(std::uint64_t ofTag, bool ready = true) {
        auto picture = std::make_shared<workers::Picture>();
        picture->size = {8, 4};
        picture->rgba8.assign(std::size_t{8} * 4 * 4, static_cast<std::byte>(ofTag));
        workers::RenderedFrame frame;
        frame.tag = ofTag;
        frame.picture = picture;
        frame.drawn = true;
        frame.ready = ready;
        frame.generation = 1;
        return frames.rendered(frame);
    }
    std::optional<ReadyFrame> encodeAndSend() {
        const auto task = frames.takeEncode(now);
        if (!task) return std::nullopt;
        EXPECT_FALSE(frames.encoded(encode(*task)).has_value());
        return frames.takeFrame(now);
    }
    void ack(std::uint32_t sequence) { frames.acked({.sequence = sequence}, now); }
    /// Input, picture, JPEG, ack.
    void showFirst() {
        input(1);
        ASSERT_EQ(draw(), 1U);
        ASSERT_TRUE(finish(tag));
        ASSERT_TRUE(encodeAndSend().has_value());
        ack(1);
    }

    ViewFrames frames{{}};
    TimePoint now = TimePoint{} + std::chrono::hours{1};
    std::uint64_t tag = 0;
};

// A client that sends faster than frames are drawn must still see frames.
TEST_F(ViewFramesTest, ManyInputsDuringOneDrawDoNotLoseItsPicture) {
    input(1);
    ASSERT_EQ(draw(), 1U);
    const std::uint64_t drawn = tag;
    std::uint64_t newest = 1;
    for (std::uint64_t seq = 2; seq <= 2000; ++seq) {
        input(seq);
        if (const std::uint64_t asked = draw(); asked != 0) newest = asked;
    }
    EXPECT_GT(newest, 2U);
    ASSERT_TRUE(finish(drawn));
    const auto first = encodeAndSend();
    ASSERT_TRUE(first.has_value());
    EXPECT_EQ(first->header.input_seq(), 1U);
    ack(first->sequence);
    ASSERT_TRUE(finish(tag));  // The newest that the renderer was asked for.
    EXPECT_EQ(draw(), 2000U);
    ASSERT_TRUE(finish(tag));
    const auto last = encodeAndSend();
    ASSERT_TRUE(last.has_value());
    EXPECT_EQ(last->header.input_seq(), 2000U);
}

TEST_F(ViewFramesTest, TheFirstPictureGoesOutAsJpegAtOnceAndLosslesslyWhenCalm) {
    input(1);
    ASSERT_EQ(draw(), 1U);
    ASSERT_TRUE(finish(tag));
    const auto jpeg = encodeAndSend();
    ASSERT_TRUE(jpeg.has_value());
    EXPECT_EQ(jpeg->sequence, 1U);
    EXPECT_EQ(jpeg->header.codec(), v1::CODEC_JPEG);
    EXPECT_FALSE(jpeg->header.lossless() || jpeg->header.final());
    EXPECT_TRUE(jpeg->header.redrawn());
    ack(1);
    EXPECT_FALSE(encodeAndSend().has_value());
    EXPECT_EQ(frames.deadline(now), now + ViewFrames::kIdle);
    now += ViewFrames::kIdle;
    const auto png = encodeAndSend();
    ASSERT_TRUE(png.has_value());
    EXPECT_EQ(png->header.codec(), v1::CODEC_PNG);
    EXPECT_TRUE(png->header.lossless() && png->header.final());
    EXPECT_FALSE(png->header.redrawn());
    EXPECT_EQ(png->header.input_seq(), 1U);
    ack(2);
    now += std::chrono::hours{1};
    EXPECT_FALSE(encodeAndSend().has_value());
    EXPECT_FALSE(frames.deadline(now).has_value());
}

TEST_F(ViewFramesTest, ANewerInputReplacesOneThatWaits) {
    input(1);
    input(2);
    input(3);
    EXPECT_EQ(draw(), 3U);
    EXPECT_EQ(draw(), 0U);
}

TEST_F(ViewFramesTest, ANewerPictureReplacesOneThatWaitsForTheEncoder) {
    input(1);
    draw();
    input(2);
    draw();  // The first may have begun: both come back.
    finish(1);
    finish(2);
    const auto frame = encodeAndSend();
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(frame->header.input_seq(), 2U);
}

TEST_F(ViewFramesTest, NothingIsDrawnWithoutACredit) {
    for (std::uint32_t seq : {1U, 2U}) {
        input(seq);
        ASSERT_EQ(draw(), seq);
        finish(tag);
        ASSERT_TRUE(encodeAndSend().has_value());
    }
    input(3);
    EXPECT_EQ(draw(), 0U);
    ack(1);
    EXPECT_EQ(draw(), 3U);
}

TEST_F(ViewFramesTest, AnInputCancelsTheLosslessPicture) {
    showFirst();
    now += ViewFrames::kIdle;
    const auto task = frames.takeEncode(now);
    ASSERT_TRUE(task.has_value());
    ASSERT_TRUE(task->header.lossless());
    input(2);
    EXPECT_FALSE(frames.encoded(encode(*task)).has_value());
    EXPECT_FALSE(frames.takeFrame(now).has_value());
    EXPECT_EQ(draw(), 2U);
}

TEST_F(ViewFramesTest, CalmIsCountedInRoundTripsWhereTheyAreLong) {
    input(1);
    draw();
    finish(tag);
    encodeAndSend();
    const TimePoint began = now;
    now += milliseconds{400};
    ack(1);
    EXPECT_EQ(frames.deadline(now), began + milliseconds{600});
}

TEST_F(ViewFramesTest, ASilentClientGetsItsFirstFramesThenOneEachTwoSeconds) {
    input(1);
    draw();
    finish(tag);
    ASSERT_TRUE(encodeAndSend().has_value());
    now += ViewFrames::kIdle;
    ASSERT_TRUE(encodeAndSend().has_value());  // The lossless one takes the second credit.
    input(2);
    EXPECT_EQ(draw(), 0U);
    EXPECT_EQ(frames.deadline(now), now + FrameFlow::kProbeAfter);
    now += FrameFlow::kProbeAfter;
    frames.tick(now);
    EXPECT_EQ(draw(), 2U);
    finish(tag);
    ASSERT_TRUE(encodeAndSend().has_value());
    input(3);
    EXPECT_EQ(draw(), 0U);
}

TEST_F(ViewFramesTest, APictureDrawnAgainAfterALossIsSentAgain) {
    showFirst();
    EXPECT_TRUE(finish(tag));
    EXPECT_TRUE(encodeAndSend().has_value());
}

TEST_F(ViewFramesTest, APictureThatIsNotReadyIsAskedForAgainUntilItIs) {
    input(1);
    ASSERT_EQ(draw(), 1U);
    for (int i = 0; i < 3; ++i) {
        ASSERT_TRUE(finish(tag, false));
        const auto frame = encodeAndSend();
        ASSERT_TRUE(frame.has_value());
        EXPECT_FALSE(frame->header.ready());
        EXPECT_FALSE(frame->header.final());
        EXPECT_EQ(frame->header.input_seq(), 1U);
        ack(frame->sequence);
        now += std::chrono::seconds{1};
        EXPECT_FALSE(encodeAndSend().has_value()) << "it is not worth a lossless picture";
        ASSERT_EQ(draw(), 1U);
    }
    ASSERT_TRUE(finish(tag));
    const auto frame = encodeAndSend();
    ASSERT_TRUE(frame.has_value());
    EXPECT_TRUE(frame->header.ready());
    EXPECT_LT(frame->header.timings().wait_ms(), 1.0) << "nobody waited for it";
    ack(frame->sequence);
    now += std::chrono::seconds{1};
    EXPECT_EQ(draw(), 0U);
    const auto lossless = encodeAndSend();
    ASSERT_TRUE(lossless.has_value());
    EXPECT_TRUE(lossless->header.final());
    EXPECT_TRUE(lossless->header.ready());
}

TEST_F(ViewFramesTest, ANewerInputGoesBeforeWhatIsNotReady) {
    input(1);
    ASSERT_EQ(draw(), 1U);
    input(2);
    ASSERT_TRUE(finish(tag, false));
    EXPECT_EQ(draw(), 2U);
}

TEST_F(ViewFramesTest, WithPngAloneOnlyAReadyPictureIsFinal) {
    frames = ViewFrames{{.jpeg = false, .png = true}};
    input(1);
    ASSERT_EQ(draw(), 1U);
    ASSERT_TRUE(finish(tag, false));
    auto frame = encodeAndSend();
    ASSERT_TRUE(frame.has_value());
    EXPECT_FALSE(frame->header.final());
    ack(frame->sequence);
    ASSERT_EQ(draw(), 1U);
    ASSERT_TRUE(finish(tag));
    frame = encodeAndSend();
    ASSERT_TRUE(frame.has_value());
    EXPECT_TRUE(frame->header.final());
}

TEST_F(ViewFramesTest, PicturesThatNobodyAskedForAreIgnored) {
    EXPECT_FALSE(finish(7));
    showFirst();
    EXPECT_FALSE(finish(tag + 1));
}

TEST_F(ViewFramesTest, AFailureFreesTheWayForTheNextInput) {
    input(1);
    draw();
    EXPECT_TRUE(frames.failed(tag));
    input(2);
    EXPECT_EQ(draw(), 2U);
}

TEST_F(ViewFramesTest, WaitIsCountedFromTheInput) {
    input(1);
    now += milliseconds{30};
    draw();
    finish(tag);
    const auto frame = encodeAndSend();
    ASSERT_TRUE(frame.has_value());
    EXPECT_DOUBLE_EQ(frame->header.timings().wait_ms(), 30.0);
    EXPECT_GT(frame->header.timings().encode_ms(), 0.0);
}

TEST(ViewFramesCodecs, AClientWithoutJpegGetsEveryPictureLosslessly) {
    ViewFrames frames{{.jpeg = false, .png = true}};
    const TimePoint now = TimePoint{} + std::chrono::hours{1};
    std::uint64_t tag = 0;
    frames.want({.scene = {}, .size = {1, 1}, .inputSeq = 1, .dataVersion = 0, .inputAt = now});
    ASSERT_TRUE(frames.takeDraw(now, tag).has_value());
    auto picture = std::make_shared<workers::Picture>();
    picture->size = {1, 1};
    picture->rgba8.resize(4);
    workers::RenderedFrame frame;
    frame.tag = tag;
    frame.picture = picture;
    frames.rendered(frame);
    const auto task = frames.takeEncode(now);
    ASSERT_TRUE(task.has_value());
    EXPECT_EQ(task->header.codec(), v1::CODEC_PNG);
    EXPECT_TRUE(task->header.lossless() && task->header.final());
}

}  // namespace
}  // namespace volcast::session
