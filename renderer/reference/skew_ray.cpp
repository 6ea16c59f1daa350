#include "renderer/reference/skew_ray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace volcast::reference {
namespace {

/// Twice the signed area of the triangle (ray, p, q), and its sign, which is never 0.
struct EdgeSide {
    double area = 0.0;
    bool positive = true;
};

template <class Point>
EdgeSide sideOf(const Point& p, const Point& q) {
    const double left = p.x * q.y;
    const double right = p.y * q.x;
    // Rounding keeps order: where the products differ, so do the exact ones, in the same way.
    if (left != right) return {.area = left - right, .positive = left > right};
    const double leftError = std::fma(p.x, q.y, -left);
    const double rightError = std::fma(p.y, q.x, -right);
    const double area = leftError - rightError;
    if (leftError != rightError) return {.area = area, .positive = leftError > rightError};
    // (x_p + e)(y_q + e^2) - (y_p + e^2)(x_q + e) = e (y_q - y_p) + e^2 (x_p - x_q).
    if (q.y != p.y) return {.area = 0.0, .positive = q.y > p.y};
    return {.area = 0.0, .positive = p.x >= q.x};
}

bool sameSide(double a, double b, double c, double d) {
    return std::min(std::min(a, b), std::min(c, d)) > 0.0 ||
           std::max(std::max(a, b), std::max(c, d)) < 0.0;
}

int largestAxis(const glm::dvec3& v) {
    const glm::dvec3 size = glm::abs(v);
    if (size.x >= size.y && size.x >= size.z) return 0;
    return size.y >= size.z ? 1 : 2;
}

/// Mean of three numbers with weights >= 0, never outside of them.
double mean(const glm::dvec3& weights, double a, double b, double c) {
    const double sum = weights.x + weights.y + weights.z;
    const double value =
        sum > 0.0 ? (weights.x * a + weights.y * b + weights.z * c) / sum : (a + b + c) / 3.0;
    return std::clamp(value, std::min({a, b, c}), std::max({a, b, c}));
}

}  // namespace

SkewRay::SkewRay(const Ray& ray, const glm::dvec3& meshOrigin)
    : origin_{ray.origin - meshOrigin},
      direction_{ray.direction},
      x_{(largestAxis(ray.direction) + 1) % 3},
      y_{(x_ + 1) % 3},
      z_{(x_ + 2) % 3},
      shearX_{ray.direction[x_] / ray.direction[z_]},
      shearY_{ray.direction[y_] / ray.direction[z_]},
      distancePerZ_{1.0 / ray.direction[z_]} {}

SkewRay::Corner SkewRay::seen(const glm::vec3& point, int vertex, int corner) const {
    const std::array<double, 3> from{point.x - origin_.x, point.y - origin_.y, point.z - origin_.z};
    const double z = from[static_cast<std::size_t>(z_)];
    return {.x = from[static_cast<std::size_t>(x_)] - shearX_ * z,
            .y = from[static_cast<std::size_t>(y_)] - shearY_ * z,
            .z = z,
            .vertex = vertex,
            .corner = corner};
}

std::optional<Piece> SkewRay::through(const data::Mesh& mesh, int cell, const FieldValues& f,
                                      const FieldValues& g) const {
    const glm::ivec4& ids = mesh.cells[static_cast<std::size_t>(cell)];
    const glm::vec3* points = mesh.vertices.data();
    std::array<Corner, 4> at{seen(points[ids.x], ids.x, 0), seen(points[ids.y], ids.y, 1),
                             seen(points[ids.z], ids.z, 2), seen(points[ids.w], ids.w, 3)};
    // Most cells that are tried lie to one side of the ray.
    if (sameSide(at[0].x, at[1].x, at[2].x, at[3].x) ||
        sameSide(at[0].y, at[1].y, at[2].y, at[3].y)) {
        return std::nullopt;
    }
    bool turned = false;  // Whether the corners in the order of their ids make a negative cell.
    constexpr std::array<std::pair<int, int>, 5> kNetwork{{{0, 1}, {2, 3}, {0, 2}, {1, 3}, {1, 2}}};
    for (const auto& [i, j] : kNetwork) {
        if (at[i].vertex > at[j].vertex) {
            std::swap(at[i], at[j]);
            turned = !turned;
        }
    }
    std::array<std::array<EdgeSide, 4>, 4> side;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = i + 1; j < 4; ++j) side[i][j] = sideOf(at[i], at[j]);
    }
    // Faces opposite 0 to 3. Seen from outside a positive cell, ascending corners run
    // counter-clockwise in the first and third, clockwise in the others.
    constexpr std::array<std::array<std::size_t, 3>, 4> kFaces{
        {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};
    Piece piece{.front = {}, .back = {}, .cell = cell, .joined = false};
    bool entered = false, left = false;
    for (std::size_t opposite = 0; opposite < 4; ++opposite) {
        const auto [i, j, k] = kFaces[opposite];
        const bool positive = side[i][j].positive;
        if (side[j][k].positive != positive || side[i][k].positive == positive) continue;
        const bool outwards = (opposite % 2 == 0) != turned;
        const bool exits = (positive == outwards) == (distancePerZ_ > 0.0);
        Crossing& crossing = exits ? piece.back : piece.front;
        (exits ? left : entered) = true;
        const glm::dvec3 weights{std::abs(side[j][k].area), std::abs(side[i][k].area),
                                 std::abs(side[i][j].area)};
        const Corner &a = at[i], &b = at[j], &c = at[k];
        crossing.distance = mean(weights, a.z, b.z, c.z) * distancePerZ_;
        crossing.f = mean(weights, f.at(cell, a.corner, a.vertex), f.at(cell, b.corner, b.vertex),
                          f.at(cell, c.corner, c.vertex));
        crossing.g = mean(weights, g.at(cell, a.corner, a.vertex), g.at(cell, b.corner, b.vertex),
                          g.at(cell, c.corner, c.vertex));
        crossing.face = {a.vertex, b.vertex, c.vertex};
    }
    if (!entered || !left) return std::nullopt;
    return piece;
}

}  // namespace volcast::reference
