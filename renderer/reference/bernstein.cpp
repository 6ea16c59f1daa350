#include "renderer/reference/bernstein.h"

#include <algorithm>
#include <cassert>

namespace volcast::reference {
namespace {

using Index = std::size_t;

constexpr auto kBinomials = [] {
    std::array<std::array<double, Bernstein::kMaxDegree + 1>, Bernstein::kMaxDegree + 1> table{};
    for (Index n = 0; n < table.size(); ++n) {
        table[n][0] = table[n][n] = 1.0;
        for (Index k = 1; k < n; ++k) table[n][k] = table[n - 1][k - 1] + table[n - 1][k];
    }
    return table;
}();

struct Halves {
    Bernstein front, back;
};

/// De Casteljau's triangle: its sides are the parts before and after t.
Halves splitAt(const Bernstein& p, double t) {
    Halves halves{p, p};
    const auto n = static_cast<Index>(p.degree);
    auto& c = halves.back.c;
    for (Index k = 1; k <= n; ++k) {
        for (Index i = 0; i + k <= n; ++i) c[i] = (1.0 - t) * c[i] + t * c[i + 1];
        halves.front.c[k] = c[0];
    }
    return halves;
}

/// How often neighbours among the coefficients lie on different sides of 0: by Descartes' rule no
/// less than the polynomial does, and as often but for an even number.
int signChanges(const Bernstein& p) {
    int changes = 0;
    for (Index i = 1; i <= static_cast<Index>(p.degree); ++i) {
        changes += (p.c[i - 1] < 0.0) != (p.c[i] < 0.0) ? 1 : 0;
    }
    return changes;
}

/// Adds crossings of 0 by p, which is the part over [from, to] of what was asked for.
void search(const Bernstein& p, double from, double to, int depth, std::vector<double>& places) {
    constexpr int kDeepest = 50;
    const int changes = signChanges(p);
    if (changes == 0) return;
    if (depth == kDeepest) {
        if ((p.front() < 0.0) != (p.back() < 0.0)) places.push_back(from);
        return;
    }
    const double middle = 0.5 * (from + to);
    if (changes > 1) {
        const Halves halves = splitAt(p, 0.5);
        search(halves.front, from, middle, depth + 1, places);
        search(halves.back, middle, to, depth + 1, places);
        return;
    }
    double low = 0.0, high = 1.0;
    const bool startsBelow = p.front() < 0.0;
    for (int i = depth; i < kDeepest; ++i) {
        const double half = 0.5 * (low + high);
        ((p.at(half) < 0.0) == startsBelow ? low : high) = half;
    }
    places.push_back(from + (to - from) * 0.5 * (low + high));
}

}  // namespace

double Bernstein::at(double t) const {
    auto rest = c;
    for (auto last = static_cast<Index>(degree); last > 0; --last) {
        for (Index i = 0; i < last; ++i) rest[i] = (1.0 - t) * rest[i] + t * rest[i + 1];
    }
    return rest[0];
}

Bernstein Bernstein::over(double from, double to) const {
    Bernstein part = to < 1.0 ? splitAt(*this, to).front : *this;
    if (from > 0.0) part = splitAt(part, from / to).back;
    return part;
}

Bernstein Bernstein::derivative() const {
    Bernstein slope;
    slope.degree = std::max(degree - 1, 0);
    for (Index i = 0; i < static_cast<Index>(degree); ++i) slope.c[i] = degree * (c[i + 1] - c[i]);
    return slope;
}

Bernstein Bernstein::antiderivative() const {
    assert(degree < kMaxDegree);
    Bernstein sum;
    sum.degree = degree + 1;
    for (Index i = 0; i <= static_cast<Index>(degree); ++i) {
        sum.c[i + 1] = sum.c[i] + c[i] / sum.degree;
    }
    return sum;
}

double Bernstein::mean() const {
    double sum = 0.0;
    for (Index i = 0; i <= static_cast<Index>(degree); ++i) sum += c[i];
    return sum / (degree + 1);
}

Bernstein Bernstein::linear(double scale, double offset) const {
    Bernstein changed = *this;
    for (Index i = 0; i <= static_cast<Index>(degree); ++i) changed.c[i] = scale * c[i] + offset;
    return changed;
}

Bernstein product(const Bernstein& p, const Bernstein& q) {
    assert(p.degree + q.degree <= Bernstein::kMaxDegree);
    Bernstein result;
    const auto m = static_cast<Index>(p.degree), n = static_cast<Index>(q.degree);
    result.degree = p.degree + q.degree;
    for (Index i = 0; i <= m; ++i) {
        for (Index j = 0; j <= n; ++j) {
            result.c[i + j] +=
                kBinomials[m][i] * kBinomials[n][j] / kBinomials[m + n][i + j] * p.c[i] * q.c[j];
        }
    }
    return result;
}

void addTo(Bernstein& sum, double factor, const Bernstein& p) {
    sum.degree = p.degree;
    for (Index i = 0; i <= static_cast<Index>(p.degree); ++i) sum.c[i] += factor * p.c[i];
}

Bounds hull(const Bernstein& p) {
    const auto [low, high] = std::minmax_element(p.c.begin(), p.c.begin() + p.degree + 1);
    return {*low, *high};
}

Bounds range(const Bernstein& p) {
    Bounds found{std::min(p.front(), p.back()), std::max(p.front(), p.back())};
    const Bounds outer = hull(p);
    if (outer.low >= found.low && outer.high <= found.high) return found;
    std::vector<double> extremes;
    addCrossings(p.derivative(), 0.0, extremes);
    for (const double t : extremes) {
        const double value = p.at(t);
        found = {std::min(found.low, value), std::max(found.high, value)};
    }
    return found;
}

void addCrossings(const Bernstein& p, double level, std::vector<double>& places) {
    search(p.linear(1.0, -level), 0.0, 1.0, 0, places);
}

}  // namespace volcast::reference
