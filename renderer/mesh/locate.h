#pragma once

#include <optional>

#include <glm/glm.hpp>

#include "renderer/data/mesh.h"

namespace volcast::mesh {

/// A cell and a point strictly inside it.
struct Place {
    int cell = -1;
    glm::dvec3 point{0.0};  ///< Data space.
};

/// The cell that holds `point` (data space), or nothing. A point on a vertex, edge or face is moved
/// inwards by a few millionths of the cell, so that rays from it start inside one cell.
///
/// `hint` is a cell to start searching from, or -1: near the last answer the search takes
/// microseconds, without a hint it looks at every cell.
std::optional<Place> locate(const data::Mesh& mesh, const glm::dvec3& point, int hint);

}  // namespace volcast::mesh
