#include "renderer/data/value_samples.h"

#include <algorithm>

namespace volcast::data {

namespace {

constexpr std::size_t kBins = 256;

double widthOf(const Range& range) {
    return static_cast<double>(range.max) - range.min;
}

std::vector<float> percentilesOf(const std::vector<float>& ascending, const Range& range) {
    constexpr std::size_t kLast = 100;
    if (ascending.empty()) return {};
    std::vector<float> percentiles(kLast + 1);
    for (std::size_t p = 0; p <= kLast; ++p) {
        percentiles[p] = ascending[(p * (ascending.size() - 1) + kLast / 2) / kLast];
    }
    percentiles.front() = range.min;
    percentiles.back() = range.max;
    return percentiles;
}

Range usualOf(const std::vector<float>& percentiles, const Range& range) {
    constexpr double kOutliersWiden = 20.0;
    if (percentiles.empty()) return range;
    const Range inner{.min = percentiles[1], .max = percentiles[99]};
    // Where most of the data is one value, it is the rest that is worth seeing.
    const bool outliers = inner.min < inner.max && kOutliersWiden * widthOf(inner) < widthOf(range);
    return outliers ? inner : range;
}

std::vector<std::uint32_t> histogramOf(const std::vector<float>& values, const Range& range) {
    std::vector<std::uint32_t> counts(kBins, 0);
    const double width = widthOf(range);
    for (const float value : values) {
        const double t = width > 0.0 ? (static_cast<double>(value) - range.min) / width : 0.0;
        const double bin = std::clamp(std::floor(t * kBins), 0.0, static_cast<double>(kBins - 1));
        ++counts[static_cast<std::size_t>(bin)];
    }
    return counts;
}

}  // namespace

Spread spreadOf(std::vector<float> samples, const Range& range) {
    std::erase_if(samples, [](float value) { return std::isnan(value); });
    std::ranges::sort(samples);
    Spread spread;
    spread.percentiles = percentilesOf(samples, range);
    spread.usual = usualOf(spread.percentiles, range);
    spread.histogram = histogramOf(samples, spread.usual);
    return spread;
}

}  // namespace volcast::data
