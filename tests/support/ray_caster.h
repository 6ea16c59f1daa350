#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/data/mesh.h"
#include "renderer/data/transfer_function.h"
#include "renderer/scene/camera.h"

/// Rays through meshes in double precision, by clipping them against every cell: slow, simple, and
/// without a line in common with the shaders.
namespace volcast::support {

struct CastRay {
    glm::dvec3 origin{0.0};         ///< World.
    glm::dvec3 direction{0, 0, 1};  ///< Of length 1.
};

/// The ray through the middle of pixel (x, y); y counts from the top.
inline CastRay pixelRay(const scene::Camera& camera, glm::ivec2 size, int x, int y) {
    const glm::dvec3 forward = glm::normalize(camera.center - camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
    const glm::dvec3 up = glm::cross(right, forward);
    const double across = (2.0 * (x + 0.5) - size.x) / size.y;
    const double upwards = (size.y - 2.0 * (y + 0.5)) / size.y;
    if (camera.projection == scene::Projection::kOrthographic) {
        const double half = 0.5 * camera.orthographicHeight;
        return {.origin = camera.eye + half * (across * right + upwards * up),
                .direction = forward};
    }
    const double slope = std::tan(camera.fovyDegrees * std::numbers::pi / 360.0);
    return {.origin = camera.eye,
            .direction = glm::normalize(forward + slope * (across * right + upwards * up))};
}

/// The share of one cell in a ray: distances and field values at both ends.
struct CastPiece {
    double front = 0.0, back = 0.0;
    double first = 0.0, last = 0.0;
};

/// A mesh and one step of one field, ready for rays. Keeps references.
class RayCaster {
public:
    RayCaster(const data::Mesh& mesh, const data::Field& field, std::size_t step = 0)
        : mesh_{mesh}, field_{field}, values_{field.steps.at(step)} {}

    /// All pieces beyond the ray's origin, front to back.
    [[nodiscard]] std::vector<CastPiece> pieces(const CastRay& ray) const {
        std::vector<CastPiece> found;
        for (std::size_t t = 0; t < mesh_.cells.size(); ++t) {
            if (const auto piece = clip(t, ray)) found.push_back(*piece);
        }
        std::sort(found.begin(), found.end(), [](const CastPiece& a, const CastPiece& b) {
            return a.front + a.back < b.front + b.back;
        });
        return found;
    }

private:
    [[nodiscard]] glm::dvec3 corner(std::size_t t, int i) const {
        return mesh_.origin +
               glm::dvec3{mesh_.vertices[static_cast<std::size_t>(mesh_.cells[t][i])]};
    }
    [[nodiscard]] double value(std::size_t t, int i) const {
        switch (field_.association) {
            case data::Association::kCell: return values_[t];
            case data::Association::kCellVertex:
                return values_[4 * t + static_cast<std::size_t>(i)];
            case data::Association::kVertex: break;
        }
        return values_[static_cast<std::size_t>(mesh_.cells[t][i])];
    }

    /// Barycentric coordinates are linear along the ray: each is `at` + s `slope`, and the piece is
    /// where all four are positive.
    [[nodiscard]] std::optional<CastPiece> clip(std::size_t t, const CastRay& ray) const {
        const glm::dvec3 base = corner(t, 3);
        const glm::dmat3 edges{corner(t, 0) - base, corner(t, 1) - base, corner(t, 2) - base};
        const double volume = glm::determinant(edges);
        if (volume == 0.0) return std::nullopt;
        const glm::dmat3 inverse = glm::inverse(edges);
        const glm::dvec3 at3 = inverse * (ray.origin - base);
        const glm::dvec3 slope3 = inverse * ray.direction;
        const glm::dvec4 at{at3, 1.0 - at3.x - at3.y - at3.z};
        const glm::dvec4 slope{slope3, -slope3.x - slope3.y - slope3.z};
        double front = 0.0;
        double back = std::numeric_limits<double>::infinity();
        for (int i = 0; i < 4; ++i) {
            if (slope[i] > 0.0) {
                front = std::max(front, -at[i] / slope[i]);
            } else if (slope[i] < 0.0) {
                back = std::min(back, -at[i] / slope[i]);
            } else if (at[i] < 0.0) {
                return std::nullopt;
            }
        }
        if (!(back > front)) return std::nullopt;
        CastPiece piece{.front = front, .back = back};
        for (int i = 0; i < 4; ++i) {
            piece.first += value(t, i) * (at[i] + front * slope[i]);
            piece.last += value(t, i) * (at[i] + back * slope[i]);
        }
        return piece;
    }

    const data::Mesh& mesh_;
    const data::Field& field_;
    base::Array<float> values_;
};

/// Length of a ray in the mesh, world units. A ray within shared faces is counted once by each of
/// their cells: only for rays in general position.
inline double pathLength(const std::vector<CastPiece>& pieces) {
    double sum = 0.0;
    for (const CastPiece& piece : pieces) sum += piece.back - piece.front;
    return sum;
}

/// C(max f), opaque; nothing where the ray misses.
inline glm::dvec4 castMip(const std::vector<CastPiece>& pieces, const data::TransferFunction& map) {
    if (pieces.empty()) return glm::dvec4{0.0};
    double largest = -std::numeric_limits<double>::infinity();
    for (const CastPiece& piece : pieces) {
        largest = std::max({largest, piece.first, piece.last});
    }
    const glm::vec4 matter = data::evaluate(map, static_cast<float>(largest));
    return {matter.r, matter.g, matter.b, 1.0};
}

/// Emission and absorption where the field is the mean of both ends in each piece.
inline glm::dvec4 castAverage(const std::vector<CastPiece>& pieces,
                              const data::TransferFunction& map) {
    glm::dvec3 colour{0.0};
    double depth = 0.0;
    for (const CastPiece& piece : pieces) {
        const glm::dvec4 matter{
            data::evaluate(map, static_cast<float>(0.5 * (piece.first + piece.last)))};
        const double own = matter.a * (piece.back - piece.front);
        colour += std::exp(-depth) * -std::expm1(-own) * glm::dvec3{matter};
        depth += own;
    }
    return {colour, -std::expm1(-depth)};
}

/// Emission and absorption of the field as it is: int C(f) rho(f) exp(-int rho) ds, by `slices`
/// midpoints a piece.
inline glm::dvec4 castExact(const std::vector<CastPiece>& pieces, const data::TransferFunction& map,
                            int slices = 256) {
    std::vector<CastPiece> fine;
    for (const CastPiece& piece : pieces) {
        const auto at = [&](double front, double back, int i) {
            return front + (back - front) * i / slices;
        };
        for (int i = 0; i < slices; ++i) {
            fine.push_back({.front = at(piece.front, piece.back, i),
                            .back = at(piece.front, piece.back, i + 1),
                            .first = at(piece.first, piece.last, i),
                            .last = at(piece.first, piece.last, i + 1)});
        }
    }
    return castAverage(fine, map);
}

/// The part of `pieces` before `distance`.
inline std::vector<CastPiece> cutAt(const std::vector<CastPiece>& pieces, double distance) {
    std::vector<CastPiece> kept;
    for (CastPiece piece : pieces) {
        if (piece.front >= distance) continue;
        if (piece.back > distance) {
            const double share = (distance - piece.front) / (piece.back - piece.front);
            piece.last = piece.first + (piece.last - piece.first) * share;
            piece.back = distance;
        }
        kept.push_back(piece);
    }
    return kept;
}

/// Where a ray first meets the boundary: distance, |cosine| to the normal and barycentric weights.
struct CastHit {
    double distance = 0.0;
    double facing = 0.0;
    std::size_t face = 0;
    glm::dvec3 weights{0.0};
};

inline std::optional<CastHit> castSurface(const data::Mesh& mesh, const CastRay& ray) {
    std::optional<CastHit> nearest;
    for (std::size_t b = 0; b < mesh.boundaryFaces.size(); ++b) {
        const glm::ivec3& ids = mesh.boundaryFaces[b].vertices;
        const auto at = [&](int id) {
            return mesh.origin + glm::dvec3{mesh.vertices[static_cast<std::size_t>(id)]};
        };
        const glm::dvec3 u = at(ids.y) - at(ids.x);
        const glm::dvec3 v = at(ids.z) - at(ids.x);
        const glm::dvec3 normal = glm::cross(u, v);
        const double slant = glm::dot(normal, ray.direction);
        if (slant == 0.0) continue;
        const glm::dvec3 from = ray.origin - at(ids.x);
        const double distance = -glm::dot(normal, from) / slant;
        const glm::dvec3 across = glm::cross(ray.direction, from);
        const double second = glm::dot(v, across) / slant;
        const double third = -glm::dot(u, across) / slant;
        if (distance < 0.0 || second < 0.0 || third < 0.0 || second + third > 1.0) continue;
        if (nearest && nearest->distance <= distance) continue;
        nearest = CastHit{.distance = distance,
                          .facing = std::abs(slant) / glm::length(normal),
                          .face = b,
                          .weights = {1.0 - second - third, second, third}};
    }
    return nearest;
}

}  // namespace volcast::support
