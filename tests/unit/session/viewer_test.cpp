#include "server/session/viewer.h"

#include <gtest/gtest.h>

namespace volcast::session {
namespace {

using std::chrono::milliseconds;

/// One viewer of one rendition with a clock of its own; the view, the renderer and the socket are
/// played by the test.
class ViewerTest : public testing::Test {
protected:
    void SetUp() override { viewer.rendition = rendition; }
    void input(std::uint64_t seq) {
        viewer.input(now);
        state.inputSeq = seq;
        state.inputAt = now;
        rendition->want();
    }
    /// Asks for the newest state; returns its input_seq, 0 where nothing may be drawn.
    std::uint64_t draw() {
        if (!rendition->wants() || !viewer.mayDraw(now)) return 0;
        rendition->asked(++tag, state, now);
        return state.inputSeq;
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
        return rendition->rendered(frame, ++pictures);
    }
    std::optional<ReadyFrame> encodeAndSend() { return encodeAndSend(viewer); }
    std::optional<ReadyFrame> encodeAndSend(Viewer& to) {
        const auto encoding = to.takeEncode(now);
        if (!encoding) return std::nullopt;
        if (!encoding->done) *encoding = encode(*encoding);
        EXPECT_TRUE(to.encoded());
        return to.takeFrame(now);
    }
    void ack(std::uint32_t sequence) { viewer.acked({.sequence = sequence}, now); }
    /// Input, picture, JPEG, ack.
    void showFirst() {
        input(1);
        ASSERT_EQ(draw(), 1U);
        ASSERT_TRUE(finish(tag));
        ASSERT_TRUE(encodeAndSend().has_value());
        ack(1);
    }

    std::shared_ptr<Rendition> rendition =
        std::make_shared<Rendition>(RenditionKey{.size = {8, 4}});
    Viewer viewer{{.codecs = {}, .size = {8, 4}}};
    DrawState state;
    TimePoint now = TimePoint{} + std::chrono::hours{1};
    std::uint64_t tag = 0, pictures = 0;
};

// A client that sends faster than frames are drawn must still see frames.
TEST_F(ViewerTest, ManyInputsDuringOneDrawDoNotLoseItsPicture) {
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

TEST_F(ViewerTest, TheFirstPictureGoesOutAsJpegAtOnceAndLosslesslyWhenCalm) {
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
    EXPECT_EQ(viewer.deadline(now), now + Viewer::kIdle);
    now += Viewer::kIdle;
    const auto png = encodeAndSend();
    ASSERT_TRUE(png.has_value());
    EXPECT_EQ(png->header.codec(), v1::CODEC_PNG);
    EXPECT_TRUE(png->header.lossless() && png->header.final());
    EXPECT_FALSE(png->header.redrawn());
    EXPECT_EQ(png->header.input_seq(), 1U);
    ack(2);
    now += std::chrono::hours{1};
    EXPECT_FALSE(encodeAndSend().has_value());
    EXPECT_FALSE(viewer.deadline(now).has_value());
}

TEST_F(ViewerTest, ANewerInputReplacesOneThatWaits) {
    input(1);
    input(2);
    input(3);
    EXPECT_EQ(draw(), 3U);
    EXPECT_EQ(draw(), 0U);
}

TEST_F(ViewerTest, ANewerPictureReplacesOneThatWaitsForTheEncoder) {
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

TEST_F(ViewerTest, NothingIsDrawnWithoutACredit) {
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

TEST_F(ViewerTest, AnInputCancelsTheLosslessPicture) {
    showFirst();
    now += Viewer::kIdle;
    const auto encoding = viewer.takeEncode(now);
    ASSERT_TRUE(encoding);
    ASSERT_EQ(encoding->format.codec, v1::CODEC_PNG);
    input(2);
    EXPECT_FALSE(viewer.waitsFor(*encoding));
    *encoding = encode(*encoding);
    EXPECT_FALSE(viewer.takeFrame(now).has_value());
    EXPECT_EQ(draw(), 2U);
}

TEST_F(ViewerTest, CalmIsCountedInRoundTripsWhereTheyAreLong) {
    input(1);
    draw();
    finish(tag);
    encodeAndSend();
    const TimePoint began = now;
    now += milliseconds{400};
    ack(1);
    EXPECT_EQ(viewer.deadline(now), began + milliseconds{600});
}

TEST_F(ViewerTest, ASilentClientGetsItsFirstFramesThenOneEachTwoSeconds) {
    input(1);
    draw();
    finish(tag);
    ASSERT_TRUE(encodeAndSend().has_value());
    now += Viewer::kIdle;
    ASSERT_TRUE(encodeAndSend().has_value());  // The lossless one takes the second credit.
    input(2);
    EXPECT_EQ(draw(), 0U);
    EXPECT_EQ(viewer.deadline(now), now + FrameFlow::kProbeAfter);
    now += FrameFlow::kProbeAfter;
    viewer.tick(now);
    EXPECT_EQ(draw(), 2U);
    finish(tag);
    ASSERT_TRUE(encodeAndSend().has_value());
    input(3);
    EXPECT_EQ(draw(), 0U);
}

TEST_F(ViewerTest, APictureDrawnAgainAfterALossIsSentAgain) {
    showFirst();
    EXPECT_TRUE(finish(tag));
    EXPECT_TRUE(encodeAndSend().has_value());
}

TEST_F(ViewerTest, APictureThatIsNotReadyIsAskedForAgainUntilItIs) {
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

TEST_F(ViewerTest, ANewerInputGoesBeforeWhatIsNotReady) {
    input(1);
    ASSERT_EQ(draw(), 1U);
    input(2);
    ASSERT_TRUE(finish(tag, false));
    EXPECT_EQ(draw(), 2U);
}

TEST_F(ViewerTest, WithPngAloneOnlyAReadyPictureIsFinal) {
    viewer = Viewer{{.codecs = {.jpeg = false, .png = true}, .size = {8, 4}}};
    viewer.rendition = rendition;
    input(1);
    ASSERT_EQ(draw(), 1U);
    ASSERT_TRUE(finish(tag, false));
    auto frame = encodeAndSend();
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(frame->header.codec(), v1::CODEC_PNG);
    EXPECT_FALSE(frame->header.final());
    ack(frame->sequence);
    ASSERT_EQ(draw(), 1U);
    ASSERT_TRUE(finish(tag));
    frame = encodeAndSend();
    ASSERT_TRUE(frame.has_value());
    EXPECT_TRUE(frame->header.lossless() && frame->header.final());
}

TEST_F(ViewerTest, PicturesThatNobodyAskedForAreIgnored) {
    EXPECT_FALSE(finish(7));
    showFirst();
    EXPECT_FALSE(finish(tag + 1));
}

TEST_F(ViewerTest, AFailureFreesTheWayForTheNextInput) {
    input(1);
    draw();
    bool newest = false;
    EXPECT_TRUE(rendition->failed(tag, newest));
    EXPECT_TRUE(newest);
    input(2);
    EXPECT_EQ(draw(), 2U);
}

TEST_F(ViewerTest, WaitIsCountedFromTheInput) {
    input(1);
    now += milliseconds{30};
    draw();
    finish(tag);
    const auto frame = encodeAndSend();
    ASSERT_TRUE(frame.has_value());
    EXPECT_DOUBLE_EQ(frame->header.timings().wait_ms(), 30.0);
    EXPECT_GT(frame->header.timings().encode_ms(), 0.0);
}

TEST_F(ViewerTest, TwoViewersShareTheBytesOfOnePicture) {
    Viewer other{{.codecs = {}, .size = {8, 4}}};
    other.rendition = rendition;
    input(1);
    draw();
    finish(tag);
    const auto mine = encodeAndSend(), theirs = encodeAndSend(other);
    ASSERT_TRUE(mine && theirs);
    EXPECT_EQ(mine->payload, theirs->payload) << "not the same bytes in memory";
    EXPECT_FALSE(mine->payload->empty());
}

TEST_F(ViewerTest, ASlowViewerSkipsPicturesAndHoldsUpNobody) {
    Viewer slow{{.codecs = {}, .size = {8, 4}}};
    slow.rendition = rendition;
    std::optional<ReadyFrame> lastOfSlow;
    for (std::uint32_t seq = 1; seq <= 10; ++seq) {
        input(seq);
        ASSERT_EQ(draw(), seq) << "the fast one waits for the slow one";
        ASSERT_TRUE(finish(tag));
        const auto frame = encodeAndSend();
        ASSERT_TRUE(frame.has_value());
        EXPECT_EQ(frame->header.input_seq(), seq);
        ack(frame->sequence);
        if (auto one = encodeAndSend(slow)) lastOfSlow = std::move(one);
    }
    ASSERT_TRUE(lastOfSlow.has_value());
    EXPECT_EQ(lastOfSlow->sequence, 2U) << "two frames are under way without an ack";
    EXPECT_EQ(lastOfSlow->header.input_seq(), 2U);
    slow.acked({.sequence = 1}, now);
    lastOfSlow = encodeAndSend(slow);
    ASSERT_TRUE(lastOfSlow.has_value());
    EXPECT_EQ(lastOfSlow->header.input_seq(), 10U) << "the newest comes next";
}

TEST_F(ViewerTest, AnotherSizeShowsWhatIsBeingDrawnMeanwhile) {
    input(1);
    ASSERT_EQ(draw(), 1U);
    rendition->change({.size = {16, 8}});
    ASSERT_TRUE(rendition->wants());
    ASSERT_EQ(draw(), 1U);
    ASSERT_TRUE(finish(1));
    EXPECT_EQ(encodeAndSend()->header.width(), 8U);
    ASSERT_TRUE(finish(2));
    EXPECT_TRUE(encodeAndSend().has_value());
}

}  // namespace
}  // namespace volcast::session
