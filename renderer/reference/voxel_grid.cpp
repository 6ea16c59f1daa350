#include "renderer/reference/voxel_grid.h"

#include <algorithm>
#include <cmath>

namespace volcast::reference {
namespace {

/// The weights of both ends of a cell along one axis, for places from t0 to t1 in it.
std::array<Bernstein, 2> linearWeights(double t0, double t1) {
    return {Bernstein{.degree = 1, .c = {1.0 - t0, 1.0 - t1}},
            Bernstein{.degree = 1, .c = {t0, t1}}};
}

/// The same of the points at -1, 0, 1 and 2 by Catmull-Rom's spline. The Bernstein coefficients of
/// a cubic over [t0, t1] are its blossom there: symmetric, linear in each of three arguments, and
/// the cubic where all are equal (L. Ramshaw, Blossoms Are Polar Forms, 1989).
std::array<Bernstein, 4> cubicWeights(double t0, double t1) {
    constexpr double kMonomials[4][4] = {{0.0, -0.5, 1.0, -0.5},
                                         {1.0, 0.0, -2.5, 1.5},
                                         {0.0, 0.5, 2.0, -1.5},
                                         {0.0, 0.0, -0.5, 0.5}};
    std::array<Bernstein, 4> weights;
    for (std::size_t k = 0; k < 4; ++k) {
        const auto blossom = [&](double x, double y, double z) {
            return kMonomials[k][0] + kMonomials[k][1] * (x + y + z) / 3.0 +
                   kMonomials[k][2] * (x * y + y * z + z * x) / 3.0 + kMonomials[k][3] * x * y * z;
        };
        weights[k].degree = 3;
        weights[k].c = {blossom(t0, t0, t0), blossom(t0, t0, t1), blossom(t0, t1, t1),
                        blossom(t1, t1, t1)};
    }
    return weights;
}

}  // namespace

glm::dvec3 VoxelGrid::gridFrom(const glm::dvec3& world) const {
    return glm::transpose(volume_->direction) * (world - volume_->origin) / volume_->spacing;
}

double VoxelGrid::voxel(glm::ivec3 at) const {
    at = glm::clamp(at, glm::ivec3(0), volume_->size - 1);
    const auto width = static_cast<std::size_t>(volume_->size.x);
    const auto height = static_cast<std::size_t>(volume_->size.y);
    return values_[at.x + width * (at.y + height * at.z)];
}

template <std::size_t N>
Bernstein VoxelGrid::weighted(const glm::ivec3& first,
                              const std::array<std::array<Bernstein, N>, 3>& weights) const {
    Bernstein sum;
    for (std::size_t k = 0; k < N; ++k) {
        Bernstein plane;
        for (std::size_t j = 0; j < N; ++j) {
            Bernstein line;
            for (std::size_t i = 0; i < N; ++i) {
                addTo(line, voxel(first + glm::ivec3(i, j, k)), weights[0][i]);
            }
            addTo(plane, 1.0, product(line, weights[1][j]));
        }
        addTo(sum, 1.0, product(plane, weights[2][k]));
    }
    return sum;
}

Bernstein VoxelGrid::between(const glm::dvec3& from, const glm::dvec3& to) const {
    const glm::dvec3 middle = 0.5 * (from + to);
    if (sampling_ == scene::Sampling::kNearest) {
        return {.degree = 0, .c = {voxel(glm::ivec3(glm::floor(middle + 0.5)))}};
    }
    const glm::ivec3 last = glm::max(volume_->size - 2, glm::ivec3(0));
    const glm::ivec3 cell = glm::clamp(glm::ivec3(glm::floor(middle)), glm::ivec3(0), last);
    const glm::dvec3 t0 = glm::clamp(from - glm::dvec3(cell), 0.0, 1.0);
    const glm::dvec3 t1 = glm::clamp(to - glm::dvec3(cell), 0.0, 1.0);
    if (sampling_ == scene::Sampling::kTricubic) {
        return weighted<4>(cell - 1, {cubicWeights(t0.x, t1.x), cubicWeights(t0.y, t1.y),
                                      cubicWeights(t0.z, t1.z)});
    }
    return weighted<2>(
        cell, {linearWeights(t0.x, t1.x), linearWeights(t0.y, t1.y), linearWeights(t0.z, t1.z)});
}

void VoxelGrid::trace(const Ray& ray, const Span& span, std::vector<double>& scratch,
                      std::vector<VoxelPiece>& pieces) const {
    pieces.clear();
    scratch.clear();
    const glm::dvec3 origin = gridFrom(ray.origin);
    const glm::dvec3 step = glm::transpose(volume_->direction) * ray.direction / volume_->spacing;
    double begin = span.begin, end = span.end;
    for (int axis = 0; axis < 3; ++axis) {
        const double high = volume_->size[axis] - 1;
        if (step[axis] == 0.0) {
            if (origin[axis] < 0.0 || origin[axis] > high) return;
            continue;
        }
        const double a = -origin[axis] / step[axis], b = (high - origin[axis]) / step[axis];
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
    }
    if (!(begin <= end)) return;
    const double shift = continuous() ? 0.0 : 0.5;
    for (int axis = 0; axis < 3; ++axis) {
        if (step[axis] == 0.0) continue;
        const double a = origin[axis] + begin * step[axis], b = origin[axis] + end * step[axis];
        for (double wall = std::floor(std::min(a, b)) + shift; wall < std::max(a, b); ++wall) {
            const double distance = (wall - origin[axis]) / step[axis];
            if (distance > begin && distance < end) scratch.push_back(distance);
        }
    }
    scratch.push_back(end);
    std::ranges::sort(scratch);
    double front = begin;
    for (const double back : scratch) {
        if (!(back > front) && end > begin) continue;
        const VoxelPiece piece{.front = front,
                               .length = back - front,
                               .f = between(origin + front * step, origin + back * step)};
        const Bounds bounds = hull(piece.f);
        if (std::isfinite(bounds.low) && std::isfinite(piece.f.mean())) pieces.push_back(piece);
        front = back;
    }
}

glm::dvec3 VoxelGrid::normalAt(const glm::dvec3& world) const {
    const glm::dvec3 at = gridFrom(world);
    const glm::dvec3 last = glm::dvec3(volume_->size) - 1.0;
    glm::dvec3 slope{0.0};
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 low = at, high = at;
        low[axis] = std::max(at[axis] - 1.0, 0.0);
        high[axis] = std::min(at[axis] + 1.0, last[axis]);
        double above = between(high, high).front(), below = between(low, low).front();
        if (std::isnan(above)) high = at, above = between(at, at).front();
        if (std::isnan(below)) low = at, below = between(at, at).front();
        const double rise = above - below;
        slope[axis] = rise / std::max(high[axis] - low[axis], 0.5) / volume_->spacing[axis];
    }
    const double size = glm::length(slope);
    if (!(size > 0.0)) return glm::dvec3{0.0};
    return volume_->direction * (slope / size);
}

}  // namespace volcast::reference
