#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/data/mesh.h"

namespace volcast::data {

/// How the faces between two cells stand to the spheres through the cells' corners.
struct DelaunayFaces {
    std::uint64_t violated = 0;  ///< The vertex across lies inside, by more than rounding explains.
    /// Of the others: all five vertices on one sphere, up to rounding. Power distances do not tell
    /// the two cells apart there (all six cells of a lattice's cube tie).
    std::uint64_t tied = 0;
    std::uint64_t cellsFlat = 0;  ///< Cells without volume in float32: they have no sphere.
};

/// Tests every face between two cells, from the side of the smaller cell number.
///
/// The power P of a vertex q in the sphere (c, R) of a cell is -sum of l_i |p_i - q|^2, l_i the
/// barycentric coordinates of q. The vertices were rounded to float32 by e <= 2^-24 max |v| each,
/// which moves P by at most 2 R e (1 + sum of |l_i|), to first order; twice that is tolerated.
DelaunayFaces countDelaunayFaces(const Mesh& mesh);

/// True where no face is violated and no cell flat.
///
/// In a convex mesh this makes the whole mesh Delaunay, and the power distance of the eye to the
/// cells' spheres a visibility order. In one with gaps it holds for cells that touch.
/// Source: H. Edelsbrunner, An acyclicity theorem for cell complexes in d dimensions,
/// Combinatorica 10, 1990.
bool isDelaunay(const Mesh& mesh);

/// Of each cell: centre of the sphere through its corners, relative to Mesh::origin, and radius
/// squared. A cell that is flat in float32 has its mean corner and 0. The eye's power distance to a
/// cell is |eye - centre|^2 - radius^2; larger is further in a Delaunay mesh.
std::vector<glm::dvec4> powerSpheres(const Mesh& mesh);

}  // namespace volcast::data
