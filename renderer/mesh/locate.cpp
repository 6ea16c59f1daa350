#include "renderer/mesh/locate.h"

#include <algorithm>

namespace volcast::mesh {

namespace {

/// Barycentric coordinates of a point in a cell; all -1 in a cell that float32 squashed flat.
glm::dvec4 barycentric(const data::Mesh& mesh, std::size_t cell, const glm::dvec3& point) {
    const auto at = [&](int corner) {
        const auto id = static_cast<std::size_t>(mesh.cells[cell][corner]);
        return glm::dvec3{mesh.vertices[id]};
    };
    const glm::dvec3 a = at(0) - point;
    const glm::dvec3 b = at(1) - point;
    const glm::dvec3 c = at(2) - point;
    const glm::dvec3 d = at(3) - point;
    const auto volume = [](const glm::dvec3& u, const glm::dvec3& v, const glm::dvec3& w) {
        return glm::dot(u, glm::cross(v, w));
    };
    const glm::dvec4 parts{volume(b, d, c), volume(a, c, d), volume(a, d, b), volume(a, b, c)};
    const double whole = parts.x + parts.y + parts.z + parts.w;
    return whole != 0.0 ? parts / whole : glm::dvec4{-1.0};
}

double smallest(const glm::dvec4& v) {
    return std::min({v.x, v.y, v.z, v.w});
}

bool boxHolds(const data::Mesh& mesh, std::size_t cell, const glm::dvec3& point) {
    const glm::ivec4 ids = mesh.cells[cell];
    const auto at = [&](int id) -> const glm::vec3& {
        return mesh.vertices[static_cast<std::size_t>(id)];
    };
    const glm::vec3 low = glm::min(glm::min(at(ids.x), at(ids.y)), glm::min(at(ids.z), at(ids.w)));
    const glm::vec3 high = glm::max(glm::max(at(ids.x), at(ids.y)), glm::max(at(ids.z), at(ids.w)));
    return glm::all(glm::lessThanEqual(glm::dvec3{low}, point)) &&
           glm::all(glm::lessThanEqual(point, glm::dvec3{high}));
}

/// Walks towards the point through the face it is farthest behind; -1 where the way is barred.
int walkTowards(const data::Mesh& mesh, const glm::dvec3& point, int from) {
    constexpr int kMaxSteps = 1000;
    for (int step = 0; step < kMaxSteps && from >= 0; ++step) {
        const auto cell = static_cast<std::size_t>(from);
        const glm::dvec4 parts = barycentric(mesh, cell, point);
        if (smallest(parts) >= 0.0) return from;
        int worst = 0;
        for (int i = 1; i < 4; ++i) {
            if (parts[i] < parts[worst]) worst = i;
        }
        from = mesh.neighbours[cell][worst];
    }
    return -1;
}

int searchAll(const data::Mesh& mesh, const glm::dvec3& point) {
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) {
        if (boxHolds(mesh, cell, point) && smallest(barycentric(mesh, cell, point)) >= 0.0) {
            return static_cast<int>(cell);
        }
    }
    return -1;
}

}  // namespace

std::optional<Place> locate(const data::Mesh& mesh, const glm::dvec3& point, int hint) {
    int cell = walkTowards(mesh, point, hint);
    if (cell < 0) cell = searchAll(mesh, point);
    if (cell < 0) return std::nullopt;
    const auto found = static_cast<std::size_t>(cell);
    constexpr double kInside = 1e-6;  // Smallest barycentric coordinate that counts as inside.
    if (smallest(barycentric(mesh, found, point)) >= kInside) return Place{cell, point};
    glm::dvec3 centre{0.0};
    for (int i = 0; i < 4; ++i) {
        const auto id = static_cast<std::size_t>(mesh.cells[found][i]);
        centre += 0.25 * glm::dvec3{mesh.vertices[id]};
    }
    return Place{cell, glm::mix(point, centre, 4.0 * kInside)};
}

}  // namespace volcast::mesh
