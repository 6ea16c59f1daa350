#include "server/video/encoder.h"

#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>

#include <gtest/gtest.h>
#include <png.h>
#include <turbojpeg.h>
#include <webp/decode.h>

#include "tests/unit/video/pictures.h"

namespace volcast::video {
namespace {

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

/// R, G and B alone.
std::vector<std::uint8_t> rgbOf(const Picture& picture) {
    std::vector<std::uint8_t> rgb;
    for (std::size_t i = 0; i < picture.rgba.size(); ++i) {
        if (i % 4 != 3) rgb.push_back(std::to_integer<std::uint8_t>(picture.rgba[i]));
    }
    return rgb;
}

double psnr(const Picture& a, const Picture& b) {
    return psnr(a, rgbOf(b));
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

Picture decodeWebp(std::span<const std::byte> bytes) {
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    Picture picture;
    EXPECT_NE(WebPGetInfo(data, bytes.size(), &picture.size.x, &picture.size.y), 0);
    picture = blank(picture.size);
    EXPECT_NE(
        WebPDecodeRGBAInto(data, bytes.size(), reinterpret_cast<std::uint8_t*>(picture.rgba.data()),
                           picture.rgba.size(), picture.size.x * 4),
        nullptr);
    return picture;
}

// Noise has random alpha: the colours of transparent pixels are kept, too.
TEST(WebpEncoder, IsLosslessForEverySizeAndContent) {
    for (const glm::ivec2 size : {glm::ivec2{1, 1}, {1, 17}, {31, 1}, {257, 129}, {640, 480}}) {
        for (const Picture& picture : {noise(size), drawnPicture(size), blank(size)}) {
            const auto webp = encodeWebp(picture.view());
            ASSERT_TRUE(webp.has_value()) << webp.error().message;
            const Picture decoded = decodeWebp(*webp);
            ASSERT_EQ(decoded.size, size);
            EXPECT_EQ(decoded.rgba, picture.rgba) << size.x << " x " << size.y;
        }
    }
}

TEST(WebpEncoder, RefusesASideThatTheFormatCannotHold) {
    const auto webp = encodeWebp(blank({16384, 1}).view());
    ASSERT_FALSE(webp.has_value());
    EXPECT_EQ(webp.error().code, ErrorCode::kInvalidArgument);
    EXPECT_NE(webp.error().message.find("16383"), std::string::npos) << webp.error().message;
    EXPECT_TRUE(encodeWebp(blank({16383, 1}).view()).has_value());
}

// Expected values: the algorithm of the xxHash specification (doc/xxhash_spec.md), in Python.
TEST(PixelHash, IsXxh32WithSeedZero) {
    Picture picture = blank({1, 1});
    for (std::size_t i = 0; i < 4; ++i) picture.rgba[i] = static_cast<std::byte>(i + 1);
    EXPECT_EQ(pixelHash(picture.view()), 0xFE96D19CU);
    Picture longer = blank({5, 4});
    for (std::size_t i = 0; i < 80; ++i) longer.rgba[i] = static_cast<std::byte>(i);
    EXPECT_EQ(pixelHash(longer.view()), 0x24520B4FU);
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
        const auto webp = encodeWebp(wrong);
        ASSERT_FALSE(webp.has_value()) << size.x << " x " << size.y;
        EXPECT_EQ(webp.error().code, ErrorCode::kInvalidArgument);
    }
}

}  // namespace
}  // namespace volcast::video
