#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "renderer/accuracy/measurement.h"

namespace volcast::accuracy {
namespace {

using Pixel = std::pair<int, int>;

std::set<Pixel> pixelsOf(scene::PictureSize size, const Grid& grid) {
    std::set<Pixel> pixels;
    for (const glm::ivec2& pixel : gridPixels(size, grid)) {
        EXPECT_TRUE(pixels.emplace(pixel.x, pixel.y).second) << pixel.x << ", " << pixel.y;
    }
    return pixels;
}

TEST(GridPixels, AreMultiplesOfTheStepRowByRow) {
    const auto pixels = gridPixels({5, 4}, {.step = 2, .endRow = 4});
    const std::vector<glm::ivec2> expected{{0, 0}, {2, 0}, {4, 0}, {0, 2}, {2, 2}, {4, 2}};
    EXPECT_EQ(pixels, expected);
}

TEST(GridPixels, OfAFinerGridAreThoseThatTheCoarserOneLacks) {
    const scene::PictureSize size{37, 22};
    std::set<Pixel> together = pixelsOf(size, {.step = 4, .endRow = 22});
    for (const int step : {2, 1}) {
        for (const Pixel& pixel : pixelsOf(size, {.step = step, .refines = true, .endRow = 22})) {
            EXPECT_TRUE(together.insert(pixel).second) << pixel.first << ", " << pixel.second;
        }
        EXPECT_EQ(together, pixelsOf(size, {.step = step, .endRow = 22}));
    }
    EXPECT_EQ(together.size(), 37U * 22U);
}

TEST(GridPixels, OfRowsBeginAtTheFirstOfTheGridAndEndInThePicture) {
    for (const glm::ivec2& pixel : gridPixels({8, 6}, {.step = 2, .firstRow = 3, .endRow = 99})) {
        EXPECT_EQ(pixel.y, 4);
    }
    EXPECT_TRUE(
        gridPixels({1, 6}, {.step = 2, .refines = true, .firstRow = 0, .endRow = 1}).empty());
}

}  // namespace
}  // namespace volcast::accuracy
