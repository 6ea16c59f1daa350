#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace volcast::pick {

/// Where in its steps a pixel has its samples, from 0 to 1: as shaders/lib/jitter.glsl, which names
/// the source. `pixel` is counted from the upper left.
[[nodiscard]] inline double jitterOf(const glm::ivec2& pixel, std::uint32_t seed) noexcept {
    glm::uvec3 v = glm::uvec3{glm::uvec2{pixel}, seed} * 1664525U + 1013904223U;
    const auto mix = [&v] {
        v.x += v.y * v.z;
        v.y += v.z * v.x;
        v.z += v.x * v.y;
    };
    mix();
    v ^= v >> 16U;
    mix();
    return static_cast<double>(v.x >> 8U) / 16777216.0;
}

}  // namespace volcast::pick
