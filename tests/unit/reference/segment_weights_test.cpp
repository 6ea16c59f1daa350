#include "renderer/reference/segment_weights.h"

#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace volcast::reference {
namespace {

/// Optical depths at both ends (float32 values) and the weights in 50-digit arithmetic.
struct WeightCase {
    const char* name;
    float a, b;
    double front, back;
};

const WeightCase kCases[] = {
    WeightCase{"zero", 0.0F, 0.0F, 0.0, 0.0},
    WeightCase{"denormal", 1.40129846e-45F, 0.0F, 4.6709948810827236e-46, 2.3354974405413618e-46},
    WeightCase{"tiny_equal", 1e-30F, 1e-30F, 5.0000000158553843e-31, 5.0000000158553843e-31},
    WeightCase{"half_ulp_equal", 2.98020773e-08F, 2.98020773e-08F, 1.4901038477198437e-8,
               1.4901038329171138e-8},
    WeightCase{"ulp_equal", 8.94041108e-08F, 8.94041108e-08F, 4.4702054058461617e-8,
               4.4702052726279172e-8},
    WeightCase{"equal_1e-4", 0.000100409081F, 0.000100409081F, 5.0202860168934593e-5,
               5.0201179922703921e-5},
    WeightCase{"equal_1e-2", 0.00999999978F, 0.00999999978F, 0.00498337480578892,
               0.004966791223749644},
    WeightCase{"equal_1", 1.0F, 1.0F, 0.36787944117144232, 0.26424111765711536},
    WeightCase{"equal_1_ulp", 1.0F, 1.00000012F, 0.36787945074411466, 0.26424113001176578},
    WeightCase{"near_equal_f", 1.06482661F, 1.06494653F, 0.38468613771764583, 0.27054690280879041},
    WeightCase{"near_equal_b", 2.1124301F, 2.11230993F, 0.58386039718227149, 0.29518863185923133},
    WeightCase{"thresh_just_out", 0.000196038513F, 0.000104880535F, 8.2821881092974848e-5,
               6.7626324306248604e-5},
    WeightCase{"thin_erf", 5.42871466e-13F, 5.49153171e-13F, 2.7248268384099887e-13,
               2.7352963463379142e-13},
    WeightCase{"thin_ratio2", 9.99999975e-05F, 0.000199999995F, 6.6663498431491115e-5,
               8.3325248342237422e-5},
    WeightCase{"front_only", 1.0F, 0.0F, 0.27522154099292367, 0.11824779929444291},
    WeightCase{"back_only", 0.0F, 1.0F, 0.1443756081078512, 0.24909373217951538},
    WeightCase{"a0_small", 0.0F, 0.000134856178F, 2.247557505131612e-5, 4.4950240822388498e-5},
    WeightCase{"b0_small", 0.000126156971F, 0.0F, 4.2051262483484332e-5, 2.1025233365358419e-5},
    WeightCase{"a0_1e6", 0.0F, 1000000.0F, 0.9987466858626845, 0.0012533141373155003},
    WeightCase{"b0_1e6", 1000000.0F, 0.0F, 0.999998999999, 1.000001000003e-6},
    WeightCase{"both_1e6", 1000000.0F, 1000000.0F, 0.999999, 1.0e-6},
    WeightCase{"ratio_1e30", 1e-30F, 1.0F, 0.1443756081078512, 0.24909373217951538},
    WeightCase{"ratio_1e30r", 1.0F, 1e-30F, 0.27522154099292367, 0.11824779929444291},
    WeightCase{"switch_m2", 2.0F, 2.0F, 0.56766764161830635, 0.29699707514508096},
    WeightCase{"switch_m2_lo", 1.99999988F, 2.0F, 0.56766762873379776, 0.29699707996297783},
    WeightCase{"worst_stable", 2.15166163F, 1.87549245F, 0.57884576808916898, 0.28764398444047483},
    WeightCase{"dawson_x3", 18.0F, 0.0F, 0.9405763231298139, 0.059300267066099416},
    WeightCase{"bl_corner", 0.00999999978F, 10000.0F, 0.98746785229858494, 0.012532147701415065},
    WeightCase{"overflow_guard", 1.00000002e+30F, 1.00000002e+30F, 1.0, 9.9999998495253401e-31},
    WeightCase{"thick_900", 900.0F, 600.0F, 0.99888847690815882, 0.0011115230918411838},
};

TEST(SegmentWeights, AreThoseOfFiftyDigits) {
    for (const WeightCase& c : kCases) {
        SCOPED_TRACE(c.name);
        const SegmentWeights weights = segmentWeights(c.a, c.b);
        // 1e-13 is promised; the cases are given to 16 digits. Denormal numbers have fewer.
        EXPECT_NEAR(weights.front, c.front, 2e-13 * c.front + 1e-300);
        EXPECT_NEAR(weights.back, c.back, 2e-13 * c.back + 1e-300);
    }
}

TEST(SegmentWeights, TakeExtinctionTimesLength) {
    // A homogeneous-looking piece over a huge length.
    const double length = 943978.812F;
    const SegmentWeights weights =
        segmentWeights(9.79094111e-05F * length, 3.73620423e-08F * length);
    EXPECT_NEAR(weights.front, 0.98905930773420228, 1e-8);  // Inputs are given to 9 digits.
    EXPECT_NEAR(weights.back, 0.010940692265797715, 1e-8);
    EXPECT_EQ(segmentWeights(0.0, 0.0).front, 0.0);
    EXPECT_EQ(segmentWeights(0.0, 0.0).back, 0.0);
}

TEST(SegmentWeights, StayWithinTheirBounds) {
    std::mt19937 random{7};
    std::uniform_real_distribution<double> exponent{-30.0, 7.0};
    for (int i = 0; i < 20000; ++i) {
        const double a = std::pow(10.0, exponent(random)), b = std::pow(10.0, exponent(random));
        const SegmentWeights weights = segmentWeights(a, b);
        const double alpha = -std::expm1(-0.5 * (a + b));
        ASSERT_GE(weights.back, 0.0) << a << ' ' << b;
        ASSERT_LE(weights.back, alpha * (2.0 / 3.0 + 1e-13)) << a << ' ' << b;
        ASSERT_NEAR(weights.front + weights.back, alpha, 1e-15 * alpha) << a << ' ' << b;
    }
}

/// The weight of colour t as the sum over two parts of a piece split at `share`.
double composed(double a, double b, double share) {
    const double middle = std::lerp(a, b, share);
    const SegmentWeights near = segmentWeights(a * share, middle * share);
    const SegmentWeights far = segmentWeights(middle * (1.0 - share), b * (1.0 - share));
    return near.back * share + std::exp(-near.depth) * (far.front * share + far.back);
}

TEST(SegmentWeights, OfAPieceAreThoseOfItsParts) {
    std::mt19937 random{8};
    std::uniform_real_distribution<double> exponent{-6.0, 6.0}, where{0.01, 0.99};
    for (int i = 0; i < 5000; ++i) {
        const double a = std::pow(10.0, exponent(random)), b = std::pow(10.0, exponent(random));
        const double share = where(random);
        const double whole = segmentWeights(a, b).back;
        // Three weights good to 1e-13 each, all terms positive, and 1e6 rounded in an exponent.
        ASSERT_NEAR(composed(a, b, share), whole, 1e-12 * whole) << a << ' ' << b << ' ' << share;
    }
}

}  // namespace
}  // namespace volcast::reference
