// What hardware encoders need, as far as it can be tried without hardware.
#include "server/video/hardware_frames.h"

#include <fstream>

#include <gmock/gmock.h>

extern "C" {
#include <libavutil/opt.h>
}

#include "server/video/video_encoders.h"
#include "tests/support/temporary_folder.h"

namespace volcast::video {
namespace {

using testing::HasSubstr;

TEST(Vaapi, WithoutARenderNodeItSaysSo) {
    const support::TemporaryFolder folder;
    std::ofstream{folder.path() / "card0"};
    const auto device = openVaapi(folder.path());
    ASSERT_FALSE(device.has_value());
    EXPECT_EQ(device.error().code, ErrorCode::kUnsupported);
    EXPECT_THAT(device.error().message, HasSubstr("no render node"));
    EXPECT_THAT(device.error().message, HasSubstr(folder.path().string()));
    EXPECT_FALSE(openVaapi(folder.path() / "none").has_value());
}

TEST(Vaapi, NodesThatDoNotOpenAreNamedEach) {
    const support::TemporaryFolder folder;
    std::ofstream{folder.path() / "renderD128"} << "no device";
    std::ofstream{folder.path() / "renderD129"} << "no device";
    const auto device = openVaapi(folder.path());
    ASSERT_FALSE(device.has_value());
    EXPECT_EQ(device.error().code, ErrorCode::kUnsupported);
    EXPECT_THAT(device.error().message, HasSubstr("renderD128: "));
    EXPECT_THAT(device.error().message, HasSubstr("renderD129: "));
}

TEST(Vaapi, PicturesAreHandedOverAsNv12) {
    FramePtr planes{av_frame_alloc()};
    planes->format = AV_PIX_FMT_YUV420P;
    planes->width = 6;
    planes->height = 4;
    ASSERT_GE(av_frame_get_buffer(planes.get(), 0), 0);
    const auto at = [](const AVFrame& frame, std::size_t plane, int x, int y) -> std::uint8_t& {
        return frame.data[plane][frame.linesize[plane] * y + x];
    };
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 6; ++x) at(*planes, 0, x, y) = static_cast<std::uint8_t>(10 * y + x);
    }
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 3; ++x) {
            at(*planes, 1, x, y) = static_cast<std::uint8_t>(100 + 10 * y + x);
            at(*planes, 2, x, y) = static_cast<std::uint8_t>(200 + 10 * y + x);
        }
    }
    const auto made = toNv12(*planes);
    ASSERT_TRUE(made.has_value()) << made.error().message;
    const AVFrame& frame = **made;
    EXPECT_EQ(frame.format, AV_PIX_FMT_NV12);
    EXPECT_EQ(at(frame, 0, 5, 3), 35);
    EXPECT_EQ(at(frame, 1, 0, 0), 100);
    EXPECT_EQ(at(frame, 1, 1, 0), 200);
    EXPECT_EQ(at(frame, 1, 4, 1), 112);
    EXPECT_EQ(at(frame, 1, 5, 1), 212);
}

// A name that libavcodec does not know would only be noticed on the hardware.
TEST(EncoderRows, OptionsAreThoseOfTheirEncoders) {
    int known = 0;
    for (const EncoderRow& row : kEncoderRows) {
        const AVCodec* codec = avcodec_find_encoder_by_name(row.name);
        if (codec == nullptr) continue;  // libavcodec may be built without it.
        ++known;
        const auto has = [&](const char* name, const char* value) {
            const AVClass* options = codec->priv_class;
            const AVOption* option =
                av_opt_find(&options, name, nullptr, 0, AV_OPT_SEARCH_FAKE_OBJ);
            if (option == nullptr) return false;
            if (value == nullptr || option->unit == nullptr) return true;
            return av_opt_find(&options, value, option->unit, 0, AV_OPT_SEARCH_FAKE_OBJ) != nullptr;
        };
        EXPECT_TRUE(has(row.quantiser, nullptr)) << row.name << " " << row.quantiser;
        for (const EncoderRow::Option& option : row.options) {
            if (option.name == nullptr) continue;
            EXPECT_TRUE(has(option.name, option.value)) << row.name << " " << option.name;
        }
    }
    EXPECT_GE(known, 2);
}

}  // namespace
}  // namespace volcast::video
