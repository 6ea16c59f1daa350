#include "server/video/yuv.h"

#include <cstdlib>

#include <gtest/gtest.h>

#include "tests/unit/video/pictures.h"

namespace volcast::video {
namespace {

struct Planes {
    glm::ivec2 size, chroma;
    std::vector<std::uint8_t> y, cb, cr;
    explicit Planes(glm::ivec2 luma, int shift)
        : size{luma},
          chroma{(luma.x + shift) >> shift, (luma.y + shift) >> shift},
          y(static_cast<std::size_t>(luma.x * luma.y)),
          cb(static_cast<std::size_t>(chroma.x * chroma.y)),
          cr(cb.size()) {}
    YuvPlanes view() {
        return {.rows = {y.data(), cb.data(), cr.data()}, .strides = {size.x, chroma.x, chroma.x}};
    }
};

Picture flat(glm::ivec2 size, int r, int g, int b) {
    Picture picture = blank(size);
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
        picture.rgba[i] = static_cast<std::byte>(r);
        picture.rgba[i + 1] = static_cast<std::byte>(g);
        picture.rgba[i + 2] = static_cast<std::byte>(b);
    }
    return picture;
}

// By hand from the matrix: red has Y' 54.21, Cb -29.21, Cr 127.5 in full range.
TEST(Yuv, KnownColoursGetTheirCodesInFullRange) {
    struct Row {
        int r, g, b, y, cb, cr;
    };
    for (const Row& row : {Row{0, 0, 0, 0, 128, 128}, Row{255, 255, 255, 255, 128, 128},
                           Row{255, 0, 0, 54, 99, 255}, Row{0, 255, 0, 182, 30, 12},
                           Row{0, 0, 255, 18, 255, 116}, Row{128, 128, 128, 128, 128, 128}}) {
        Planes planes{{1, 1}, 0};
        toYuv444(flat({1, 1}, row.r, row.g, row.b).view(), YuvRange::kFull, planes.view());
        EXPECT_EQ(planes.y[0], row.y) << row.r << " " << row.g << " " << row.b;
        EXPECT_EQ(planes.cb[0], row.cb) << row.r << " " << row.g << " " << row.b;
        EXPECT_EQ(planes.cr[0], row.cr) << row.r << " " << row.g << " " << row.b;
    }
}

TEST(Yuv, BlackAndWhiteAreAt16And235InLimitedRange) {
    for (const auto& [grey, code] : {std::pair{0, 16}, {255, 235}}) {
        Planes planes{{2, 2}, 1};
        toYuv420(flat({2, 2}, grey, grey, grey).view(), YuvRange::kLimited, planes.view());
        for (const std::uint8_t y : planes.y) EXPECT_EQ(y, code);
        EXPECT_EQ(planes.cb[0], 128);
        EXPECT_EQ(planes.cr[0], 128);
    }
}

// Half a code of each component, back through the matrix: red 0.5 + 1.5748 / 2, blue
// 0.5 + 1.8556 / 2, green 0.5 + (0.1873 + 0.4681) / 2, and half a code of rounding: at most 2.
TEST(Yuv, TheWayBackIsWithinTwoCodes) {
    const Picture picture = noise({64, 64});
    Planes planes{picture.size, 0};
    toYuv444(picture.view(), YuvRange::kFull, planes.view());
    for (std::size_t i = 0; i < planes.y.size(); ++i) {
        const double y = planes.y[i], cb = planes.cb[i] - 128.0, cr = planes.cr[i] - 128.0;
        const double red = y + 1.5748 * cr, blue = y + 1.8556 * cb;
        const double green = (y - 0.2126 * red - 0.0722 * blue) / 0.7152;
        EXPECT_LE(std::abs(std::lround(red) - std::to_integer<int>(picture.rgba[4 * i])), 2);
        EXPECT_LE(std::abs(std::lround(green) - std::to_integer<int>(picture.rgba[4 * i + 1])), 2);
        EXPECT_LE(std::abs(std::lround(blue) - std::to_integer<int>(picture.rgba[4 * i + 2])), 2);
    }
}

// 3 x 1 pixels become 4 x 2: what is outside is the last pixel again.
TEST(Yuv, OddPicturesRepeatTheirLastRowAndColumn) {
    Picture picture = flat({3, 1}, 0, 0, 0);
    picture.rgba[8] = picture.rgba[9] = picture.rgba[10] = std::byte{255};
    Planes planes{{4, 2}, 1};
    toYuv420(picture.view(), YuvRange::kFull, planes.view());
    EXPECT_EQ(planes.y, (std::vector<std::uint8_t>{0, 0, 255, 255, 0, 0, 255, 255}));
}

TEST(Yuv, SubsampledChromaIsThatOfTheMean) {
    Picture picture = flat({2, 2}, 0, 0, 0);
    picture.rgba[0] = std::byte{252};  // One of four is red: the mean is (63, 0, 0).
    Planes planes{{2, 2}, 1}, mean{{2, 2}, 1};
    toYuv420(picture.view(), YuvRange::kFull, planes.view());
    toYuv420(flat({2, 2}, 63, 0, 0).view(), YuvRange::kFull, mean.view());
    EXPECT_EQ(planes.cr, mean.cr);
    EXPECT_EQ(planes.cb, mean.cb);
    EXPECT_GT(planes.cr[0], 128);
}

}  // namespace
}  // namespace volcast::video
