#include "renderer/data/mesh_adjacency.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

namespace volcast::data {

namespace {

/// One side of a face; the smallest of the face's vertices is known from where it is stored.
struct HalfFace {
    std::uint64_t key = 0;  ///< The other two vertices: middle << 32 | largest.
    std::int32_t slot = 0;  ///< 4 * cell + corner opposite the face.
    bool even = false;      ///< Outward order is an even permutation of the ascending one.
};

/// Corners of face i ascending by id. Needs a < b < min(c, d).
std::array<int, 3> ascendingCorners(const glm::ivec4& cell, int i) {
    std::array<int, 3> corners{};
    int n = 0;
    for (int corner = 0; corner < 4; ++corner) {
        if (corner != i) corners[static_cast<std::size_t>(n++)] = corner;
    }
    if (cell[corners[1]] > cell[corners[2]]) std::swap(corners[1], corners[2]);
    return corners;
}

/// True where `b` is `a` turned, not mirrored; both hold the same three numbers.
bool isRotation(const std::array<int, 3>& a, const std::array<int, 3>& b) {
    const auto first = static_cast<std::size_t>(std::find(b.begin(), b.end(), a[0]) - b.begin());
    return b[(first + 1) % 3] == a[1];
}

/// Half faces grouped by their smallest vertex: those of vertex v are [starts[v], starts[v + 1]).
struct FaceTable {
    std::vector<std::uint32_t> starts;
    std::vector<HalfFace> faces;
};

FaceTable groupFaces(std::span<const glm::ivec4> cells, std::size_t vertexCount) {
    FaceTable table;
    table.starts.assign(vertexCount + 1, 0);
    // The face opposite a has b as its smallest vertex, the three others have a.
    for (const glm::ivec4& cell : cells) {
        table.starts[static_cast<std::size_t>(cell.x) + 1] += 3;
        table.starts[static_cast<std::size_t>(cell.y) + 1] += 1;
    }
    std::partial_sum(table.starts.begin(), table.starts.end(), table.starts.begin());
    std::vector<std::uint32_t> next{table.starts.begin(), table.starts.end() - 1};
    table.faces.resize(4 * cells.size());
    for (std::size_t t = 0; t < cells.size(); ++t) {
        for (int i = 0; i < 4; ++i) {
            const auto c = ascendingCorners(cells[t], i);
            const auto smallest = static_cast<std::size_t>(cells[t][c[0]]);
            table.faces[next[smallest]++] = {
                .key = static_cast<std::uint64_t>(cells[t][c[1]]) << 32 |
                       static_cast<std::uint64_t>(cells[t][c[2]]),
                .slot = static_cast<std::int32_t>(4 * t) + i,
                .even = isRotation(c, kFaceCorners[static_cast<std::size_t>(i)])};
        }
    }
    return table;
}

void matchFaces(FaceTable& table, Adjacency& adjacency) {
    const auto link = [&adjacency](const HalfFace& from, const HalfFace& to) {
        adjacency.neighbours[static_cast<std::size_t>(from.slot / 4)][from.slot % 4] = to.slot / 4;
    };
    for (std::size_t v = 0; v + 1 < table.starts.size(); ++v) {
        const auto begin = table.faces.begin() + table.starts[v];
        const auto end = table.faces.begin() + table.starts[v + 1];
        std::sort(begin, end, [](const HalfFace& a, const HalfFace& b) { return a.key < b.key; });
        for (auto first = begin; first != end;) {
            auto last = first + 1;
            while (last != end && last->key == first->key) ++last;
            if (last - first == 2 && first->even != (first + 1)->even) {
                link(*first, *(first + 1));
                link(*(first + 1), *first);
            } else if (last - first > 1) {
                ++adjacency.facesNotManifold;
            }
            first = last;
        }
    }
}

void collectBoundary(std::span<const glm::ivec4> cells, Adjacency& adjacency) {
    for (std::size_t t = 0; t < cells.size(); ++t) {
        for (int i = 0; i < 4; ++i) {
            if (adjacency.neighbours[t][i] != -1) continue;
            const auto& c = kFaceCorners[static_cast<std::size_t>(i)];
            adjacency.boundaryFaces.push_back(
                {.cell = static_cast<std::int32_t>(t),
                 .vertices = {cells[t][c[0]], cells[t][c[1]], cells[t][c[2]]}});
        }
    }
}

struct HalfEdge {
    std::uint64_t key = 0;   ///< Smaller vertex << 32 | larger.
    std::int32_t slot = 0;   ///< 3 * boundary face + edge.
    bool ascending = false;  ///< The face runs from the smaller vertex to the larger.
};

void joinBoundary(Adjacency& adjacency) {
    std::vector<HalfEdge> edges;
    edges.reserve(3 * adjacency.boundaryFaces.size());
    for (std::size_t b = 0; b < adjacency.boundaryFaces.size(); ++b) {
        const glm::ivec3& v = adjacency.boundaryFaces[b].vertices;
        for (int i = 0; i < 3; ++i) {
            const auto from = static_cast<std::uint64_t>(v[i]);
            const auto to = static_cast<std::uint64_t>(v[(i + 1) % 3]);
            edges.push_back({.key = std::min(from, to) << 32 | std::max(from, to),
                             .slot = static_cast<std::int32_t>(3 * b) + i,
                             .ascending = from < to});
        }
    }
    std::sort(edges.begin(), edges.end(),
              [](const HalfEdge& a, const HalfEdge& b) { return a.key < b.key; });
    adjacency.boundaryNeighbours.assign(adjacency.boundaryFaces.size(), glm::ivec3{-1});
    const auto link = [&adjacency](const HalfEdge& from, const HalfEdge& to) {
        adjacency.boundaryNeighbours[static_cast<std::size_t>(from.slot / 3)][from.slot % 3] =
            to.slot / 3;
    };
    for (auto first = edges.begin(); first != edges.end();) {
        auto last = first + 1;
        while (last != edges.end() && last->key == first->key) ++last;
        if (last - first == 2 && first->ascending != (first + 1)->ascending) {
            link(*first, *(first + 1));
            link(*(first + 1), *first);
        }
        first = last;
    }
}

/// Solid angle of a triangle seen from the origin, positive where it is seen from inside.
/// Source: A. Van Oosterom, J. Strackee, The Solid Angle of a Plane Triangle, 1983, equation 8.
double solidAngle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double la = glm::length(a);
    const double lb = glm::length(b);
    const double lc = glm::length(c);
    const double volume = glm::dot(a, glm::cross(b, c));
    const double denominator =
        la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    return 2.0 * std::atan2(volume, denominator);
}

/// The corner of face `b` that face `other` does not share.
std::int32_t cornerNotIn(const glm::ivec3& face, const glm::ivec3& other) {
    for (int i = 0; i < 3; ++i) {
        if (face[i] != other.x && face[i] != other.y && face[i] != other.z) return face[i];
    }
    return -1;
}

/// The mean of the boundary's vertices, each counted once a face: inside every convex body.
glm::dvec3 centreOf(std::span<const glm::dvec3> vertices, const Adjacency& adjacency) {
    glm::dvec3 sum{0.0};
    for (const BoundaryFace& face : adjacency.boundaryFaces) {
        for (int i = 0; i < 3; ++i) sum += vertices[static_cast<std::size_t>(face.vertices[i])];
    }
    return sum / (3.0 * static_cast<double>(adjacency.boundaryFaces.size()));
}

/// Distances taken for 0: what the rounding of double leaves of a flat boundary.
double flatness(std::span<const glm::dvec3> vertices, const Adjacency& adjacency) {
    double size = 0.0;
    for (const BoundaryFace& face : adjacency.boundaryFaces) {
        for (int i = 0; i < 3; ++i) {
            size =
                std::max(size, glm::length(vertices[static_cast<std::size_t>(face.vertices[i])]));
        }
    }
    return 1e-12 * size;
}

}  // namespace

Adjacency findAdjacency(std::span<const glm::ivec4> cells, std::size_t vertexCount) {
    Adjacency adjacency;
    adjacency.neighbours.assign(cells.size(), glm::ivec4{-1});
    FaceTable table = groupFaces(cells, vertexCount);
    matchFaces(table, adjacency);
    collectBoundary(cells, adjacency);
    joinBoundary(adjacency);
    return adjacency;
}

Adjacency completeAdjacency(std::span<const glm::ivec4> cells, std::vector<glm::ivec4> neighbours) {
    Adjacency adjacency;
    adjacency.neighbours = std::move(neighbours);
    collectBoundary(cells, adjacency);
    joinBoundary(adjacency);
    return adjacency;
}

bool isConvex(std::span<const glm::dvec3> vertices, const Adjacency& adjacency) {
    if (adjacency.facesNotManifold > 0 || adjacency.boundaryFaces.empty()) return false;
    const auto at = [&vertices](std::int32_t id) { return vertices[static_cast<std::size_t>(id)]; };
    const glm::dvec3 centre = centreOf(vertices, adjacency);
    const double tolerance = flatness(vertices, adjacency);
    double angle = 0.0;
    for (std::size_t b = 0; b < adjacency.boundaryFaces.size(); ++b) {
        const glm::ivec3& face = adjacency.boundaryFaces[b].vertices;
        const glm::dvec3 p = at(face.x);
        const glm::dvec3 normal = glm::cross(at(face.y) - p, at(face.z) - p);
        const double area = glm::length(normal);
        if (!(area > 0.0) || !(glm::dot(normal, p - centre) > 0.0)) return false;
        for (int i = 0; i < 3; ++i) {
            const std::int32_t other = adjacency.boundaryNeighbours[b][i];
            if (other < 0) return false;
            const auto o = static_cast<std::size_t>(other);
            const std::int32_t apex = cornerNotIn(adjacency.boundaryFaces[o].vertices, face);
            if (apex < 0 || glm::dot(normal, at(apex) - p) > tolerance * area) return false;
        }
        angle += solidAngle(p - centre, at(face.y) - centre, at(face.z) - centre);
    }
    constexpr double kWhole = 4.0 * std::numbers::pi;
    return std::abs(angle - kWhole) < 0.01;
}

}  // namespace volcast::data
