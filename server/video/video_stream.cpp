#include "server/video/video_stream.h"

#include <algorithm>

#include "server/video/colour_patch.h"
#include "server/video/hardware_frames.h"
#include "server/video/image_check.h"
#include "server/video/video_encoders.h"
#include "server/video/yuv.h"

namespace volcast::video {

namespace {

struct PacketDeleter {
    void operator()(AVPacket* packet) const noexcept { av_packet_free(&packet); }
};

bool isSubsampled(const EncoderRow& row) {
    return row.format != AV_PIX_FMT_YUV444P;
}

/// Sides as the encoder takes them.
glm::ivec2 codedSize(const EncoderRow& row, glm::ivec2 size) {
    return isSubsampled(row) ? (size + 1) / 2 * 2 : size;
}

Error failAs(const EncoderRow& row, const std::string& what) {
    return fail(ErrorCode::kIo, std::string{row.name} + ": " + what);
}

}  // namespace

/// An encoder at work on pictures of one size and quality.
struct VideoStream::Encoder {
    glm::ivec2 size{0};
    int quality = 0;
    ContextPtr context;
    FramePtr frame;  ///< In the CPU's memory.
    std::unique_ptr<AVPacket, PacketDeleter> packet;

    static Result<std::unique_ptr<Encoder>> open(const EncoderRow& row, glm::ivec2 size,
                                                 int quality);
    Result<void> fill(const EncoderRow& row, const ImageView& image, bool keyframe);
    Result<VideoPicture> run(const EncoderRow& row);
};

Result<std::unique_ptr<VideoStream::Encoder>> VideoStream::Encoder::open(const EncoderRow& row,
                                                                         glm::ivec2 size,
                                                                         int quality) {
    auto context = openEncoder(row, codedSize(row, size), quality);
    if (!context) return std::move(context).error();
    auto made = std::make_unique<Encoder>();
    made->size = size;
    made->quality = quality;
    made->context = std::move(*context);
    made->frame.reset(av_frame_alloc());
    made->packet.reset(av_packet_alloc());
    if (!made->frame || !made->packet) return failAs(row, "no memory");
    AVFrame& frame = *made->frame;
    frame.format = isSubsampled(row) ? AV_PIX_FMT_YUV420P : AV_PIX_FMT_YUV444P;
    frame.width = made->context->width;
    frame.height = made->context->height;
    frame.colorspace = made->context->colorspace;
    frame.color_range = made->context->color_range;
    frame.color_primaries = made->context->color_primaries;
    frame.color_trc = made->context->color_trc;
    frame.pts = -1;
    if (const int got = av_frame_get_buffer(&frame, 0); got < 0) {
        return failAs(row, avError(got));
    }
    return made;
}

Result<void> VideoStream::Encoder::fill(const EncoderRow& row, const ImageView& image,
                                        bool keyframe) {
    // An encoder may still hold the last picture as a reference: then this one gets new memory.
    if (const int writable = av_frame_make_writable(frame.get()); writable < 0) {
        return failAs(row, avError(writable));
    }
    const YuvPlanes planes{.rows = {frame->data[0], frame->data[1], frame->data[2]},
                           .strides = {frame->linesize[0], frame->linesize[1], frame->linesize[2]}};
    if (isSubsampled(row)) {
        toYuv420(image, planes);
    } else {
        toYuv444(image, planes);
    }
    frame->pts += 1;
    frame->pict_type = keyframe ? AV_PICTURE_TYPE_I : AV_PICTURE_TYPE_NONE;
    return {};
}

Result<VideoPicture> VideoStream::Encoder::run(const EncoderRow& row) {
    AVFrame* given = frame.get();
    FramePtr onDevice;
    if (context->hw_frames_ctx != nullptr) {
        auto moved = uploaded(*context, *frame);
        if (!moved) return failAs(row, moved.error().message);
        onDevice = std::move(*moved);
        given = onDevice.get();
    }
    if (const int sent = avcodec_send_frame(context.get(), given); sent < 0) {
        return failAs(row, avError(sent));
    }
    if (const int got = avcodec_receive_packet(context.get(), packet.get()); got < 0) {
        return failAs(row, got == AVERROR(EAGAIN) ? "it held a picture back" : avError(got));
    }
    const auto* first = reinterpret_cast<const std::byte*>(packet->data);
    VideoPicture picture{.bytes = {first, first + packet->size},
                         .keyframe = (packet->flags & AV_PKT_FLAG_KEY) != 0};
    av_packet_unref(packet.get());
    return picture;
}

VideoStream::VideoStream(std::size_t row) : row_{row} {}

VideoStream::~VideoStream() = default;

Result<std::unique_ptr<VideoStream>> VideoStream::create(VideoCodec codec, std::string_view first) {
    const std::vector<EncoderFinding>& findings = videoEncoders();
    std::string tried;
    for (std::size_t row = 0; row < findings.size(); ++row) {
        if (findings[row].codec != codec) continue;
        if (first.empty() ? findings[row].used : findings[row].name == first) {
            return std::unique_ptr<VideoStream>{new VideoStream{row}};
        }
        tried += (tried.empty() ? "" : "; ") + findings[row].detail;
    }
    return fail(ErrorCode::kUnsupported, tried);
}

Result<VideoPicture> VideoStream::encode(const ImageView& image, int quality, bool keyframe) {
    if (Result<void> valid = check(image); !valid) return std::move(valid).error();
    if (quality < 1 || quality > 100) {
        return fail(ErrorCode::kInvalidArgument,
                    "video quality " + std::to_string(quality) + " is outside [1, 100]");
    }
    while (true) {
        auto picture = encodeAsItIs(image, quality, keyframe);
        if (picture || !fallBack()) return picture;
    }
}

bool VideoStream::fallBack() {
    const std::vector<EncoderFinding>& findings = videoEncoders();
    for (std::size_t row = row_ + 1; row < findings.size(); ++row) {
        if (findings[row].codec != findings[row_].codec || !findings[row].works) continue;
        row_ = row;
        return true;
    }
    return false;
}

Result<VideoPicture> VideoStream::encodeAsItIs(const ImageView& image, int quality, bool keyframe) {
    const EncoderRow& row = kEncoderRows[row_];
    if (!open_ || open_->size != image.size || open_->quality != quality) {
        open_.reset();
        auto opened = Encoder::open(row, image.size, quality);
        if (!opened) return std::move(opened).error();
        open_ = std::move(*opened);
        keyframe = true;
    }
    Result<void> filled = open_->fill(row, image, keyframe);
    Result<VideoPicture> picture =
        filled ? open_->run(row) : Result<VideoPicture>{std::move(filled).error()};
    if (!picture) open_.reset();
    return picture;
}

std::string VideoStream::encoder() const {
    return kEncoderRows[row_].name;
}

const std::vector<EncoderFinding>& videoEncoders() {
    static const std::vector<EncoderFinding> findings = findVideoEncoders();
    return findings;
}

std::vector<EncoderFinding> findVideoEncoders() {
    constexpr int kQuality = 90;
    std::vector<EncoderFinding> findings;
    for (const EncoderRow& row : kEncoderRows) {
        EncoderFinding finding{
            .codec = row.codec, .name = row.name, .hardware = row.hardware, .detail = {}};
        const ImageView patch = colourPatch();
        auto opened = VideoStream::Encoder::open(row, patch.size, kQuality);
        Result<void> ran =
            opened ? (*opened)->fill(row, patch, true) : Result<void>{opened.error()};
        if (ran) {
            if (const auto picture = (*opened)->run(row); !picture) ran = picture.error();
        }
        finding.works = ran.has_value();
        finding.used = finding.works && std::ranges::none_of(findings, [&row](const auto& before) {
                           return before.codec == row.codec && before.used;
                       });
        finding.detail = ran ? "encodes" : ran.error().message;
        findings.push_back(std::move(finding));
    }
    return findings;
}

}  // namespace volcast::video
