#pragma once

#include <array>
#include <cstdint>

#include "server/video/encoder.h"

namespace volcast::video {

/// Codes that black and white of a component get.
enum class YuvRange {
    kFull,     ///< Y', Cb and Cr over 0 to 255.
    kLimited,  ///< Y' over 16 to 235, Cb and Cr over 16 to 240: what H.264 decoders expect.
};

/// Y', Cb and Cr, rows from the top, `strides` bytes from row to row.
struct YuvPlanes {
    std::array<std::uint8_t*, 3> rows{};
    std::array<int, 3> strides{};
};

/// RGB as it is (sRGB-encoded) to Y'CbCr by the matrix of Recommendation ITU-R BT.709-6, section 3:
/// Y' = 0.2126 R' + 0.7152 G' + 0.0722 B', Cb = (B' - Y') / 1.8556, Cr = (R' - Y') / 1.5748, each
/// rounded to the nearest code. Alpha is ignored. The planes are as large as the picture.
void toYuv444(const ImageView& image, YuvRange range, const YuvPlanes& planes);

/// The same with Cb and Cr of the mean of each 2 x 2 pixels. Planes: the picture's size rounded up
/// to even numbers (Y') and half of that (Cb, Cr); what is outside repeats the last row and column.
void toYuv420(const ImageView& image, YuvRange range, const YuvPlanes& planes);

}  // namespace volcast::video
