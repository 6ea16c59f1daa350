#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "renderer/base/result.h"

namespace volcast::shading {

/// Finds a chunk's text by its path under shaders/, such as "model/mip.glsl".
using ChunkSource = std::function<std::optional<std::string>(std::string_view path)>;

/// The chunks that are part of the program; defined by the build (embedded_chunks.cpp).
ChunkSource embeddedChunks();

/// Chunks read from a folder each time, for shader authors.
ChunkSource chunksFrom(std::string folder);

/// A generated `const`, such as {"kMaxSteps", 512}.
struct Constant {
    std::string name;
    std::variant<bool, int, float> value;
    friend bool operator==(const Constant&, const Constant&) = default;
};

/// A chunk that is no file: text made for one program.
struct TextChunk {
    std::string path;
    std::string text;
    friend bool operator==(const TextChunk&, const TextChunk&) = default;
};

/// Which chunk fills each slot; also the key of the program cache. Empty slots are left out.
struct Recipe {
    std::string evaluator;
    std::string classify;
    std::string segment;
    std::string model;
    std::vector<Constant> constants;
    std::vector<TextChunk> texts = {};  ///< Found before files of the same path.
    friend bool operator==(const Recipe&, const Recipe&) = default;
};

/// Where one emitted line came from.
struct LineOrigin {
    std::string file;
    int line = 0;  ///< From 1.
};

/// GLSL ready to compile, and the origin of each of its lines.
struct Assembled {
    std::string source;
    std::vector<LineOrigin> lines;  ///< lines[i]: origin of line i + 1.

    /// Rewrites a driver's log ("0:123(4): error...") to "model/mip.glsl:17: error...".
    [[nodiscard]] std::string translate(std::string_view driverLog) const;
};

/// Joins a recipe's chunks, each include once.
///
/// Errors: kShaderBuild (missing chunk, missing or doubled slot function, include cycle), naming
/// file and line.
Result<Assembled> assemble(const Recipe& recipe, const ChunkSource& chunks);

/// `chunks`, but `texts` first; both must outlive what is returned.
ChunkSource withTexts(const std::vector<TextChunk>& texts, const ChunkSource& chunks);

/// A single file with its includes, for passes that are not ray programs (vertex, compute).
Result<Assembled> assembleFile(const std::string& path, const std::vector<Constant>& constants,
                               const ChunkSource& chunks);

}  // namespace volcast::shading
