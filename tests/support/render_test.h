#pragma once

#include <memory>
#include <string>
#include <vector>

#include "renderer/scene/render.h"
#include "tests/support/gl_test.h"

namespace volcast::support {

/// A rendered picture; row 0 on top.
struct Drawn {
    scene::PictureSize size{0};
    std::vector<float> linear;     ///< Premultiplied RGBA, no background.
    std::vector<std::byte> bytes;  ///< sRGB over the background.
    scene::FrameInfo info;

    [[nodiscard]] glm::vec4 at(int x, int y) const {
        const float* p = &linear[(static_cast<std::size_t>(y) * size.x + x) * 4];
        return {p[0], p[1], p[2], p[3]};
    }
    [[nodiscard]] glm::ivec4 byteAt(int x, int y) const {
        const std::byte* p = &bytes[(static_cast<std::size_t>(y) * size.x + x) * 4];
        return {std::to_integer<int>(p[0]), std::to_integer<int>(p[1]), std::to_integer<int>(p[2]),
                std::to_integer<int>(p[3])};
    }
};

/// A test that draws scenes with a renderer of its own on the program's device.
class RenderTest : public GlTest {
protected:
    static Result<Drawn> tryDraw(scene::Renderer& renderer, const scene::Scene& scene,
                                 scene::PictureSize size, std::uint64_t view = 1) {
        Drawn drawn;
        drawn.size = size;
        drawn.linear.resize(static_cast<std::size_t>(size.x) * size.y * 4);
        drawn.bytes.resize(drawn.linear.size());
        Result<scene::FrameInfo> info =
            renderer.render(view, scene, size, {.rgba8 = drawn.bytes, .rgba32f = drawn.linear});
        if (!info) return info.error();
        drawn.info = std::move(*info);
        return drawn;
    }
    Drawn draw(const scene::Scene& scene, scene::PictureSize size, std::uint64_t view = 1) {
        return must(tryDraw(*renderer_, scene, size, view));
    }

    std::unique_ptr<scene::Renderer> renderer_ =
        must(scene::Renderer::create(device(), shading::embeddedChunks()));
};

}  // namespace volcast::support
