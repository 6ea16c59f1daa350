#include <fstream>
#include <iterator>

#include "renderer/shading/assemble.h"
#include "renderer/shading/embedded_chunks.h"

namespace volcast::shading {

ChunkSource embeddedChunks() {
    return [](std::string_view path) -> std::optional<std::string> {
        for (const EmbeddedChunk& chunk : embeddedChunkTable()) {
            if (chunk.path == path) return std::string{chunk.text};
        }
        return std::nullopt;
    };
}

ChunkSource chunksFrom(std::string folder) {
    return [folder = std::move(folder)](std::string_view path) -> std::optional<std::string> {
        const bool leavesFolder =
            path.starts_with('/') || path.find("..") != std::string_view::npos;
        if (leavesFolder) return std::nullopt;
        std::ifstream file{folder + "/" + std::string{path}, std::ios::binary};
        if (!file) return std::nullopt;
        return std::string{std::istreambuf_iterator<char>{file}, std::istreambuf_iterator<char>{}};
    };
}

}  // namespace volcast::shading
