#include "server/video/yuv.h"

#include <algorithm>

namespace volcast::video {

namespace {

constexpr int kBits = 16;
constexpr double kRed = 0.2126, kBlue = 0.0722, kGreen = 1.0 - kRed - kBlue;

/// One component: (r, g, b) . weights + offset, in units of 2^-kBits codes, half a code included.
struct Component {
    int r, g, b, offset;
    [[nodiscard]] int of(int red, int green, int blue) const {
        return std::min((r * red + g * green + b * blue + offset) >> kBits, 255);
    }
};

constexpr int fixed(double value) {
    return static_cast<int>(value * (1 << kBits) + (value < 0 ? -0.5 : 0.5));
}

constexpr Component component(double r, double g, double b, double gain, double zero) {
    return {fixed(r * gain), fixed(g * gain), fixed(b * gain), fixed(zero + 0.5)};
}

struct Matrix {
    Component y, cb, cr;
};

constexpr Matrix matrix(double lumaGain, double lumaZero, double chromaGain) {
    const double toCb = chromaGain / (2.0 * (1.0 - kBlue));
    const double toCr = chromaGain / (2.0 * (1.0 - kRed));
    return {.y = component(kRed, kGreen, kBlue, lumaGain, lumaZero),
            .cb = component(-kRed, -kGreen, 1.0 - kBlue, toCb, 128.0),
            .cr = component(1.0 - kRed, -kGreen, -kBlue, toCr, 128.0)};
}

constexpr Matrix kFullMatrix = matrix(1.0, 0.0, 1.0);
constexpr Matrix kLimitedMatrix = matrix(219.0 / 255.0, 16.0, 224.0 / 255.0);

const Matrix& matrixOf(YuvRange range) {
    return range == YuvRange::kFull ? kFullMatrix : kLimitedMatrix;
}

const std::uint8_t* rowOf(const ImageView& image, int y) {
    const auto* pixels = reinterpret_cast<const std::uint8_t*>(image.rgba.data());
    return pixels + std::size_t{4} * static_cast<std::size_t>(image.size.x) *
                        static_cast<std::size_t>(std::min(y, image.size.y - 1));
}

std::uint8_t* rowOf(const YuvPlanes& planes, std::size_t plane, int y) {
    return planes.rows[plane] + std::ptrdiff_t{planes.strides[plane]} * y;
}

}  // namespace

void toYuv444(const ImageView& image, YuvRange range, const YuvPlanes& planes) {
    const Matrix m = matrixOf(range);
    for (int y = 0; y < image.size.y; ++y) {
        const std::uint8_t* rgba = rowOf(image, y);
        std::uint8_t* const luma = rowOf(planes, 0, y);
        std::uint8_t* const cb = rowOf(planes, 1, y);
        std::uint8_t* const cr = rowOf(planes, 2, y);
        for (int x = 0; x < image.size.x; ++x, rgba += 4) {
            const int r = rgba[0], g = rgba[1], b = rgba[2];
            luma[x] = static_cast<std::uint8_t>(m.y.of(r, g, b));
            cb[x] = static_cast<std::uint8_t>(m.cb.of(r, g, b));
            cr[x] = static_cast<std::uint8_t>(m.cr.of(r, g, b));
        }
    }
}

void toYuv420(const ImageView& image, YuvRange range, const YuvPlanes& planes) {
    const Matrix m = matrixOf(range);
    const int last = image.size.x - 1;
    for (int y = 0; y < image.size.y; y += 2) {
        const std::array<const std::uint8_t*, 2> rows{rowOf(image, y), rowOf(image, y + 1)};
        std::uint8_t* const cb = rowOf(planes, 1, y / 2);
        std::uint8_t* const cr = rowOf(planes, 2, y / 2);
        for (int x = 0; x <= last; x += 2) {
            std::array<int, 3> sum{};
            for (int row = 0; row < 2; ++row) {
                std::uint8_t* const luma = rowOf(planes, 0, y + row);
                for (const int column : {x, x + 1}) {
                    const std::uint8_t* rgb = rows[static_cast<std::size_t>(row)] +
                                              std::ptrdiff_t{4} * std::min(column, last);
                    luma[column] = static_cast<std::uint8_t>(m.y.of(rgb[0], rgb[1], rgb[2]));
                    for (std::size_t i = 0; i < 3; ++i) sum[i] += rgb[i];
                }
            }
            const auto mean = [&sum](std::size_t i) { return (sum[i] + 2) / 4; };
            cb[x / 2] = static_cast<std::uint8_t>(m.cb.of(mean(0), mean(1), mean(2)));
            cr[x / 2] = static_cast<std::uint8_t>(m.cr.of(mean(0), mean(1), mean(2)));
        }
    }
}

}  // namespace volcast::video
