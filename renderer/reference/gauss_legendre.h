#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace volcast::reference {

template <std::size_t N>
struct GaussRule {
    std::array<double, N> node, weight;  // On [0, 1].
};

/// Exact for polynomials of degree 2 N - 1. Nodes are the zeros of the Legendre polynomial of
/// degree N, found by Newton's method from Chebyshev's. Source: Abramowitz, Stegun, Handbook of
/// Mathematical Functions, 25.4.29.
template <std::size_t N>
GaussRule<N> gaussLegendre() {
    GaussRule<N> rule{};
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

}  // namespace volcast::reference
