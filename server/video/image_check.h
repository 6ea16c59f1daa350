#pragma once

#include "server/video/encoder.h"

namespace volcast::video {

/// Largest side that both JPEG (65,500) and one deflate buffer allow with room to spare.
inline constexpr int kMaxSide = 16384;

/// Errors: kInvalidArgument for a side outside [1, kMaxSide] or bytes that disagree with the size.
Result<void> check(const ImageView& image);

}  // namespace volcast::video
