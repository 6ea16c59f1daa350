#include "renderer/shading/psi_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/shading/shared.h"

namespace volcast::shading {
namespace {

// Gauss-Legendre of order 8 on [-1, 1]; M. Abramowitz, I. Stegun, table 25.4. Half of the points.
constexpr std::array kNodes{0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                            0.9602898564975363};
constexpr std::array kWeights{0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                              0.1012285362903763};

/// The light that leaves a piece from [from, to] of its length, and the far end's share of it.
struct Light {
    double all = 0.0, far = 0.0;
};

void addLight(double a, double b, double from, double to, Light& light) {
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    const auto at = [&](double s, double weight) {
        const double leaves = (a + (b - a) * s) * std::exp(-s * (a + 0.5 * (b - a) * s));
        light.all += weight * half * leaves;
        light.far += weight * half * leaves * s;
    };
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
        at(middle - half * kNodes[i], kWeights[i]);
        at(middle + half * kNodes[i], kWeights[i]);
    }
}

/// Where A(t) = a t + (b - a) t^2 / 2 is `depth`.
double placeOf(double a, double b, double depth) {
    const double root = std::sqrt(std::max(a * a + 2.0 * (b - a) * depth, 0.0));
    return std::min(2.0 * depth / (a + root), 1.0);
}

}  // namespace

double backShare(double a, double b) {
    const double m = 0.5 * (a + b);
    if (!(m > 0.0)) return 0.5;
    // Pieces grow in depth, from a 200th of what shows: exp(-40) of the light is beyond it.
    constexpr double kNothingBehind = 40.0;
    constexpr int kPieces = 14;
    Light light;
    double from = 0.0;
    for (int i = 1; i <= kPieces; ++i) {
        const double share = static_cast<double>(i) / kPieces;
        const double depth = std::min(m, kNothingBehind) * share * share;
        const double to = depth < m ? placeOf(a, b, depth) : 1.0;
        addLight(a, b, from, to, light);
        from = to;
    }
    return light.far / light.all;
}

std::vector<float> makePsiTable() {
    const double kMiddle = shared::kPsiTableMiddle;
    std::vector<float> table;
    table.reserve(static_cast<std::size_t>(kPsiTableSide) * kPsiTableSide);
    const auto share = [](int i) { return static_cast<double>(i) / (kPsiTableSide - 1); };
    for (int row = 0; row < kPsiTableSide; ++row) {
        for (int column = 0; column < kPsiTableSide; ++column) {
            // Near enough to nothing and to infinity: the entries are 1e-8 from those limits.
            const double u = std::clamp(share(column), 1e-9, 1.0 - 1e-8), v = share(row);
            const double sum = kMiddle * u / (1.0 - u), p = v * sum;
            const double a = sum - p, b = p + 0.25 * p * p;
            table.push_back(static_cast<float>(backShare(a, b) * (kMiddle + sum)));
        }
    }
    return table;
}

}  // namespace volcast::shading
