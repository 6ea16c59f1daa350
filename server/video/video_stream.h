#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "server/video/encoder.h"

namespace volcast::video {

enum class VideoCodec {
    kVp9,   ///< Profile 1, 4:4:4, BT.709 in full range.
    kH264,  ///< Annex B, Constrained Baseline, 4:2:0, BT.709 in full range.
};

struct VideoPicture {
    std::vector<std::byte> bytes;
    bool keyframe = false;  ///< Can be decoded without the pictures before it.
};

/// What became of one encoder that this program can use.
struct EncoderFinding {
    VideoCodec codec{};
    std::string name;
    bool hardware = false;
    bool works = false;
    bool used = false;   ///< The first of its codec that works.
    std::string detail;  ///< Why it does not.
};

/// Pictures of one stream, each one right after it was given: nothing is held back, reordered or
/// dropped. Every picture but a keyframe needs all before it since the last keyframe.
///
/// The bitstream always says how its colours are meant. H.264 has even sides only: of an odd
/// picture its last row or column is there twice. Not thread-safe, but of no thread in particular.
class VideoStream {
public:
    /// `first`: the encoder to begin with, by its name in kEncoderRows; empty: the one that is used
    /// here.
    ///
    /// Errors: kUnsupported (no encoder of `codec` works here; names those that were tried).
    static Result<std::unique_ptr<VideoStream>> create(VideoCodec codec,
                                                       std::string_view first = {});
    VideoStream(const VideoStream&) = delete;
    VideoStream& operator=(const VideoStream&) = delete;
    VideoStream(VideoStream&&) = delete;
    VideoStream& operator=(VideoStream&&) = delete;
    ~VideoStream();

    /// Alpha is ignored. `quality` in [1, 100], about that of a JPEG. A keyframe is made where
    /// `keyframe` asks for it, of the first picture, and where size or quality differ from those of
    /// the picture before. An encoder that fails is left for the next one that works here: one of
    /// hardware may refuse a size, or one stream more than it has room for.
    ///
    /// Errors: kInvalidArgument (as encodeJpeg), kIo (the last encoder's words; the next picture is
    /// a keyframe).
    Result<VideoPicture> encode(const ImageView& image, int quality, bool keyframe = false);

    /// Name of the encoder in libavcodec.
    [[nodiscard]] std::string encoder() const;

private:
    struct Encoder;
    friend std::vector<EncoderFinding> findVideoEncoders();
    explicit VideoStream(std::size_t row);
    Result<VideoPicture> encodeAsItIs(const ImageView& image, int quality, bool keyframe);
    /// Takes the next encoder of the codec; false where there is none.
    bool fallBack();
    std::size_t row_;  ///< Of the table of encoders.
    std::unique_ptr<Encoder> open_;
};

/// What findVideoEncoders() found when it was first asked for in this process; streams go by it.
const std::vector<EncoderFinding>& videoEncoders();

/// Tries each encoder, in the order in which they are preferred, on a small picture.
std::vector<EncoderFinding> findVideoEncoders();

}  // namespace volcast::video
