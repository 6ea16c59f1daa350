#pragma once

#include <cstddef>

#include "volcast/v1/frame.pb.h"

namespace volcast::session {

/// How a picture is compressed.
struct Format {
    v1::Codec codec = v1::CODEC_JPEG;
    int quality = 90;  ///< Of JPEG and video, 1 to 100; means nothing to lossless codecs.
    friend bool operator==(const Format&, const Format&) = default;
};

[[nodiscard]] bool isLossless(v1::Codec codec) noexcept;
[[nodiscard]] bool isVideo(v1::Codec codec) noexcept;

/// What one client can show; a video codec once its decoder gave the colour patch back.
struct ClientCodecs {
    bool jpeg = true;
    bool png = true;
    bool webp = false;
    bool vp9 = false;
    bool h264 = false;

    [[nodiscard]] bool has(v1::Codec codec) const noexcept;
    /// It gets no video of this codec from now on.
    void giveUp(v1::Codec video) noexcept;
    /// VP9 before H.264, whose colours have half the resolution; CODEC_UNSPECIFIED: none.
    [[nodiscard]] v1::Codec video() const noexcept;
    /// For exact pictures: PNG, which is encoded and decoded faster; WebP, which is smaller, where
    /// the way is slow. CODEC_UNSPECIFIED: none.
    [[nodiscard]] v1::Codec lossless(bool slowWay) const noexcept;
};

}  // namespace volcast::session
