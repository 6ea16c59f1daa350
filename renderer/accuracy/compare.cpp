#include "renderer/accuracy/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace volcast::accuracy {
namespace {

constexpr double kByteStep = 1.0 / 255.0;
constexpr double kWordStep = 1.0 / 65535.0;

class Sum {
public:
    void add(const glm::dvec4& off, double most) {
        squares_ += glm::dot(off, off);
        max_ = std::max(max_, most);
        if (most > kByteStep) ++over255_;
        if (most > kWordStep) ++over65535_;
        ++pixels_;
    }
    [[nodiscard]] Errors errors() const {
        if (pixels_ == 0) return {};
        const auto count = static_cast<double>(pixels_);
        return {.max = max_,
                .rms = std::sqrt(squares_ / (4.0 * count)),
                .share255 = static_cast<double>(over255_) / count,
                .share65535 = static_cast<double>(over65535_) / count,
                .pixels = pixels_};
    }

private:
    double squares_ = 0.0, max_ = 0.0;
    std::uint64_t over255_ = 0, over65535_ = 0, pixels_ = 0;
};

}  // namespace

Difference compare(const reference::Picture& truth, std::span<const glm::ivec2> pixels,
                   std::span<const float> rgba, int width) {
    Sum all;
    Sum inner;
    std::vector<float> largest;
    largest.reserve(pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const std::size_t at = 4 * (static_cast<std::size_t>(pixels[i].y) * width + pixels[i].x);
        glm::dvec4 off;
        for (int c = 0; c < 4; ++c) {
            off[c] = std::abs(static_cast<double>(rgba[at + c]) - truth.pixels[i][c]);
            if (std::isnan(off[c])) off[c] = std::numeric_limits<double>::infinity();
        }
        const double most = std::max({off.r, off.g, off.b, off.a});
        largest.push_back(static_cast<float>(most));
        all.add(off, most);
        if (truth.nearEdge[i] == 0) inner.add(off, most);
    }
    return {.all = all.errors(), .inner = inner.errors(), .off = std::move(largest)};
}

}  // namespace volcast::accuracy
