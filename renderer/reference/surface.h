#pragma once

#include <optional>

#include "renderer/reference/evaluate.h"

namespace volcast::reference {

/// The nearest point of a ray on the boundary of a mesh.
struct BoundaryHit {
    double distance = 0.0;
    double f = 0.0;
    double facing = 0.0;  ///< |cosine| between ray and normal.
    FaceName face{-1, -1, -1};
    int points = 0;  ///< Boundary points of the whole ray within its span.
};

/// The boundary is made of the faces that the ray did not meet once on each side: of cells that are
/// drawn, whatever the mesh says of its own boundary. Points outside of `interval` do not exist.
std::optional<BoundaryHit> nearestBoundary(const data::Mesh& mesh, const Ray& ray, const Span& span,
                                           const std::optional<data::Range>& interval,
                                           Scratch& scratch);

/// |cosine| between a ray and the gradient of f in a cell; 0 where f is constant.
double facingGradient(const data::Mesh& mesh, int cell, const FieldValues& f,
                      const glm::dvec3& direction);

}  // namespace volcast::reference
