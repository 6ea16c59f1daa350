#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "tests/support/render_test.h"

namespace volcast::support {

/// A renderer whose rays through voxels pass over nothing.
inline std::unique_ptr<scene::Renderer> rendererWithoutSkipping(gpu::Device& device) {
    return must(
        scene::Renderer::create(device, [](std::string_view path) -> std::optional<std::string> {
            auto text = shading::embeddedChunks()(path);
            if (path != "volume/march_ray.glsl" && path != "volume/march_adaptive.glsl")
                return text;
            const auto replace = [&](std::string_view what, std::string_view by) {
                const auto at = text->find(what);
                EXPECT_NE(at, std::string::npos) << path << " has no " << what;
                if (at != std::string::npos) text->replace(at, what.size(), by);
            };
            replace("if (kSkipBricks)", "if (false)");
            if (path == "volume/march_ray.glsl") replace("if (kByDistance) cutToShown(march);", "");
            return text;
        }));
}

}  // namespace volcast::support
