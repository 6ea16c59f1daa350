#include "renderer/shading/psi_table.h"

#include <algorithm>
#include <array>
#include <cmath>

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

}  // namespace

double backShare(double a, double b) {
    const double m = 0.5 * (a + b);
    if (!(m > 0.0)) return 0.5;
    // Pieces grow from the eye on: near it a deep piece decides everything.
    constexpr int kPieces = 14;
    const double first = std::min(1.0, 1.0 / (1.0 + std::max(a, std::sqrt(b)))) / 4.0;
    const double growth = std::pow(1.0 / first, 1.0 / (kPieces - 1));
    Light light;
    double from = 0.0, to = first;
    for (int i = 0; i < kPieces; ++i) {
        if (i + 1 == kPieces) to = 1.0;
        addLight(a, b, from, to, light);
        from = to;
        to *= growth;
    }
    return light.far / light.all;
}

std::vector<float> makePsiTable() {
    std::vector<float> table;
    table.reserve(static_cast<std::size_t>(kPsiTableSide) * kPsiTableSide);
    const auto share = [](int i) { return static_cast<double>(i) / (kPsiTableSide - 1); };
    for (int row = 0; row < kPsiTableSide; ++row) {
        for (int column = 0; column < kPsiTableSide; ++column) {
            // The last column is infinitely deep; a depth that exp() still tells from that serves.
            const double u = std::min(share(column), 1.0 - 1e-4), v = share(row);
            const double root = u / (1.0 - u), m = std::max(root * root, 1e-12);
            // a : b = (1 - v)^2 : v^2 with (a + b)/2 = m.
            const double near = (1.0 - v) * (1.0 - v), far = v * v;
            const double unit = 2.0 * m / (near + far);
            table.push_back(static_cast<float>(backShare(near * unit, far * unit)));
        }
    }
    return table;
}

}  // namespace volcast::shading
