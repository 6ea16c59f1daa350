#include "renderer/data/mesh_delaunay.h"

#include <algorithm>
#include <cmath>

namespace volcast::data {

namespace {

/// A cell relative to its first corner, in double.
struct Frame {
    glm::dvec3 origin{0.0};
    glm::dvec3 u{0.0}, v{0.0}, w{0.0};     ///< The other corners.
    glm::dvec3 vw{0.0}, wu{0.0}, uv{0.0};  ///< Cross products.
    double volume = 0.0;                   ///< Six times the cell's, signed.
};

glm::dvec3 vertexOf(const Mesh& mesh, std::int32_t id) {
    return glm::dvec3{mesh.vertices[static_cast<std::size_t>(id)]};
}

Frame frameOf(const Mesh& mesh, const glm::ivec4& cell) {
    Frame frame;
    frame.origin = vertexOf(mesh, cell.x);
    frame.u = vertexOf(mesh, cell.y) - frame.origin;
    frame.v = vertexOf(mesh, cell.z) - frame.origin;
    frame.w = vertexOf(mesh, cell.w) - frame.origin;
    frame.vw = glm::cross(frame.v, frame.w);
    frame.wu = glm::cross(frame.w, frame.u);
    frame.uv = glm::cross(frame.u, frame.v);
    frame.volume = glm::dot(frame.u, frame.vw);
    return frame;
}

/// Centre of the sphere through the corners, relative to the frame's origin; its length is R.
glm::dvec3 centreOf(const Frame& f) {
    return (glm::dot(f.u, f.u) * f.vw + glm::dot(f.v, f.v) * f.wu + glm::dot(f.w, f.w) * f.uv) /
           (2.0 * f.volume);
}

/// Power of `point` in the sphere of a cell, and what rounding of the vertices by `rounding` may
/// have added to it.
struct Power {
    double value = 0.0;
    double tolerance = 0.0;
};

Power powerOf(const Frame& f, const glm::dvec3& point, double rounding) {
    const glm::dvec3 q = point - f.origin;
    const double lu = glm::dot(q, f.vw) / f.volume;
    const double lv = glm::dot(q, f.wu) / f.volume;
    const double lw = glm::dot(q, f.uv) / f.volume;
    const double lo = 1.0 - lu - lv - lw;
    const auto squared = [](const glm::dvec3& a) { return glm::dot(a, a); };
    const double weights = 1.0 + std::abs(lo) + std::abs(lu) + std::abs(lv) + std::abs(lw);
    return {.value = -(lo * squared(q) + lu * squared(f.u - q) + lv * squared(f.v - q) +
                       lw * squared(f.w - q)),
            .tolerance = 4.0 * glm::length(centreOf(f)) * rounding * weights};
}

/// How far float32 may have moved a vertex: 2^-24 of the largest distance from the origin.
double largestRounding(const Mesh& mesh) {
    double largest = 0.0;
    for (const glm::vec3& vertex : mesh.vertices) {
        largest = std::max(largest, glm::length(glm::dvec3{vertex}));
    }
    return std::ldexp(largest, -24);
}

/// The vertex of cell `other` that is not in `cell`, its neighbour across the face opposite
/// `corner`: three of the ids occur in both and cancel out.
std::int32_t vertexAcross(const glm::ivec4& cell, int corner, const glm::ivec4& other) {
    return other.x ^ other.y ^ other.z ^ other.w ^ cell.x ^ cell.y ^ cell.z ^ cell.w ^ cell[corner];
}

}  // namespace

DelaunayFaces countDelaunayFaces(const Mesh& mesh) {
    const double rounding = largestRounding(mesh);
    DelaunayFaces count;
    for (std::size_t t = 0; t < mesh.cells.size(); ++t) {
        const Frame frame = frameOf(mesh, mesh.cells[t]);
        if (!(frame.volume > 0.0)) {
            ++count.cellsFlat;
            continue;
        }
        for (int i = 0; i < 4; ++i) {
            const std::int32_t other = mesh.neighbours[t][i];
            if (other < static_cast<std::int32_t>(t)) continue;  // Also where there is none.
            const std::int32_t across =
                vertexAcross(mesh.cells[t], i, mesh.cells[static_cast<std::size_t>(other)]);
            const Power power = powerOf(frame, vertexOf(mesh, across), rounding);
            // Written so that NaN counts as violated.
            if (!(power.value >= -power.tolerance)) {
                ++count.violated;
            } else if (power.value <= power.tolerance) {
                ++count.tied;
            }
        }
    }
    return count;
}

bool isDelaunay(const Mesh& mesh) {
    const DelaunayFaces count = countDelaunayFaces(mesh);
    return count.violated == 0 && count.cellsFlat == 0;
}

std::vector<glm::dvec4> powerSpheres(const Mesh& mesh) {
    std::vector<glm::dvec4> spheres;
    spheres.reserve(mesh.cells.size());
    for (const glm::ivec4& cell : mesh.cells) {
        const Frame frame = frameOf(mesh, cell);
        const glm::dvec3 centre = centreOf(frame);
        const double squared = glm::dot(centre, centre);
        if (frame.volume > 0.0 && std::isfinite(squared)) {
            spheres.emplace_back(frame.origin + centre, squared);
        } else {
            spheres.emplace_back(frame.origin + 0.25 * (frame.u + frame.v + frame.w), 0.0);
        }
    }
    return spheres;
}

}  // namespace volcast::data
