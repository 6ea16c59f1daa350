#pragma once

#include <cstddef>

namespace volcast::user_shader {

// What keeps parsers of GLSL from running out of time or stack, checked before any of them runs.
inline constexpr std::size_t kMaxCodeBytes = 16384;
inline constexpr std::size_t kMaxWords = 2000;
inline constexpr int kMaxNesting = 48;       ///< Of brackets.
inline constexpr int kMaxArrayLength = 256;  ///< Also checked in the tree, where sizes are known.

}  // namespace volcast::user_shader
