#include "server/load/histogram.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace volcast::load {
namespace {

TEST(Histogram, QuantilesAreAtMostOneBucketAboveTheExactOnes) {
    std::mt19937 random{7};
    std::lognormal_distribution<double> draw{3.0, 2.0};
    std::vector<double> values(10'000);
    Histogram histogram;
    for (double& value : values) {
        value = std::max(draw(random), 0.001);
        histogram.add(value);
    }
    std::ranges::sort(values);
    for (const double share : {0.01, 0.5, 0.95, 0.99, 0.999, 1.0}) {
        const auto rank =
            static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size()))) - 1;
        const double exact = values[rank];
        EXPECT_GE(histogram.quantileMs(share), exact * (1 - 1e-12)) << share;
        EXPECT_LE(histogram.quantileMs(share), exact * (1 + 1.0 / 64)) << share;
    }
    EXPECT_EQ(histogram.quantileMs(1.0), values.back());
    EXPECT_EQ(histogram.count(), values.size());
}

TEST(Histogram, OfNothingIsZero) {
    const Histogram histogram;
    EXPECT_EQ(histogram.quantileMs(0.5), 0);
    EXPECT_EQ(histogram.meanMs(), 0);
    EXPECT_EQ(histogram.maxMs(), 0);
}

TEST(Histogram, ValuesBeyondItsEndsFallIntoTheLastBuckets) {
    Histogram histogram;
    histogram.add(0);
    histogram.add(1e12);
    EXPECT_LE(histogram.quantileMs(0.5), 0.0011);
    EXPECT_EQ(histogram.maxMs(), 1e12);
    EXPECT_EQ(histogram.count(), 2U);
}

TEST(Histogram, MergedIsAsIfAllHadBeenAddedToOne) {
    Histogram all, odd, even;
    for (int i = 1; i <= 1000; ++i) {
        all.add(i);
        (i % 2 == 0 ? even : odd).add(i);
    }
    odd.merge(even);
    for (const double share : {0.1, 0.5, 0.9, 1.0}) {
        EXPECT_EQ(odd.quantileMs(share), all.quantileMs(share));
    }
    EXPECT_EQ(odd.meanMs(), all.meanMs());
}

}  // namespace
}  // namespace volcast::load
