#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/data/field.h"

namespace volcast::data {

inline constexpr std::size_t kMaxSamples = std::size_t{1} << 14;

/// Calls `visit(i)` for at most kMaxSamples indices below `count`, one in each of as many equal
/// parts. Where in its part follows the golden ratio: equal steps would meet the same column of
/// every row of voxels.
template <class Visit>
void visitSamples(std::size_t count, const Visit& visit) {
    constexpr double kGoldenRatio = 0.6180339887498949;
    const std::size_t samples = std::min(count, kMaxSamples);
    const double part = static_cast<double>(count) / static_cast<double>(samples);
    for (std::size_t s = 0; s < samples; ++s) {
        const double turns = static_cast<double>(s) * kGoldenRatio;
        const double place = samples < count ? turns - std::floor(turns) : 0.0;
        visit(
            std::min(static_cast<std::size_t>((static_cast<double>(s) + place) * part), count - 1));
    }
}

/// How values are spread.
struct Spread {
    /// 0 to 100 %: that share of the samples is not above it. The first and the last are the ends
    /// of the range. Empty where there is no sample.
    std::vector<float> percentiles;
    /// Where nearly all values are, for maps that nobody has drawn yet: the range, but the 1st to
    /// the 99th percentile where these are less than a twentieth of it, so that the ends of the
    /// range are outliers.
    Range usual;
    std::vector<std::uint32_t> histogram;  ///< 256 equal bins over `usual`, outliers in the ends'.
};

/// `samples` lie in `range`; NaN is left out.
Spread spreadOf(std::vector<float> samples, const Range& range);

}  // namespace volcast::data
