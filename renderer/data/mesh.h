#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/base/array.h"
#include "renderer/data/field.h"

namespace volcast::data {

/// A face with one cell, its vertices counter-clockwise seen from outside the mesh.
struct BoundaryFace {
    std::int32_t cell = -1;
    glm::ivec3 vertices{-1};
};

/// A tetrahedral mesh, ready to draw: positively oriented, adjacency known, in Morton order.
///
/// Cell (a, b, c, d) is positively oriented: dot(cross(b - a, c - a), d - a) > 0 in the double
/// coordinates it was made of, with a < b < min(c, d). Cells without volume are left out and
/// counted. Vertex ids are the Morton order; every vertex is used.
struct Mesh {
    glm::dvec3 origin{0.0};              ///< World = origin + vertex: keeps far-away meshes exact.
    base::Array<glm::vec3> vertices;     ///< Relative to `origin`, world units.
    base::Array<glm::ivec4> cells;       ///< Vertex ids.
    base::Array<glm::ivec4> neighbours;  ///< Cell across the face opposite vertex i, or -1.
    base::Array<BoundaryFace> boundaryFaces;
    /// For boundary face (a, b, c): the boundary faces across its edges ab, bc, ca; -1 where the
    /// boundary is not a manifold there.
    base::Array<glm::ivec3> boundaryNeighbours;
    std::vector<Field> fields;
    bool convex = false;                   ///< Every line meets the mesh in at most one piece.
    std::uint64_t cellsWithoutVolume = 0;  ///< Left out on import.
    std::uint64_t cellsInverted = 0;       ///< Turned round on import.
    std::uint64_t cellsDoubled = 0;        ///< Had the vertices of another cell; left out.
    std::uint64_t facesNotManifold = 0;    ///< Shared by other than two cells of opposite sides.
};

}  // namespace volcast::data
