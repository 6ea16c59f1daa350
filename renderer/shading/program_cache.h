#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "renderer/gpu/program.h"
#include "renderer/shading/assemble.h"

namespace volcast::shading {

/// Draws one triangle over the whole picture; for ray programs and full-screen passes.
inline constexpr const char* kFullScreenVertex = "lib/full_screen.vert.glsl";

/// Linked programs by recipe; each is built at most once. One cache a device.
class ProgramCache {
public:
    ProgramCache(gpu::Device& device, ChunkSource chunks)
        : device_{&device}, chunks_{std::move(chunks)} {}

    /// The ray program of `recipe`, whose evaluator is a fragment shader. The pointer stays good
    /// as long as the cache.
    ///
    /// Errors: kShaderBuild.
    Result<const gpu::Program*> ray(const Recipe& recipe,
                                    const std::string& vertex = kFullScreenVertex);

    /// A pass of a vertex and a fragment file; both get `constants`.
    ///
    /// Errors: kShaderBuild.
    Result<const gpu::Program*> pass(const std::string& vertex, const std::string& fragment,
                                     const std::vector<Constant>& constants = {});

    /// Errors: kShaderBuild.
    Result<const gpu::Program*> compute(const std::string& file,
                                        const std::vector<Constant>& constants = {});

    [[nodiscard]] const ChunkSource& chunks() const noexcept { return chunks_; }

private:
    Result<const gpu::Program*> keep(const std::string& key, Result<gpu::Program> program);
    Result<gpu::Program> build(const std::string& label, const std::string& vertex,
                               const std::vector<Constant>& constants, Result<Assembled> fragment);

    gpu::Device* device_;
    ChunkSource chunks_;
    std::unordered_map<std::string, std::unique_ptr<gpu::Program>> programs_;
};

}  // namespace volcast::shading
