#include "server/session/client_codecs.h"

namespace volcast::session {

bool isLossless(v1::Codec codec) noexcept {
    return codec == v1::CODEC_PNG || codec == v1::CODEC_WEBP;
}

bool isVideo(v1::Codec codec) noexcept {
    return codec == v1::CODEC_VP9 || codec == v1::CODEC_H264;
}

bool ClientCodecs::has(v1::Codec codec) const noexcept {
    switch (codec) {
        case v1::CODEC_JPEG: return jpeg;
        case v1::CODEC_PNG: return png;
        case v1::CODEC_WEBP: return webp;
        case v1::CODEC_VP9: return vp9;
        case v1::CODEC_H264: return h264;
        default: return false;
    }
}

void ClientCodecs::giveUp(v1::Codec video) noexcept {
    if (video == v1::CODEC_VP9) vp9 = false;
    if (video == v1::CODEC_H264) h264 = false;
}

v1::Codec ClientCodecs::video() const noexcept {
    if (vp9) return v1::CODEC_VP9;
    return h264 ? v1::CODEC_H264 : v1::CODEC_UNSPECIFIED;
}

v1::Codec ClientCodecs::lossless(bool slowWay) const noexcept {
    if (webp && (slowWay || !png)) return v1::CODEC_WEBP;
    return png ? v1::CODEC_PNG : v1::CODEC_UNSPECIFIED;
}

}  // namespace volcast::session
