#pragma once

#include <vector>

#include "server/video/video_stream.h"

namespace volcast::video {

/// The colour patch as a keyframe of one codec.
struct VideoPatch {
    VideoCodec codec{};
    std::vector<std::byte> bytes;
};

/// One for each codec that an encoder works for here. The first call tries the encoders, which may
/// take a second; later ones cost nothing. Any thread.
const std::vector<VideoPatch>& videoPatches();

}  // namespace volcast::video
