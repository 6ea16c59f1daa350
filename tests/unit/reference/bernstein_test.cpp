#include "renderer/reference/bernstein.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace volcast::reference {
namespace {

Bernstein linear(double at0, double at1) {
    return {.degree = 1, .c = {at0, at1}};
}

/// scale (t - a) (t - b) (t - c) ...
Bernstein withRoots(const std::vector<double>& roots, double scale = 1.0) {
    Bernstein p{.degree = 0, .c = {scale}};
    for (const double root : roots) p = product(p, linear(-root, 1.0 - root));
    return p;
}

TEST(BernsteinTest, IsTheProductOfItsFactors) {
    const std::vector<double> roots{-0.3, 0.11, 0.5, 0.52, 0.9, 1.7, 0.2, 0.3, 0.4};
    const Bernstein p = withRoots(roots, 3.0);
    ASSERT_EQ(p.degree, 9);
    for (const double t : {0.0, 0.07, 0.31, 0.66, 1.0}) {
        double expected = 3.0;
        for (const double root : roots) expected *= t - root;
        EXPECT_NEAR(p.at(t), expected, 1e-15);
    }
}

TEST(BernsteinTest, PartsSlopesAndIntegralsFitTogether) {
    const Bernstein p = withRoots({0.2, 0.7, -1.0, 2.0});
    const Bernstein part = p.over(0.25, 0.75);
    for (const double t : {0.0, 0.3, 1.0}) EXPECT_NEAR(part.at(t), p.at(0.25 + 0.5 * t), 1e-15);
    const Bernstein back = p.antiderivative().derivative();
    for (const double t : {0.1, 0.9}) EXPECT_NEAR(back.at(t), p.at(t), 1e-14);
    EXPECT_NEAR(p.antiderivative().back(), p.mean(), 1e-15);
    EXPECT_NEAR(linear(2.0, 4.0).mean(), 3.0, 1e-15);
}

TEST(BernsteinTest, CrossingsAreTheRootsWithin) {
    std::mt19937 random{7};
    std::uniform_real_distribution<double> place{-0.5, 1.5};
    for (int round = 0; round < 500; ++round) {
        std::vector<double> roots;
        for (int i = 0; i < 1 + round % 9; ++i) roots.push_back(place(random));
        std::ranges::sort(roots);
        std::vector<double> expected;
        bool close = false;  // Such roots depend on the last digits of the coefficients.
        for (std::size_t i = 0; i < roots.size(); ++i) {
            if (roots[i] >= 0.0 && roots[i] <= 1.0) expected.push_back(roots[i]);
            close = close || (i > 0 && roots[i] - roots[i - 1] < 0.02) ||
                    std::abs(roots[i]) < 1e-3 || std::abs(roots[i] - 1.0) < 1e-3;
        }
        if (close) continue;
        std::vector<double> found;
        addCrossings(withRoots(roots), 0.0, found);
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-7);
    }
}

TEST(BernsteinTest, ATouchIsNoCrossing) {
    std::vector<double> found;
    addCrossings(withRoots({0.5, 0.5}), 0.0, found);  // >= 0 everywhere: exact in binary.
    EXPECT_TRUE(found.empty());
    // One that rounding decides may be two crossings, sqrt(2^-53) apart.
    addCrossings(withRoots({0.5, 0.5, 0.25}), 0.0, found);
    ASSERT_EQ(found.size() % 2, 1U);
    EXPECT_NEAR(found[0], 0.25, 1e-14);
    for (std::size_t i = 1; i < found.size(); ++i) EXPECT_NEAR(found[i], 0.5, 1e-7);
}

TEST(BernsteinTest, RangesIncludeExtremesWithin) {
    const Bounds bounds = range(withRoots({0.25, 0.75}, 16.0));  // Least at 1/2: -1; 3 at the ends.
    EXPECT_NEAR(bounds.low, -1.0, 1e-14);
    EXPECT_NEAR(bounds.high, 3.0, 1e-14);
}

}  // namespace
}  // namespace volcast::reference
