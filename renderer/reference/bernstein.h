#pragma once

#include <array>
#include <vector>

namespace volcast::reference {

/// A polynomial over [0, 1] by its Bernstein coefficients: it begins at the first, ends at the last
/// and stays within all of them.
///
/// Source: G. Farin, Curves and Surfaces for CAGD, 2002, chapters 4 to 6 (subdivision, degree,
/// derivative, integral).
struct Bernstein {
    static constexpr int kMaxDegree = 10;

    int degree = 0;
    std::array<double, kMaxDegree + 1> c{};

    [[nodiscard]] double front() const { return c[0]; }
    [[nodiscard]] double back() const { return c[static_cast<std::size_t>(degree)]; }
    [[nodiscard]] double at(double t) const;
    /// The part over [from, to], stretched to [0, 1].
    [[nodiscard]] Bernstein over(double from, double to) const;
    /// Its slope; of degree 0 for a constant.
    [[nodiscard]] Bernstein derivative() const;
    /// The integral from 0 on.
    [[nodiscard]] Bernstein antiderivative() const;
    /// The integral over [0, 1].
    [[nodiscard]] double mean() const;
    /// scale p + offset.
    [[nodiscard]] Bernstein linear(double scale, double offset) const;
};

/// p q; degrees add up to kMaxDegree at most.
Bernstein product(const Bernstein& p, const Bernstein& q);
/// sum += factor p, of one degree.
void addTo(Bernstein& sum, double factor, const Bernstein& p);

struct Bounds {
    double low, high;
};
/// Of the coefficients: the polynomial stays within.
Bounds hull(const Bernstein& p);
/// Of the polynomial itself.
Bounds range(const Bernstein& p);

/// Adds, in order, the places in [0, 1] at which p goes from below `level` to not below it, or
/// back. Where it does so twice within rounding it may be seen not to, and where it touches the
/// level to cross it twice.
void addCrossings(const Bernstein& p, double level, std::vector<double>& places);

}  // namespace volcast::reference
