#include "server/video/encoder.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <random>
#include <string_view>

#include <gtest/gtest.h>
#include <png.h>
#include <turbojpeg.h>

namespace volcast::video {
namespace {

struct Picture {
    glm::ivec2 size{0};
    std::vector<std::byte> rgba;
    [[nodiscard]] ImageView view() const { return {.size = size, .rgba = rgba}; }
};

Picture blank(glm::ivec2 size) {
    return {.size = size,
            .rgba = std::vector<std::byte>(std::size_t{4} * static_cast<std::size_t>(size.x) *
                                           static_cast<std::size_t>(size.y))};
}

/// Smooth shading with one-pixel coloured lines over it: what a rendered mesh looks like.
Picture drawnPicture(glm::ivec2 size) {
    Picture picture = blank(size);
    std::size_t i = 0;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
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

Picture noise(glm::ivec2 size) {
    Picture picture = blank(size);
    std::mt19937 random{7};
    for (std::byte& value : picture.rgba) value = std::byte(random() & 0xFFU);
    return picture;
}

/// Decodes with libpng, which shares no code with the encoder.
Picture decodePng(std::span<const std::byte> bytes) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_NE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()), 0)
        << image.message;
    EXPECT_EQ(image.format, static_cast<png_uint_32>(PNG_FORMAT_RGBA));
    image.format = PNG_FORMAT_RGBA;
    Picture picture = blank({static_cast<int>(image.width), static_cast<int>(image.height)});
    EXPECT_NE(png_image_finish_read(&image, nullptr, picture.rgba.data(), 0, nullptr), 0)
        << image.message;
    EXPECT_EQ(image.warning_or_error, 0U) << image.message;
    return picture;
}

struct DecodedJpeg {
    Picture picture;
    int subsampling = -1;
};

DecodedJpeg decodeJpeg(std::span<const std::byte> bytes) {
    const auto destroy = [](void* handle) { tjDestroy(handle); };
    const std::unique_ptr<void, decltype(destroy)> decoder{tjInitDecompress(), destroy};
    const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
    DecodedJpeg decoded;
    glm::ivec2 size{0};
    int colourSpace = 0;
    EXPECT_EQ(tjDecompressHeader3(decoder.get(), data, bytes.size(), &size.x, &size.y,
                                  &decoded.subsampling, &colourSpace),
              0)
        << tjGetErrorStr2(decoder.get());
    decoded.picture = blank(size);
    EXPECT_EQ(tjDecompress2(decoder.get(), data, bytes.size(),
                            reinterpret_cast<unsigned char*>(decoded.picture.rgba.data()), size.x,
                            0, size.y, TJPF_RGBA, 0),
              0)
        << tjGetErrorStr2(decoder.get());
    return decoded;
}

/// Peak signal to noise over R, G and B, in dB.
double psnr(const Picture& a, const Picture& b) {
    double squares = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) {
        if (i % 4 == 3) continue;
        const double difference = std::to_integer<int>(a.rgba[i]) - std::to_integer<int>(b.rgba[i]);
        squares += difference * difference;
        ++count;
    }
    return 10.0 * std::log10(255.0 * 255.0 * static_cast<double>(count) / squares);
}

TEST(PngEncoder, IsLosslessForEverySizeAndContent) {
    for (const glm::ivec2 size :
         {glm::ivec2{1, 1}, {1, 17}, {31, 1}, {64, 64}, {257, 129}, {640, 480}}) {
        for (const Picture& picture : {noise(size), drawnPicture(size), blank(size)}) {
            const auto png = encodePng(picture.view());
            ASSERT_TRUE(png.has_value()) << png.error().message;
            const Picture decoded = decodePng(*png);
            ASSERT_EQ(decoded.size, size);
            EXPECT_EQ(decoded.rgba, picture.rgba) << size.x << " x " << size.y;
        }
    }
}

TEST(PngEncoder, ShrinksADrawnPictureAndNeverGrowsNoiseByMuch) {
    const Picture drawn = drawnPicture({512, 512});
    EXPECT_LT(encodePng(drawn.view())->size(), drawn.rgba.size() / 2);
    const Picture random = noise({512, 512});
    EXPECT_LT(encodePng(random.view())->size(), random.rgba.size() + random.rgba.size() / 100);
}

TEST(PngEncoder, SaysThatItsColoursAreSrgb) {
    const auto png = encodePng(blank({4, 4}).view());
    const std::string_view text{reinterpret_cast<const char*>(png->data()), png->size()};
    EXPECT_NE(text.find("sRGB"), std::string_view::npos);
}

TEST(JpegEncoder, KeepsFullColourResolution) {
    const auto jpeg = encodeJpeg(drawnPicture({320, 200}).view());
    ASSERT_TRUE(jpeg.has_value()) << jpeg.error().message;
    const DecodedJpeg decoded = decodeJpeg(*jpeg);
    EXPECT_EQ(decoded.subsampling, TJSAMP_444);
    EXPECT_EQ(decoded.picture.size, glm::ivec2(320, 200));
}

TEST(JpegEncoder, IsCloseToThePictureAtTheUsualQuality) {
    const Picture picture = drawnPicture({512, 512});
    const auto jpeg = encodeJpeg(picture.view(), 90);
    EXPECT_GT(psnr(picture, decodeJpeg(*jpeg).picture), 36.0);
    EXPECT_LT(jpeg->size(), picture.rgba.size() / 8);
}

TEST(JpegEncoder, HigherQualityIsCloserAndLarger) {
    const Picture picture = drawnPicture({256, 256});
    double lastPsnr = 0.0;
    std::size_t lastSize = 0;
    for (const int quality : {30, 60, 90, 100}) {
        const auto jpeg = encodeJpeg(picture.view(), quality);
        const double thisPsnr = psnr(picture, decodeJpeg(*jpeg).picture);
        EXPECT_GT(thisPsnr, lastPsnr) << quality;
        EXPECT_GT(jpeg->size(), lastSize) << quality;
        lastPsnr = thisPsnr;
        lastSize = jpeg->size();
    }
}

TEST(JpegEncoder, DoesNotLookAtAlpha) {
    Picture picture = drawnPicture({64, 64});
    const auto opaque = encodeJpeg(picture.view());
    for (std::size_t i = 3; i < picture.rgba.size(); i += 4) picture.rgba[i] = std::byte(i);
    EXPECT_EQ(*encodeJpeg(picture.view()), *opaque);
}

TEST(JpegEncoder, RefusesAQualityThatDoesNotExist) {
    const Picture picture = blank({8, 8});
    for (const int quality : {-1, 0, 101}) {
        const auto jpeg = encodeJpeg(picture.view(), quality);
        ASSERT_FALSE(jpeg.has_value());
        EXPECT_EQ(jpeg.error().code, ErrorCode::kInvalidArgument);
    }
}

TEST(Encoders, RefuseASizeThatDisagreesWithTheBytes) {
    const Picture picture = blank({8, 8});
    for (const glm::ivec2 size :
         {glm::ivec2{0, 8}, {8, 0}, {-8, -8}, {8, 9}, {8, 7}, {64, 1 << 30}, {1 << 30, 1}}) {
        const ImageView wrong{.size = size, .rgba = picture.rgba};
        const auto png = encodePng(wrong);
        ASSERT_FALSE(png.has_value()) << size.x << " x " << size.y;
        EXPECT_EQ(png.error().code, ErrorCode::kInvalidArgument);
        const auto jpeg = encodeJpeg(wrong);
        ASSERT_FALSE(jpeg.has_value()) << size.x << " x " << size.y;
        EXPECT_EQ(jpeg.error().code, ErrorCode::kInvalidArgument);
    }
}

}  // namespace
}  // namespace volcast::video
