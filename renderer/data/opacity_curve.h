#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace volcast::data {

/// Opacity y that is drawn over a position x.
using OpacityPoint = glm::dvec2;

/// A clamped B-spline over uniform knots, (x(u), y(u)), read as y(x): x(u) = x is solved for u.
///
/// It starts at the first point and ends at the last, and stays among the points: with x that
/// never falls, x(u) never does, and y is within the range of theirs. Degree 1 is the polyline.
/// Source: L. Piegl, W. Tiller, The NURBS Book, 1997, sections 3.2 and 5.1 (A5.1's recursion).
class OpacityCurve {
public:
    /// `points` (one at least) have finite coordinates, x never falling. The degree is `degree`
    /// (at least 1) or what so few points allow, one less than their number.
    OpacityCurve(std::vector<OpacityPoint> points, int degree);

    /// Its parts are one polynomial each; 0 where there is a single point.
    [[nodiscard]] int spans() const noexcept;
    /// Where span `span` begins, and where the one before it ends; 0 <= span <= spans().
    [[nodiscard]] OpacityPoint joint(int span) const;
    /// y at x, which lies within the span's ends.
    [[nodiscard]] double at(int span, double x) const;

private:
    /// A point and d/du there.
    struct Place {
        glm::dvec2 point;
        glm::dvec2 derivative;
    };
    [[nodiscard]] Place place(int span, double u) const;
    [[nodiscard]] double knot(int i) const;

    std::vector<OpacityPoint> points_;
    int degree_;
};

}  // namespace volcast::data
