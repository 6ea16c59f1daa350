#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/support/render_test.h"

namespace volcast::support {

/// One place in a chunk, and what is there instead.
struct ChunkEdit {
    std::string_view path, what, by;
};

/// A renderer whose shaders are others in some places, which must be there.
inline std::unique_ptr<scene::Renderer> editedRenderer(gpu::Device& device,
                                                       std::vector<ChunkEdit> edits) {
    return must(scene::Renderer::create(
        device, [edits = std::move(edits)](std::string_view path) -> std::optional<std::string> {
            auto text = shading::embeddedChunks()(path);
            for (const ChunkEdit& edit : edits) {
                if (path != edit.path) continue;
                const auto at = text->find(edit.what);
                EXPECT_NE(at, std::string::npos) << path << " has no " << edit.what;
                if (at != std::string::npos) text->replace(at, edit.what.size(), edit.by);
            }
            return text;
        }));
}

/// Its rays through voxels pass over nothing.
inline std::unique_ptr<scene::Renderer> rendererWithoutSkipping(gpu::Device& device) {
    constexpr std::string_view kNever = "if (false)";
    return editedRenderer(device, {{"volume/march_ray.glsl", "if (kSkipBricks)", kNever},
                                   {"volume/march_adaptive.glsl", "if (kSkipBricks)", kNever},
                                   {"volume/march_channels.glsl", "if (kSkipBricks)", kNever},
                                   {"volume/march_user.glsl", "if (kByDistance)", kNever},
                                   {"volume/steps.glsl", "if (kByDistance && meets)", kNever}});
}

/// It interpolates voxels by itself where the texture unit would: in the same order of sums as from
/// bricks.
inline std::unique_ptr<scene::Renderer> rendererWithoutTextureUnit(gpu::Device& device) {
    return editedRenderer(
        device,
        {{"volume/voxels.glsl", "if (kTexels == kTexture && kFilterInHardware)", "if (false)"},
         {"volume/channels.glsl", "return kFilterInHardware ?", "return false ?"}});
}

}  // namespace volcast::support
