#pragma once

#include <array>
#include <memory>

extern "C" {
#include <libavcodec/avcodec.h>
}

#include "server/video/video_stream.h"

namespace volcast::video {

struct ContextDeleter {
    void operator()(AVCodecContext* context) const noexcept { avcodec_free_context(&context); }
};
using ContextPtr = std::unique_ptr<AVCodecContext, ContextDeleter>;

/// One encoder of libavcodec and how it is told to be quick and to hold nothing back.
struct EncoderRow {
    struct Option {
        const char* name = nullptr;
        const char* value = nullptr;
    };
    VideoCodec codec;
    const char* name;
    bool hardware;
    AVPixelFormat format;   ///< Of the pictures it takes; VAAPI: in its own memory, from YUV420P.
    const char* quantiser;  ///< The option that takes a constant quality.
    double best, worst;     ///< Its values for quality 100 and 0.
    std::array<Option, 8> options;
};

/// In order of preference, for each codec. Hardware comes first where it is there.
inline constexpr std::array<EncoderRow, 4> kEncoderRows{
    EncoderRow{VideoCodec::kVp9,
               "libvpx-vp9",
               false,
               AV_PIX_FMT_YUV444P,
               "crf",
               30,
               63,
               {{{"deadline", "realtime"},
                 {"cpu-used", "8"},
                 {"lag-in-frames", "0"},
                 {"auto-alt-ref", "0"}}}},
    EncoderRow{VideoCodec::kH264,
               "h264_nvenc",
               true,
               AV_PIX_FMT_YUV420P,
               "cq",
               14,
               51,
               {{{"preset", "p1"},
                 {"tune", "ull"},
                 {"zerolatency", "1"},
                 {"delay", "0"},
                 {"forced-idr", "1"},
                 {"profile", "baseline"}}}},
    EncoderRow{VideoCodec::kH264,
               "h264_vaapi",
               true,
               AV_PIX_FMT_VAAPI,
               "qp",
               14,
               51,
               {{{"rc_mode", "CQP"}, {"async_depth", "1"}, {"profile", "constrained_baseline"}}}},
    EncoderRow{VideoCodec::kH264,
               "libx264",
               false,
               AV_PIX_FMT_YUV420P,
               "crf",
               12,
               51,
               {{{"preset", "ultrafast"},
                 {"tune", "zerolatency"},
                 {"forced-idr", "1"},
                 {"profile", "baseline"}}}},
};

/// A context for pictures of `size` (of even sides where the format asks for them).
///
/// Errors: kUnsupported (libavcodec has no such encoder, or it cannot be opened here).
Result<ContextPtr> openEncoder(const EncoderRow& row, glm::ivec2 size, int quality);

/// libavcodec's words for a negative result.
std::string avError(int code);

}  // namespace volcast::video
