#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/data/mesh.h"

namespace volcast::data {

/// Corners of the face opposite corner i of a positively oriented cell, counter-clockwise seen
/// from outside the cell.
inline constexpr std::array<std::array<int, 3>, 4> kFaceCorners{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// What touches what; the members as in Mesh.
struct Adjacency {
    std::vector<glm::ivec4> neighbours;
    std::vector<BoundaryFace> boundaryFaces;
    std::vector<glm::ivec3> boundaryNeighbours;
    std::uint64_t facesNotManifold = 0;
};

/// `cells` as in Mesh: a < b < min(c, d), positively oriented.
Adjacency findAdjacency(std::span<const glm::ivec4> cells, std::size_t vertexCount);

/// The rest of what touches what, where the neighbours are known; facesNotManifold stays 0.
Adjacency completeAdjacency(std::span<const glm::ivec4> cells, std::vector<glm::ivec4> neighbours);

/// True only where every line meets the mesh in one piece, up to the rounding of double.
///
/// The boundary must be closed, have no concave edge, and be seen from the mean of its vertices
/// from inside and once in each direction: it then bounds a convex body. Faces that are flat only
/// up to float32 count as concave; such a mesh is drawn as one that is not convex, which is slower,
/// not wrong.
bool isConvex(std::span<const glm::dvec3> vertices, const Adjacency& adjacency);

}  // namespace volcast::data
