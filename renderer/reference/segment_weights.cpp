#include "renderer/reference/segment_weights.h"

#include <algorithm>
#include <cmath>

#include "renderer/reference/gauss_legendre.h"

namespace volcast::reference {
namespace {

/// Integral over [begin, end] of t e(t) exp(-A(t)).
template <std::size_t N>
double panel(double a, double b, double begin, double end) {
    static const GaussRule<N> kRule = gaussLegendre<N>();
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
