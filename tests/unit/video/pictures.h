#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "server/video/encoder.h"

namespace volcast::video {

struct Picture {
    glm::ivec2 size{0};
    std::vector<std::byte> rgba;
    [[nodiscard]] ImageView view() const { return {.size = size, .rgba = rgba}; }
};

inline Picture blank(glm::ivec2 size) {
    return {.size = size,
            .rgba = std::vector<std::byte>(std::size_t{4} * static_cast<std::size_t>(size.x) *
                                           static_cast<std::size_t>(size.y))};
}

/// Smooth shading with one-pixel coloured lines over it: what a rendered mesh looks like. `step`
/// moves it, so that pictures of a stream differ.
inline Picture drawnPicture(glm::ivec2 size, int step = 0) {
    Picture picture = blank(size);
    std::size_t i = 0;
    for (int y = 0; y < size.y; ++y) {
        for (int column = 0; column < size.x; ++column) {
            const int x = column + 3 * step;
            const double wave = 0.5 + 0.5 * std::sin(x * 0.031) * std::cos(y * 0.027);
            const bool line = (x + 2 * y) % 97 == 0;
            picture.rgba[i++] = std::byte(line ? 250 : static_cast<int>(200 * wave));
            picture.rgba[i++] = std::byte(line ? 40 : static_cast<int>(120 * wave + 30));
            picture.rgba[i++] = std::byte(line ? 30 : static_cast<int>(255 - 200 * wave));
            picture.rgba[i++] = std::byte(255);
        }
    }
    return picture;
}

/// Every byte is random, alpha too.
inline Picture noise(glm::ivec2 size) {
    Picture picture = blank(size);
    std::mt19937 random{7};
    for (std::byte& value : picture.rgba) value = std::byte(random() & 0xFFU);
    return picture;
}

/// Peak signal to noise over R, G and B, in dB; `rgb` has 3 bytes a pixel.
inline double psnr(const Picture& picture, std::span<const std::uint8_t> rgb) {
    double squares = 0.0;
    for (std::size_t i = 0; i < rgb.size(); ++i) {
        const double difference = std::to_integer<int>(picture.rgba[i / 3 * 4 + i % 3]) - rgb[i];
        squares += difference * difference;
    }
    return 10.0 * std::log10(255.0 * 255.0 * static_cast<double>(rgb.size()) / squares);
}

}  // namespace volcast::video
