#include "renderer/data/opacity_curve.h"

#include <algorithm>
#include <array>
#include <utility>

namespace volcast::data {

namespace {

constexpr int kMostDegree = 3;
/// Halvings alone would need 53 to the last bit of u; Newton's steps make it a handful.
constexpr int kMostSteps = 60;

}  // namespace

OpacityCurve::OpacityCurve(std::vector<OpacityPoint> points, int degree)
    : points_{std::move(points)},
      degree_{std::min({degree, kMostDegree, static_cast<int>(points_.size()) - 1})} {}

int OpacityCurve::spans() const noexcept {
    return degree_ == 0 ? 0 : static_cast<int>(points_.size()) - degree_;
}

/// 0 (degree + 1 times), 1, 2 ... spans (degree + 1 times).
double OpacityCurve::knot(int i) const {
    return std::clamp(i - degree_, 0, spans());
}

OpacityCurve::Place OpacityCurve::place(int span, double u) const {
    std::array<glm::dvec2, kMostDegree + 1> d{};
    for (int j = 0; j <= degree_; ++j) {
        const auto at = static_cast<std::size_t>(j);
        d[at] = points_[static_cast<std::size_t>(span) + at];
    }
    glm::dvec2 derivative{0.0};
    for (int level = 1; level <= degree_; ++level) {
        // The last two points lie on the tangent.
        if (level == degree_) derivative = static_cast<double>(degree_) * (d[1] - d[0]);
        for (int j = 0; j <= degree_ - level; ++j) {
            const auto at = static_cast<std::size_t>(j);
            const double low = knot(span + j + level);
            const double high = knot(span + j + degree_ + 1);
            d[at] = glm::mix(d[at], d[at + 1], (u - low) / (high - low));
        }
    }
    return {.point = d[0], .derivative = derivative};
}

OpacityPoint OpacityCurve::joint(int span) const {
    if (span == 0) return points_.front();
    if (span >= spans()) return points_.back();
    return place(span, span).point;
}

double OpacityCurve::at(int span, double x) const {
    double low = span, high = span + 1;
    double u = span + 0.5;
    for (int step = 0; step < kMostSteps; ++step) {
        const Place here = place(span, u);
        if (here.point.x == x) return here.point.y;
        (here.point.x < x ? low : high) = u;
        const double newton = u + (x - here.point.x) / here.derivative.x;
        // Not so (NaN included) where the curve stands upright: then halve.
        const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
        if (next == u) return here.point.y;
        u = next;
    }
    return place(span, u).point.y;
}

}  // namespace volcast::data
