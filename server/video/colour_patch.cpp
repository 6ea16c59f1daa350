#include "server/video/colour_patch.h"

#include <array>
#include <cstdlib>
#include <string>

namespace volcast::video {

namespace {

constexpr std::size_t kSquares = std::size_t{kPatchSquares.x} * kPatchSquares.y;
using Rgb = std::array<int, 3>;
constexpr std::array<Rgb, kSquares> kColours{
    Rgb{0, 0, 0}, {255, 255, 255}, {255, 0, 0},   {0, 255, 0},  // And what real pictures have:
    {0, 0, 255},  {128, 128, 128}, {64, 160, 96}, {224, 128, 32}};

std::vector<std::byte> drawn() {
    const glm::ivec2 size = kPatchSquares * kPatchSide;
    std::vector<std::byte> rgba;
    rgba.reserve(std::size_t{4} * static_cast<std::size_t>(size.x * size.y));
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const int square = y / kPatchSide * kPatchSquares.x + x / kPatchSide;
            for (const int code : kColours[static_cast<std::size_t>(square)]) {
                rgba.push_back(static_cast<std::byte>(code));
            }
            rgba.push_back(std::byte{255});
        }
    }
    return rgba;
}

std::string text(const Rgb& rgb) {
    return "(" + std::to_string(rgb[0]) + ", " + std::to_string(rgb[1]) + ", " +
           std::to_string(rgb[2]) + ")";
}

}  // namespace

ImageView colourPatch() {
    static const std::vector<std::byte> rgba = drawn();
    return {.size = kPatchSquares * kPatchSide, .rgba = rgba};
}

Result<void> checkPatch(std::span<const std::byte> rgb) {
    if (rgb.size() != kSquares * 3) {
        return fail(ErrorCode::kInvalidArgument, "colour patch: got " + std::to_string(rgb.size()) +
                                                     " bytes, expected " +
                                                     std::to_string(kSquares * 3));
    }
    for (std::size_t square = 0; square < kSquares; ++square) {
        Rgb got{};
        bool off = false;
        for (std::size_t i = 0; i < 3; ++i) {
            got[i] = std::to_integer<int>(rgb[square * 3 + i]);
            off = off || std::abs(got[i] - kColours[square][i]) > kPatchTolerance;
        }
        if (!off) continue;
        return fail(ErrorCode::kInvalidArgument,
                    "colour patch: square " + std::to_string(square) + " is " + text(got) +
                        " instead of " + text(kColours[square]) + "; at most " +
                        std::to_string(kPatchTolerance) + " codes may be off");
    }
    return {};
}

}  // namespace volcast::video
