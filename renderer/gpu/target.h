#pragma once

#include <cstddef>
#include <span>

#include <glm/glm.hpp>

#include "renderer/base/result.h"
#include "renderer/gpu/texture2d.h"

namespace volcast::gpu {

enum class Blend {
    kNone,
    kOver,   ///< Premultiplied: source over what is there.
    kMax,    ///< The larger of both, each channel by itself.
    kMin,    ///< The smaller of both, each channel by itself.
    kAdd,    ///< The sum of both.
    kUnder,  ///< Premultiplied: source under what is there; draws come front to back.
};
enum class DepthTest {
    kNone,
    kNearest,  ///< Reversed depth (1 near, 0 far): the greater wins and is written.
};
enum class Cull { kNone, kBack, kFront };

/// All state of a pass; nothing is left from the pass before.
struct PassState {
    Blend blend = Blend::kNone;
    DepthTest depth = DepthTest::kNone;
    Cull cull = Cull::kNone;  ///< Front faces are counter-clockwise as seen in the picture.
};

/// What a pass draws into: up to four textures and a depth texture, which it does not own.
class Target {
public:
    static constexpr std::size_t kMaxColours = 4;

    /// All textures have one size and outlive the target.
    ///
    /// Errors: kUnsupported (this combination cannot be drawn into), kOutOfGpuMemory.
    static Result<Target> create(Device& device, const char* label,
                                 std::span<const Texture2D* const> colours,
                                 const Texture2D* depth = nullptr);

    Target() = default;

    /// Sets viewport and all state, and directs draws here.
    void begin(const PassState& state) const;

    void clearColour(int index, const glm::vec4& value) const;
    void clearInteger(int index, int value) const;  ///< For kR32I.
    void clearDepth(float value = 0.0F) const;      ///< 0: farthest.

    /// Reads colour 0 as 4 bytes a pixel (kRgba8 textures); row 0 is the top. Blocks.
    void readRgba8(std::span<std::byte> pixels) const;
    /// Reads colour `index` as 4 floats a pixel. Blocks.
    void readRgba32F(std::span<float> pixels, int index = 0) const;

    [[nodiscard]] glm::ivec2 size() const noexcept { return size_; }

private:
    FramebufferHandle handle_;
    glm::ivec2 size_{0};
};

}  // namespace volcast::gpu
