#include "server/video/video_patches.h"

#include <utility>

#include "server/video/colour_patch.h"

namespace volcast::video {

namespace {

constexpr int kQuality = 90;

std::vector<VideoPatch> encodeAll() {
    std::vector<VideoPatch> patches;
    for (const VideoCodec codec : {VideoCodec::kVp9, VideoCodec::kH264}) {
        const auto stream = VideoStream::create(codec);
        if (!stream) continue;
        auto picture = (*stream)->encode(colourPatch(), kQuality);
        if (picture) patches.push_back({.codec = codec, .bytes = std::move(picture->bytes)});
    }
    return patches;
}

}  // namespace

const std::vector<VideoPatch>& videoPatches() {
    static const std::vector<VideoPatch> patches = encodeAll();
    return patches;
}

}  // namespace volcast::video
