#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

extern "C" {
#include <libavcodec/avcodec.h>
}

namespace volcast::test {

/// A picture as libavcodec's own decoder gives it.
struct AvPicture {
    int width = 0, height = 0;
    AVColorSpace matrix = AVCOL_SPC_UNSPECIFIED;
    AVColorRange range = AVCOL_RANGE_UNSPECIFIED;
    AVColorPrimaries primaries = AVCOL_PRI_UNSPECIFIED;
    AVColorTransferCharacteristic transfer = AVCOL_TRC_UNSPECIFIED;
    int chromaShift = 0;                 ///< 0: 4:4:4, 1: 4:2:0.
    std::vector<std::uint8_t> rgb = {};  ///< By BT.709 in double precision, nearest chroma sample.
};

/// Decodes one stream by the decoder called "vp9" or "h264"; shares no code with the encoders.
class AvDecoder {
public:
    explicit AvDecoder(const char* name) {
        const AVCodec* codec = avcodec_find_decoder_by_name(name);
        context_.reset(avcodec_alloc_context3(codec));
        context_->flags |= AV_CODEC_FLAG_LOW_DELAY;
        context_->thread_count = 1;
        opened_ = avcodec_open2(context_.get(), codec, nullptr) == 0;
    }

    /// The picture of one packet; nullopt where there is none at once, or it is broken.
    std::optional<AvPicture> decode(std::span<const std::byte> bytes) {
        if (!opened_) return std::nullopt;
        std::vector<std::byte> padded{bytes.begin(), bytes.end()};
        padded.resize(bytes.size() + AV_INPUT_BUFFER_PADDING_SIZE);
        packet_->data = reinterpret_cast<std::uint8_t*>(padded.data());
        packet_->size = static_cast<int>(bytes.size());
        if (avcodec_send_packet(context_.get(), packet_.get()) != 0) return std::nullopt;
        if (avcodec_receive_frame(context_.get(), frame_.get()) != 0) return std::nullopt;
        return pictureOf(*frame_);
    }

private:
    struct Free {
        void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
        void operator()(AVFrame* frame) const { av_frame_free(&frame); }
        void operator()(AVPacket* packet) const { av_packet_free(&packet); }
    };

    static AvPicture pictureOf(const AVFrame& frame) {
        AvPicture picture{.width = frame.width,
                          .height = frame.height,
                          .matrix = frame.colorspace,
                          .range = frame.color_range,
                          .primaries = frame.color_primaries,
                          .transfer = frame.color_trc};
        picture.chromaShift =
            frame.format == AV_PIX_FMT_YUV444P || frame.format == AV_PIX_FMT_YUVJ444P ? 0 : 1;
        const bool full = frame.color_range == AVCOL_RANGE_JPEG;
        const double lumaGain = full ? 1.0 : 255.0 / 219.0, chromaGain = full ? 1.0 : 255.0 / 224.0;
        for (int y = 0; y < frame.height; ++y) {
            for (int x = 0; x < frame.width; ++x) {
                const auto sample = [&](int plane, int shift) {
                    const int at = (y >> shift) * frame.linesize[plane] + (x >> shift);
                    return static_cast<double>(frame.data[plane][at]);
                };
                const double luma = (sample(0, 0) - (full ? 0.0 : 16.0)) * lumaGain;
                const double cb = (sample(1, picture.chromaShift) - 128.0) * chromaGain;
                const double cr = (sample(2, picture.chromaShift) - 128.0) * chromaGain;
                const double red = luma + 1.5748 * cr;
                const double blue = luma + 1.8556 * cb;
                const double green = (luma - 0.2126 * red - 0.0722 * blue) / 0.7152;
                for (const double value : {red, green, blue}) {
                    picture.rgb.push_back(
                        static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L)));
                }
            }
        }
        return picture;
    }

    std::unique_ptr<AVCodecContext, Free> context_;
    std::unique_ptr<AVFrame, Free> frame_{av_frame_alloc()};
    std::unique_ptr<AVPacket, Free> packet_{av_packet_alloc()};
    bool opened_ = false;
};

}  // namespace volcast::test
