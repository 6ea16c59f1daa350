#pragma once

#include <span>

#include "server/video/encoder.h"

namespace volcast::video {

/// A picture of squares in known colours. What a decoder makes of it shows whether it reads matrix,
/// range and chroma as they were written, which no list of capabilities tells.
inline constexpr glm::ivec2 kPatchSquares{4, 2};
inline constexpr int kPatchSide = 32;  ///< Pixels of a square's side.
/// Most that a component may be off, in codes: video at quality 90 keeps flat squares within 4, the
/// wrong range moves black by 16 and the wrong matrix (BT.601) green by 27.
inline constexpr int kPatchTolerance = 8;

/// The patch; valid for the program's life.
ImageView colourPatch();

/// Looks at the colours at the middles of the squares, row by row, 3 bytes each.
/// Errors: kInvalidArgument naming the first square that is off, or the wrong count of bytes.
Result<void> checkPatch(std::span<const std::byte> rgb);

}  // namespace volcast::video
