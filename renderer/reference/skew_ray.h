#pragma once

#include <optional>

#include <glm/glm.hpp>

#include "renderer/data/mesh.h"
#include "renderer/reference/piece.h"
#include "renderer/reference/ray.h"

namespace volcast::reference {

/// A ray as the z axis: axes are renamed in a cycle so that z is where the ray moves most, and
/// points are sheared along z until the ray stands upright at x = y = 0.
///
/// Sheared coordinates are rounded once a vertex and taken as exact from then on. Which side of the
/// ray an edge passes is decided without error, ties by moving all points by (e, e^2) for an
/// infinitely small e > 0. So every cell is entered through one face and left through one, or not
/// met, and the cells of a conforming mesh share no part of a ray and leave none out, whether it
/// runs through vertices, along edges or in faces.
class SkewRay {
public:
    SkewRay(const Ray& ray, const glm::dvec3& meshOrigin);

    /// The ray in `cell`, or nothing where it passes by.
    [[nodiscard]] std::optional<Piece> through(const data::Mesh& mesh, int cell,
                                               const FieldValues& f, const FieldValues& g) const;

    /// Relative to the mesh's origin.
    [[nodiscard]] const glm::dvec3& origin() const noexcept { return origin_; }
    [[nodiscard]] const glm::dvec3& direction() const noexcept { return direction_; }

private:
    struct Corner {
        double x, y, z;
        int vertex, corner;
    };
    [[nodiscard]] Corner seen(const glm::vec3& point, int vertex, int corner) const;

    glm::dvec3 origin_, direction_;
    int x_, y_, z_;  ///< Which world axis plays which.
    double shearX_, shearY_, distancePerZ_;
};

}  // namespace volcast::reference
