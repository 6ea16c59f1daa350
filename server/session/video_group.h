#pragma once

#include <cstdint>
#include <memory>
#include <mutex>

#include "renderer/base/result.h"
#include "server/session/client_codecs.h"
#include "server/video/video_stream.h"

namespace volcast::session {

/// Pictures of one size and format as a video, for all viewers that were sent each of them.
struct VideoGroup {
    explicit VideoGroup(const Format& inFormat) : format{inFormat} {}
    const Format format;
    std::uint64_t last = 0;  ///< Number of the picture that was given to encode() last.

    /// Picture number `number`; blocks. Any thread, one at a time goes on. Errors: as VideoStream,
    /// and kTimeout where a later picture was encoded already: nobody can use this one.
    Result<video::VideoPicture> encode(const video::ImageView& image, std::uint64_t number,
                                       bool keyframe);

private:
    std::mutex mutex_;
    std::unique_ptr<video::VideoStream> stream_;
    std::uint64_t encoded_ = 0;
};

}  // namespace volcast::session
