#include "server/session/video_group.h"

#include <string>
#include <utility>

namespace volcast::session {

Result<video::VideoPicture> VideoGroup::encode(const video::ImageView& image, std::uint64_t number,
                                               bool keyframe) {
    const std::lock_guard lock{mutex_};
    if (number <= encoded_) {
        return fail(ErrorCode::kTimeout, "picture " + std::to_string(number) +
                                             " of a video comes after picture " +
                                             std::to_string(encoded_));
    }
    if (!stream_) {
        auto stream = video::VideoStream::create(
            format.codec == v1::CODEC_VP9 ? video::VideoCodec::kVp9 : video::VideoCodec::kH264);
        if (!stream) return std::move(stream).error();
        stream_ = std::move(*stream);
    }
    encoded_ = number;
    return stream_->encode(image, format.quality, keyframe);
}

}  // namespace volcast::session
