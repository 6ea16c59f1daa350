// Pacing and codecs over real sockets: slow ways, pins, each codec, keyframes.
#include <webp/decode.h>

#include "server/video/encoder.h"
#include "tests/e2e/server/shared_server.h"
#include "tests/support/av_decoder.h"
#include "tests/support/slow_link.h"

namespace volcast::test {
namespace {

constexpr std::uint32_t kMostUnderWay = 8;

/// RGBA8 of a lossless frame.
Decoded exactPixels(const TestFrame& frame) {
    if (frame.header.codec() == v1::CODEC_PNG) return decode(frame);
    Decoded decoded;
    decoded.channels = 4;
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(frame.payload.data());
    if (WebPGetInfo(bytes, frame.payload.size(), &decoded.width, &decoded.height) == 0) return {};
    decoded.pixels.resize(std::size_t{4} * static_cast<std::size_t>(decoded.width) *
                          static_cast<std::size_t>(decoded.height));
    WebPDecodeRGBAInto(bytes, frame.payload.size(), decoded.pixels.data(), decoded.pixels.size(),
                       4 * decoded.width);
    return decoded;
}

class PacingAndCodecs : public SharedServer {
protected:
    /// Turns the camera once for each frame that comes, until `enough`; checks each by `look`.
    static bool steer(TestClient& client, std::uint64_t& seq,
                      const std::function<void(const TestFrame&)>& check,
                      const std::function<bool(const v1::FrameHeader&)>& enough) {
        const auto until = std::chrono::steady_clock::now() + kPatience;
        while (std::chrono::steady_clock::now() < until) {
            ++seq;
            client.look(1, seq, 0.02 * static_cast<double>(seq));
            const auto frame = client.waitForFrame([](const auto&) { return true; });
            if (!frame) return false;
            check(*frame);
            if (enough(frame->header)) return true;
        }
        return false;
    }
    static void pin(TestClient& client, const std::function<void(v1::Pins&)>& fill) {
        v1::ClientMessage message;
        message.mutable_set_pins()->set_view(1);
        fill(*message.mutable_set_pins()->mutable_pins());
        client.send(message);
    }
    /// Decodes the patches that come, as a client does; the codecs that were answered.
    static std::vector<v1::Codec> answerPatches(TestClient& client, std::size_t count) {
        std::vector<v1::Codec> answered;
        for (std::size_t i = 0; i < count; ++i) {
            const auto patch =
                client.waitForFrame([](const auto& one) { return one.header.patch(); });
            if (!patch) break;
            const v1::Codec codec = patch->header.codec();
            AvDecoder decoder{codec == v1::CODEC_VP9 ? "vp9" : "h264"};
            const auto picture = decoder.decode(patch->payload);
            if (!picture) break;
            v1::ClientMessage message;
            v1::PatchDecoded& decoded = *message.mutable_patch_decoded();
            decoded.set_codec(codec);
            for (int square = 0; square < 8; ++square) {
                const int x = (2 * (square % 4) + 1) * picture->width / 8;
                const int y = (2 * (square / 4) + 1) * picture->height / 4;
                const auto at = static_cast<std::size_t>(3 * (y * picture->width + x));
                decoded.mutable_rgb()->append(reinterpret_cast<const char*>(&picture->rgb[at]), 3);
            }
            client.send(message);
            answered.push_back(codec);
        }
        return answered;
    }
    /// A client with all codecs, patches answered, view 1 open.
    std::unique_ptr<TestClient> clientWithVideo() {
        v1::Hello hello;
        for (const v1::Codec codec :
             {v1::CODEC_JPEG, v1::CODEC_PNG, v1::CODEC_WEBP, v1::CODEC_VP9, v1::CODEC_H264}) {
            hello.add_codecs(codec);
        }
        auto client =
            std::make_unique<TestClient>(port(), TestClient::Form::kBinary, WsOptions{}, hello);
        if (!client->ok()) return nullptr;
        const auto welcome = client->waitFor([](const auto& one) { return one.has_welcome(); });
        if (!welcome) return nullptr;
        for (const int codec : welcome->welcome().codecs()) {
            if (codec == v1::CODEC_VP9 || codec == v1::CODEC_H264) ++offered;
        }
        video = answerPatches(*client, offered);
        client->openView(1, "good.node", 97, 65);  // Odd, as windows are.
        return client->waitForFrame(1, 1) ? std::move(client) : nullptr;
    }
    std::size_t offered = 0;
    std::vector<v1::Codec> video;
};

// 40 KB/s: JPEG at quality 90 is too much for it.
TEST_F(PacingAndCodecs, OnASlowWayFewFramesAreAheadAndTheStepsAreInTheHeaders) {
    const auto link = SlowLink::create(port(), 40e3);
    ASSERT_TRUE(link);
    TestClient client{link->port()};
    ASSERT_TRUE(client.ok());
    client.openView(1, "good.node", 800, 600);
    std::uint64_t seq = 1;
    std::size_t bytes = 0;
    const auto check = [&](const TestFrame& frame) {
        const v1::Pace& pace = frame.header.pace();
        EXPECT_LE(pace.under_way(), std::max(pace.window(), 1U)) << frame.prefix.sequence;
        EXPECT_LE(pace.under_way(), kMostUnderWay);
        // One input is sent for each frame: what this one does not show yet are frames ahead of it,
        // one that is drawn and one that waits.
        EXPECT_LE(seq - frame.header.input_seq(), kMostUnderWay + 2);
        bytes += frame.payload.size();
    };
    ASSERT_TRUE(steer(client, seq, check, [](const auto& header) {
        return header.pace().quality() <= 60;
    })) << server().log();
    ASSERT_TRUE(steer(client, seq, check, [](const auto& header) {
        return header.pace().reason().find("queueing delay") != std::string::npos;
    }));
    EXPECT_GT(bytes, 100'000U);
}

TEST_F(PacingAndCodecs, PinsHoldOnASlowWay) {
    const auto link = SlowLink::create(port(), 40e3);
    ASSERT_TRUE(link);
    TestClient client{link->port()};
    ASSERT_TRUE(client.ok());
    client.openView(1, "good.node", 800, 600);
    pin(client, [](v1::Pins& pins) {
        pins.set_quality(92);
        pins.set_full_accuracy(true);
    });
    std::uint64_t seq = 1;
    bool pinned = false;
    const auto check = [&](const TestFrame& frame) {
        pinned = pinned || frame.header.pace().quality() == 92;  // Frames from before may come.
        if (!pinned || frame.header.lossless()) return;
        EXPECT_EQ(frame.header.pace().quality(), 92U);
        EXPECT_TRUE(frame.header.pace().full_accuracy());
    };
    EXPECT_TRUE(steer(client, seq, check, [](const auto& header) {
        return header.pace().scale() == 0.5;
    })) << "the size was left to give up";
    EXPECT_TRUE(pinned);
}

TEST_F(PacingAndCodecs, EachCodecsFramesShowThePictureAndTheExactOneFollows) {
    const auto client = clientWithVideo();
    ASSERT_TRUE(client) << server().log();
    ASSERT_EQ(video.size(), offered);
    std::vector<v1::Codec> codecs{v1::CODEC_JPEG, v1::CODEC_WEBP};
    codecs.insert(codecs.end(), video.begin(), video.end());
    std::uint64_t seq = 1;
    for (const v1::Codec codec : codecs) {
        pin(*client, [codec](v1::Pins& pins) { pins.set_codec(codec); });
        ++seq;
        client->look(1, seq, 0.1 * static_cast<double>(seq));
        const auto frame = client->waitForFrame([&](const TestFrame& one) {
            return one.header.codec() == codec && one.header.input_seq() == seq;
        });
        ASSERT_TRUE(frame.has_value()) << v1::Codec_Name(codec);
        auto exact = frame;
        if (!frame->header.lossless()) exact = client->waitForLossless(1, seq);
        ASSERT_TRUE(exact.has_value());
        const Decoded right = exactPixels(*exact);
        ASSERT_EQ(right.width, 97);
        const std::span<const unsigned char> pixels{right.pixels};
        EXPECT_EQ(
            video::pixelHash({.size = {right.width, right.height}, .rgba = std::as_bytes(pixels)}),
            exact->header.pixels_xxh32());
        if (codec != v1::CODEC_VP9 && codec != v1::CODEC_H264) continue;
        EXPECT_TRUE(frame->header.keyframe());
        AvDecoder decoder{codec == v1::CODEC_VP9 ? "vp9" : "h264"};
        const auto shown = decoder.decode(frame->payload);
        ASSERT_TRUE(shown.has_value());
        double sum = 0;
        for (int y = 0; y < right.height; ++y) {
            for (int x = 0; x < 3 * right.width; ++x) {
                sum += std::abs(
                    shown->rgb[static_cast<std::size_t>(3 * y * shown->width + x)] -
                    right.pixels[static_cast<std::size_t>(4 * (y * right.width + x / 3) + x % 3)]);
            }
        }
        EXPECT_LT(sum / (3.0 * right.width * right.height), 4.0) << v1::Codec_Name(codec);
    }
}

TEST_F(PacingAndCodecs, KeyframesComeFirstAfterResizingAndWhenAClientAsks) {
    const auto client = clientWithVideo();
    ASSERT_TRUE(client) << server().log();
    if (video.empty()) GTEST_SKIP() << "this machine has no video encoder";
    pin(*client, [this](v1::Pins& pins) { pins.set_codec(video.front()); });
    std::uint64_t seq = 1;
    const auto next = [&] {
        ++seq;
        client->look(1, seq, 0.1 * static_cast<double>(seq));
        return client->waitForFrame([&](const TestFrame& one) {
            return one.header.codec() == video.front() && one.header.input_seq() == seq;
        });
    };
    auto frame = next();
    ASSERT_TRUE(frame && frame->header.keyframe()) << "the first";
    frame = next();
    ASSERT_TRUE(frame && !frame->header.keyframe());
    v1::ClientMessage resize;
    resize.mutable_update()->set_view(1);
    resize.mutable_update()->set_input_seq(++seq);
    resize.mutable_update()->mutable_viewport()->set_width(120);
    resize.mutable_update()->mutable_viewport()->set_height(80);
    client->send(resize);
    frame = client->waitForFrame([](const TestFrame& one) { return one.header.width() == 120; });
    ASSERT_TRUE(frame && frame->header.keyframe()) << "another size";
    frame = next();
    ASSERT_TRUE(frame && !frame->header.keyframe());
    v1::ClientMessage lost;
    lost.mutable_ack()->set_view(1);
    lost.mutable_ack()->set_sequence(frame->prefix.sequence);
    lost.mutable_ack()->set_keyframe(true);
    client->send(lost);
    frame = next();
    ASSERT_TRUE(frame && frame->header.keyframe()) << "asked for";
}

}  // namespace
}  // namespace volcast::test
