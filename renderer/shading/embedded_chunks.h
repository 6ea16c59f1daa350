#pragma once

#include <span>
#include <string_view>

namespace volcast::shading {

struct EmbeddedChunk {
    std::string_view path;  ///< Under shaders/, such as "model/mip.glsl".
    std::string_view text;
};

/// All chunks of this build, sorted by path; the build makes its source from shaders/.
std::span<const EmbeddedChunk> embeddedChunkTable();

}  // namespace volcast::shading
