#include "renderer/data/value_samples.h"

#include <limits>
#include <numeric>

#include <gtest/gtest.h>

namespace volcast::data {
namespace {

/// 0, 1 ... 1000.
std::vector<float> thousand() {
    std::vector<float> values(1001);
    std::iota(values.begin(), values.end(), 0.0F);
    return values;
}

TEST(ValueSamples, PercentilesOfAnEvenSpreadAreEven) {
    const Spread spread = spreadOf(thousand(), {.min = 0.0F, .max = 1000.0F});
    ASSERT_EQ(spread.percentiles.size(), 101U);
    for (std::size_t p = 0; p <= 100; ++p) {
        EXPECT_EQ(spread.percentiles[p], static_cast<float>(10 * p));
    }
    EXPECT_EQ(spread.usual, (Range{0.0F, 1000.0F}));
}

TEST(ValueSamples, TheEndsAreThoseOfTheRangeEvenIfNoSampleMetThem) {
    const Spread spread = spreadOf({1.0F, 2.0F, 3.0F}, {.min = -5.0F, .max = 9.0F});
    EXPECT_EQ(spread.percentiles.front(), -5.0F);
    EXPECT_EQ(spread.percentiles[50], 2.0F);
    EXPECT_EQ(spread.percentiles.back(), 9.0F);
}

TEST(ValueSamples, OutliersAreNoPartOfTheUsualRange) {
    std::vector<float> values = thousand();
    values.back() = 1e6F;
    const Spread spread = spreadOf(values, {.min = 0.0F, .max = 1e6F});
    EXPECT_EQ(spread.usual, (Range{10.0F, 990.0F}));
    EXPECT_EQ(std::accumulate(spread.histogram.begin(), spread.histogram.end(), 0U), 1001U);
    // 10 to 13.83 are in the first bin, 0 to 9 beside them.
    EXPECT_EQ(spread.histogram.front(), 14U);
    EXPECT_EQ(spread.histogram.back(), 14U);
}

TEST(ValueSamples, ATwentiethIsNotYetOutliers) {
    std::vector<float> values = thousand();
    values.back() = 19000.0F;
    EXPECT_EQ(spreadOf(values, {.min = 0.0F, .max = 19000.0F}).usual, (Range{0.0F, 19000.0F}));
    EXPECT_EQ(spreadOf(values, {.min = 0.0F, .max = 20000.0F}).usual, (Range{10.0F, 990.0F}));
}

TEST(ValueSamples, EmptySpaceAroundTheDataDoesNotHideTheData) {
    std::vector<float> values(1000, 0.0F);
    values[3] = 255.0F;
    EXPECT_EQ(spreadOf(values, {.min = 0.0F, .max = 255.0F}).usual, (Range{0.0F, 255.0F}));
}

TEST(ValueSamples, NaNAndNothingAreNoValues) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Spread spread = spreadOf({nan, 2.0F, nan}, {.min = 2.0F, .max = 2.0F});
    EXPECT_EQ(spread.percentiles[50], 2.0F);
    EXPECT_EQ(std::accumulate(spread.histogram.begin(), spread.histogram.end(), 0U), 1U);
    EXPECT_TRUE(spreadOf({nan}, {.min = 0.0F, .max = 1.0F}).percentiles.empty());
    EXPECT_EQ(spreadOf({}, {.min = 0.0F, .max = 1.0F}).usual, (Range{0.0F, 1.0F}));
}

}  // namespace
}  // namespace volcast::data
