// What a viewer asks for and is sent as pacing, pins and codecs say.
#include <gtest/gtest.h>

#include "server/session/viewer.h"
#include "server/video/encoder.h"
#include "tests/support/av_decoder.h"

namespace volcast::session {
namespace {

using std::chrono::milliseconds;

constexpr scene::PictureSize kSize{64, 48};
const ClientCodecs kWithVideo{.webp = true, .vp9 = true};

/// Viewers of one view with a clock of their own; the renderer and the sockets are played.
class ViewerPacingTest : public testing::Test {
protected:
    void SetUp() override { viewer.moveTo(rendition); }
    /// A grey that grows with each picture.
    void drawPicture() {
        ++pictures;
        auto picture = std::make_shared<workers::Picture>();
        picture->size = rendition->key().size;
        const auto pixels = static_cast<std::size_t>(picture->size.x) * picture->size.y;
        picture->rgba8.assign(pixels * 4, static_cast<std::byte>(8 * pictures));
        workers::RenderedFrame frame;
        frame.tag = pictures;
        frame.picture = picture;
        frame.drawn = true;
        state.inputSeq = pictures;
        rendition->want();
        rendition->asked(pictures, state, now);
        ASSERT_TRUE(rendition->rendered(frame, pictures));
    }
    std::optional<ReadyFrame> send(Viewer& to) {
        const auto encoding = to.takeEncode(now);
        if (!encoding) return std::nullopt;
        if (!encoding->done) {
            *encoding = encode(*encoding);
            ++encodes;
        }
        EXPECT_TRUE(to.encoded()) << encoding->error->message;
        return to.takeFrame(now);
    }
    /// Input, picture, frame; acked after `roundTrip`.
    std::optional<ReadyFrame> exchange(milliseconds roundTrip) {
        viewer.input(now);
        follow();
        drawPicture();
        auto frame = send(viewer);
        now += roundTrip;
        if (frame) viewer.acked({.sequence = frame->sequence}, now);
        follow();
        return frame;
    }
    /// What the view does: one rendition, as this viewer wants it.
    void follow() {
        viewer.rest(now);
        rendition->change(viewer.wanted());
    }
    /// Until `enough` holds of the newest frame, over a way with a queue of 100 ms on it.
    std::optional<ReadyFrame> crowd(const std::function<bool(const v1::FrameHeader&)>& enough) {
        for (int i = 0; i < 3; ++i) exchange(milliseconds{10});
        for (int i = 0; i < 140; ++i) {
            auto frame = exchange(milliseconds{110});
            if (frame && enough(frame->header)) return frame;
        }
        return std::nullopt;
    }

    std::shared_ptr<Rendition> rendition = std::make_shared<Rendition>(RenditionKey{.size = kSize});
    Viewer viewer{{.codecs = {}, .size = kSize}};
    DrawState state;
    TimePoint now = TimePoint{} + std::chrono::hours{1};
    std::uint64_t pictures = 0, encodes = 0;
};

TEST_F(ViewerPacingTest, EveryHeaderSaysHowTheFrameWasPacedAndFromWhat) {
    exchange(milliseconds{20});
    const auto frame = exchange(milliseconds{20});
    ASSERT_TRUE(frame.has_value());
    const v1::Pace& pace = frame->header.pace();
    EXPECT_EQ(pace.quality(), 90U);
    EXPECT_EQ(pace.scale(), 1.0);
    EXPECT_TRUE(pace.full_accuracy());
    EXPECT_EQ(pace.frames_per_s(), 0.0);
    EXPECT_GE(pace.window(), 2U);
    EXPECT_EQ(pace.under_way(), 1U) << "with this one";
    EXPECT_DOUBLE_EQ(pace.rtt_ms(), 20.0);
    EXPECT_DOUBLE_EQ(pace.rtt_min_ms(), 20.0);
    EXPECT_EQ(pace.queue_delay_ms(), 0.0);
    EXPECT_GT(pace.bytes_per_s(), 0.0);
    EXPECT_EQ(pace.reason(), "");
}

TEST_F(ViewerPacingTest, ACrowdedWayGetsSmallerPicturesAndTheirHeadersSaySo) {
    const auto worse = crowd([](const auto& header) { return header.pace().quality() == 75; });
    ASSERT_TRUE(worse.has_value());
    EXPECT_NE(worse->header.pace().reason().find("queueing delay"), std::string::npos);
    const auto small = crowd([](const auto& header) { return header.pace().scale() == 0.5; });
    ASSERT_TRUE(small.has_value());
    EXPECT_EQ(small->header.width(), 32U);
    EXPECT_EQ(small->header.height(), 24U);
    EXPECT_FALSE(small->header.final());
}

TEST_F(ViewerPacingTest, AtRestAllOfThePictureComesThenItsExactFormAndAnInputEndsThat) {
    ASSERT_TRUE(crowd([](const auto& header) { return !header.pace().full_accuracy(); }));
    ASSERT_NE(viewer.wanted(), RenditionKey{.size = kSize});
    const auto calm = viewer.deadline(now);
    ASSERT_TRUE(calm.has_value());
    now = *calm;
    follow();
    EXPECT_EQ(viewer.wanted(), RenditionKey{.size = kSize});
    ASSERT_TRUE(rendition->wants());
    drawPicture();
    const auto full = send(viewer);
    ASSERT_TRUE(full.has_value());
    EXPECT_EQ(full->header.width(), 64U);
    EXPECT_EQ(full->header.pace().quality(), 90U);
    EXPECT_EQ(full->header.pace().scale(), 1.0);
    EXPECT_TRUE(full->header.pace().full_accuracy());
    EXPECT_FALSE(full->header.final());
    viewer.acked({.sequence = full->sequence}, now);
    const auto exact = send(viewer);
    ASSERT_TRUE(exact.has_value());
    EXPECT_TRUE(exact->header.lossless() && exact->header.final());
    EXPECT_EQ(exact->header.pace().quality(), 0U);
    viewer.acked({.sequence = exact->sequence}, now);
    EXPECT_FALSE(viewer.deadline(now).has_value()) << "nothing more is owed";
    viewer.input(now);
    EXPECT_NE(viewer.wanted(), RenditionKey{.size = kSize});
}

TEST_F(ViewerPacingTest, TheHashOfALosslessFrameIsThatOfItsPixels) {
    exchange(milliseconds{20});
    now += Viewer::kIdle;
    const auto exact = send(viewer);
    ASSERT_TRUE(exact.has_value());
    const workers::Picture& picture = *rendition->picture()->pixels;
    EXPECT_EQ(exact->header.pixels_xxh32(),
              video::pixelHash({.size = picture.size, .rgba = picture.rgba8}));
}

TEST_F(ViewerPacingTest, PinsHoldWhateverTheWayIs) {
    viewer.setPins({.quality = 95, .scale = 1.0, .fullAccuracy = true}, v1::CODEC_UNSPECIFIED);
    const auto slow =
        crowd([](const auto& header) { return header.pace().frames_per_s() == 15.0; });
    ASSERT_TRUE(slow.has_value()) << "the rate alone was left to give up";
    EXPECT_EQ(slow->header.pace().quality(), 95U);
    EXPECT_EQ(slow->header.pace().scale(), 1.0);
    EXPECT_TRUE(slow->header.pace().full_accuracy());
}

TEST_F(ViewerPacingTest, APinnedRateKeepsPicturesApart) {
    viewer.setPins({.framesPerS = 4.0}, v1::CODEC_UNSPECIFIED);
    ASSERT_TRUE(exchange(milliseconds{10}).has_value());
    const TimePoint began = now - milliseconds{10};
    viewer.input(now);
    rendition->want();
    EXPECT_FALSE(viewer.mayDraw(now));
    EXPECT_EQ(viewer.deadline(now), began + milliseconds{250});
    EXPECT_TRUE(viewer.mayDraw(began + milliseconds{250}));
}

TEST_F(ViewerPacingTest, APinnedCodecIsUsed) {
    viewer.setCodecs(kWithVideo);
    for (const v1::Codec codec : {v1::CODEC_WEBP, v1::CODEC_VP9, v1::CODEC_JPEG, v1::CODEC_PNG}) {
        viewer.setPins({}, codec);
        const auto frame = exchange(milliseconds{10});
        ASSERT_TRUE(frame.has_value());
        EXPECT_EQ(frame->header.codec(), codec);
        EXPECT_EQ(frame->header.lossless(), isLossless(codec));
        EXPECT_EQ(frame->header.keyframe(), isVideo(codec));
    }
}

TEST_F(ViewerPacingTest, VideoComesInPlaceOfJpegWhereTheWayIsCrowdedAndDecodes) {
    viewer.setCodecs(kWithVideo);
    auto frame = crowd([](const auto& header) { return header.codec() == v1::CODEC_VP9; });
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(frame->header.pace().reason().find("JPEG to video: "), 0U);
    EXPECT_TRUE(frame->header.keyframe());
    volcast::test::AvDecoder decoder{"vp9"};
    EXPECT_TRUE(decoder.decode(*frame->payload).has_value());
    frame = exchange(milliseconds{10});
    ASSERT_TRUE(frame.has_value());
    ASSERT_EQ(frame->header.codec(), v1::CODEC_VP9);
    EXPECT_FALSE(frame->header.keyframe());
    const auto decoded = decoder.decode(*frame->payload);
    ASSERT_TRUE(decoded.has_value());
    EXPECT_NEAR(decoded->rgb.front(), static_cast<double>((8 * pictures) & 0xFF), 3);
    // The exact picture is a file, smaller as WebP.
    now += std::chrono::seconds{1};
    follow();
    const auto exact = send(viewer);
    ASSERT_TRUE(exact.has_value());
    EXPECT_EQ(exact->header.codec(), v1::CODEC_WEBP);
}

/// Several viewers of one rendition, all with VP9.
class VideoGroupTest : public ViewerPacingTest {
protected:
    void SetUp() override { ViewerPacingTest::SetUp(); }
    Viewer make() {
        Viewer made{{.codecs = kWithVideo, .size = kSize}};
        made.moveTo(rendition);
        made.setPins({}, v1::CODEC_VP9);
        return made;
    }
    std::optional<ReadyFrame> sendAndAck(Viewer& to) {
        auto frame = send(to);
        if (frame) to.acked({.sequence = frame->sequence}, now);
        return frame;
    }
};

TEST_F(VideoGroupTest, ViewersInStepShareOneEncodingOfEachPicture) {
    Viewer one = make(), two = make();
    for (int i = 0; i < 4; ++i) {
        drawPicture();
        const auto first = sendAndAck(one), second = sendAndAck(two);
        ASSERT_TRUE(first && second);
        EXPECT_EQ(first->payload, second->payload) << "not the same bytes in memory";
        EXPECT_EQ(first->header.keyframe(), i == 0);
    }
    EXPECT_EQ(encodes, 4U);
}

TEST_F(VideoGroupTest, WhoJoinsGetsAKeyframeThatTheOthersShare) {
    Viewer one = make();
    drawPicture();
    sendAndAck(one);
    Viewer joins = make();
    drawPicture();
    const auto first = sendAndAck(joins), second = sendAndAck(one);
    ASSERT_TRUE(first && second);
    EXPECT_TRUE(first->header.keyframe());
    EXPECT_EQ(first->payload, second->payload);
    drawPicture();
    EXPECT_FALSE(sendAndAck(one)->header.keyframe());
    EXPECT_FALSE(sendAndAck(joins)->header.keyframe());
    EXPECT_EQ(encodes, 3U);
}

// Who skips a picture begins anew in a group of its own; the other's video goes on without
// keyframes.
TEST_F(VideoGroupTest, WhoMissesAPictureCostsTheOthersNoKeyframes) {
    Viewer fast = make(), slow = make();
    volcast::test::AvDecoder fastDecoder{"vp9"}, slowDecoder{"vp9"};
    int fastKeys = 0, slowKeys = 0;
    for (int i = 0; i < 9; ++i) {
        drawPicture();
        const auto frame = sendAndAck(fast);
        ASSERT_TRUE(frame.has_value());
        fastKeys += frame->header.keyframe() ? 1 : 0;
        ASSERT_TRUE(fastDecoder.decode(*frame->payload).has_value());
        if (i % 3 != 0) continue;
        const auto late = sendAndAck(slow);
        ASSERT_TRUE(late.has_value());
        slowKeys += late->header.keyframe() ? 1 : 0;
        const auto decoded = slowDecoder.decode(*late->payload);
        ASSERT_TRUE(decoded.has_value());
        EXPECT_NEAR(decoded->rgb.front(), static_cast<double>(8 * pictures), 3) << i;
    }
    EXPECT_EQ(fastKeys, 1);
    EXPECT_EQ(slowKeys, 2) << "on joining, and once on its own";
}

// Whichever of them is asked first.
TEST_F(VideoGroupTest, TheKeyframesOfWhoMissesPicturesAreNotForTheOthers) {
    Viewer slow = make(), fast = make();
    int fastKeys = 0, slowKeys = 0;
    for (int i = 0; i < 9; ++i) {
        drawPicture();
        if (i % 3 == 0) {
            const auto late = sendAndAck(slow);
            ASSERT_TRUE(late.has_value());
            slowKeys += late->header.keyframe() ? 1 : 0;
        }
        const auto frame = sendAndAck(fast);
        ASSERT_TRUE(frame.has_value());
        fastKeys += frame->header.keyframe() ? 1 : 0;
    }
    EXPECT_EQ(fastKeys, 1);
    EXPECT_EQ(slowKeys, 2) << "on joining, and once on its own";
}

TEST_F(VideoGroupTest, WhereVideoCannotBeEncodedThePictureComesAsJpeg) {
    Viewer first = make(), second = make();
    drawPicture();
    const auto failed = first.takeEncode(now);
    ASSERT_TRUE(failed && isVideo(failed->format.codec));
    failed->done = failed->begun = true;
    failed->error = fail(ErrorCode::kIo, "the encoder has no room for another stream");
    EXPECT_TRUE(first.encoded());
    const auto frame = send(first);
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(frame->header.codec(), v1::CODEC_JPEG);
    EXPECT_EQ(frame->header.input_seq(), pictures);
    const auto own = second.takeEncode(now);
    ASSERT_TRUE(own != nullptr);
    EXPECT_NE(own, failed) << "what failed is of no use to others";
    drawPicture();
    first.acked({.sequence = frame->sequence}, now);
    EXPECT_EQ(send(first)->header.codec(), v1::CODEC_JPEG) << "it is not tried again";
}

TEST_F(VideoGroupTest, APictureThatAnotherOvertookInTheEncoderComesAsAKeyframe) {
    Viewer one = make();
    drawPicture();
    const auto late = one.takeEncode(now);
    late->done = late->begun = true;
    late->error = late->group->encode({}, 0, false).error();
    EXPECT_TRUE(one.encoded());
    const auto frame = send(one);
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(frame->header.codec(), v1::CODEC_VP9);
    EXPECT_TRUE(frame->header.keyframe());
}

TEST_F(VideoGroupTest, AClientThatCannotDecodeGetsAKeyframeNext) {
    Viewer one = make();
    drawPicture();
    sendAndAck(one);
    drawPicture();
    const auto frame = send(one);
    ASSERT_TRUE(frame && !frame->header.keyframe());
    one.acked({.sequence = frame->sequence, .keyframe = true}, now);
    drawPicture();
    EXPECT_TRUE(sendAndAck(one)->header.keyframe());
    drawPicture();
    EXPECT_FALSE(sendAndAck(one)->header.keyframe());
}

TEST_F(VideoGroupTest, AnotherSizeBeginsWithAKeyframe) {
    Viewer one = make();
    drawPicture();
    sendAndAck(one);
    one.resize({32, 24}, 0);
    rendition->change(one.wanted());
    drawPicture();
    const auto frame = sendAndAck(one);
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(frame->header.width(), 32U);
    EXPECT_TRUE(frame->header.keyframe());
}

}  // namespace
}  // namespace volcast::session
