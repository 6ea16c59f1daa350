#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/base/result.h"

namespace volcast::video {

/// 8-bit RGBA, 4 bytes a pixel, rows from the top, no padding.
struct ImageView {
    glm::ivec2 size{0};
    std::span<const std::byte> rgba;
};

/// JPEG 4:4:4; alpha is ignored. Errors: kInvalidArgument (size and bytes disagree).
Result<std::vector<std::byte>> encodeJpeg(const ImageView& image, int quality = 90);

/// PNG RGBA8, Up filter, libdeflate level 1: lossless. Errors: as encodeJpeg.
Result<std::vector<std::byte>> encodePng(const ImageView& image);

/// WebP RGBA8, lossless, colours of transparent pixels included. Errors: as encodeJpeg;
/// kInvalidArgument for sides over 16383, too.
Result<std::vector<std::byte>> encodeWebp(const ImageView& image);

/// XXH32 (seed 0) of the bytes: by it a client proves that it shows these very pixels.
std::uint32_t pixelHash(const ImageView& image);

}  // namespace volcast::video
