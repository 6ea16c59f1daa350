#include "renderer/reference/surface.h"

#include <algorithm>
#include <cmath>

namespace volcast::reference {
namespace {

glm::dvec3 pointOf(const data::Mesh& mesh, int vertex) {
    return glm::dvec3{mesh.vertices[static_cast<std::size_t>(vertex)]};
}

double cosine(const glm::dvec3& a, const glm::dvec3& b) {
    const double lengths = glm::length(a) * glm::length(b);
    return lengths > 0.0 ? std::min(std::abs(glm::dot(a, b)) / lengths, 1.0) : 0.0;
}

}  // namespace

std::optional<BoundaryHit> nearestBoundary(const data::Mesh& mesh, const Ray& ray, const Span& span,
                                           const std::optional<data::Range>& interval,
                                           Scratch& scratch) {
    // Crossings by face: number 2 i is the front of piece i, 2 i + 1 its back.
    auto& faces = scratch.faces;
    faces.clear();
    for (std::size_t i = 0; i < scratch.pieces.size(); ++i) {
        faces.emplace_back(scratch.pieces[i].front.face, 2 * i);
        faces.emplace_back(scratch.pieces[i].back.face, 2 * i + 1);
    }
    std::ranges::sort(faces);
    std::optional<BoundaryHit> nearest;
    int points = 0;
    for (std::size_t i = 0; i < faces.size();) {
        std::size_t end = i + 1;
        while (end < faces.size() && faces[end].first == faces[i].first) ++end;
        const bool inside = end - i == 2 && faces[i].second % 2 != faces[i + 1].second % 2;
        for (; i < end; ++i) {
            const Piece& piece = scratch.pieces[faces[i].second / 2];
            const Crossing& at = faces[i].second % 2 == 0 ? piece.front : piece.back;
            if (inside || at.distance < span.begin || at.distance > span.end) continue;
            if (interval && (at.f < interval->min || at.f > interval->max)) continue;
            ++points;
            if (nearest && nearest->distance <= at.distance) continue;
            nearest = BoundaryHit{
                .distance = at.distance, .f = at.f, .facing = 0.0, .face = at.face, .points = 0};
        }
    }
    if (!nearest) return std::nullopt;
    nearest->points = points;
    const glm::dvec3 corner = pointOf(mesh, nearest->face[0]);
    nearest->facing = cosine(glm::cross(pointOf(mesh, nearest->face[1]) - corner,
                                        pointOf(mesh, nearest->face[2]) - corner),
                             ray.direction);
    return nearest;
}

double facingGradient(const data::Mesh& mesh, int cell, const FieldValues& f,
                      const glm::dvec3& direction) {
    const glm::ivec4& ids = mesh.cells[static_cast<std::size_t>(cell)];
    const auto value = [&](int corner) { return f.at(cell, corner, ids[corner]); };
    const glm::dvec3 base = pointOf(mesh, ids[0]);
    const glm::dvec3 u = pointOf(mesh, ids[1]) - base;
    const glm::dvec3 v = pointOf(mesh, ids[2]) - base;
    const glm::dvec3 w = pointOf(mesh, ids[3]) - base;
    // The gradient times six volumes: its direction is all that counts.
    const glm::dvec3 gradient = (value(1) - value(0)) * glm::cross(v, w) +
                                (value(2) - value(0)) * glm::cross(w, u) +
                                (value(3) - value(0)) * glm::cross(u, v);
    return cosine(gradient, direction);
}

}  // namespace volcast::reference
