#include "renderer/reference/segment_weights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace volcast::reference {
namespace {

template <std::size_t N>
struct Rule {
    std::array<double, N> node, weight;  // On [0, 1].
};

/// Gauss-Legendre: nodes are the zeros of the Legendre polynomial of degree N, found by Newton's
/// method from Chebyshev's. Source: Abramowitz, Stegun, Handbook of Mathematical
/// Functions, 25.4.29.
template <std::size_t N>
Rule<N> gaussLegendre() {
    Rule<N> rule{};
    for (std::size_t i = 0; i < N; ++i) {
        double x = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) /
                            (static_cast<double>(N) + 0.5));
        double slope = 1.0;
        for (int step = 0; step < 8; ++step) {  // Quadratic from a start good to 1e-2.
            double before = 1.0, at = x;
            for (std::size_t k = 2; k <= N; ++k) {
                const auto order = static_cast<double>(k);
                const double next = ((2.0 * order - 1.0) * x * at - (order - 1.0) * before) / order;
                before = at;
                at = next;
            }
            slope = static_cast<double>(N) * (x * at - before) / (x * x - 1.0);
            x -= at / slope;
        }
        rule.node[i] = 0.5 * (1.0 - x);
        rule.weight[i] = 1.0 / ((1.0 - x * x) * slope * slope);
    }
    return rule;
}

/// Integral over [begin, end] of t e(t) exp(-A(t)).
template <std::size_t N>
double panel(double a, double b, double begin, double end) {
    static const Rule<N> kRule = gaussLegendre<N>();
    double sum = 0.0;
    for (std::size_t i = 0; i < N; ++i) {
        const double t = begin + (end - begin) * kRule.node[i];
        const double extinction = a * (1.0 - t) + b * t;
        const double depth = 0.5 * t * (a + extinction);
        sum += kRule.weight[i] * t * extinction * std::exp(-depth);
    }
    return sum * (end - begin);
}

/// Where A(t) = depth.
double placeOf(double a, double b, double depth) {
    const double root = std::sqrt(std::max(a * a + 2.0 * (b - a) * depth, 0.0));
    return std::clamp(2.0 * depth / (a + root), 0.0, 1.0);
}

}  // namespace

SegmentWeights segmentWeights(double a, double b) {
    SegmentWeights weights;
    weights.depth = 0.5 * a + 0.5 * b;
    const double depth = weights.depth;
    if (!(depth > 0.0)) return weights;
    if (depth <= 1e-3) {
        weights.back = panel<4>(a, b, 0.0, 1.0);
    } else if (depth <= 1.0 / 16.0) {
        weights.back = panel<6>(a, b, 0.0, 1.0);
    } else {
        constexpr double kNothingBehind = 45.0;
        const int panels = static_cast<int>(std::ceil(std::min(depth, kNothingBehind)));
        double begin = 0.0;
        for (int i = 1; i <= panels; ++i) {
            const double end = i >= depth ? 1.0 : placeOf(a, b, i);
            weights.back += panel<10>(a, b, begin, end);
            begin = end;
        }
    }
    weights.front = -std::expm1(-depth) - weights.back;
    return weights;
}

}  // namespace volcast::reference
