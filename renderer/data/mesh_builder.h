#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/base/result.h"
#include "renderer/data/mesh.h"

namespace volcast::data {

/// A field as a file holds it. Items are counted in the order of MeshInput.
struct FieldInput {
    std::string name;  ///< Unique; bytes that are no UTF-8 become '?'.
    std::string unit = {};
    Association association = Association::kVertex;
    /// One a time step: points (kVertex), cells (kCell) or 4 * cells (kCellVertex) values.
    std::vector<std::vector<double>> steps = {};
    std::vector<double> times = {};  ///< One a step; empty means 0, 1, 2, ...
};

/// Tetrahedra as a file holds them, in any order and orientation.
struct MeshInput {
    std::vector<glm::dvec3> points;                  ///< World.
    std::vector<std::array<std::int64_t, 4>> cells;  ///< Indices into `points`.
    std::vector<FieldInput> fields;
};

inline constexpr std::size_t kMaxMeshItems = std::size_t{1} << 28;  ///< Points and cells each.
inline constexpr std::size_t kMaxFields = 4096;
inline constexpr std::size_t kMaxSteps = std::size_t{1} << 20;  ///< Time steps of one field.

/// Makes a mesh that is ready to draw; the result does not depend on the order of the input.
///
/// * The origin is the centre of the used points' bounds. Points no cell uses are dropped.
/// * Points that coincide in float32 and agree in every vertex field become one vertex, so that
///   meshes written piece by piece are joined; where a field jumps they stay apart. NaN agrees
///   with NaN.
/// * Cells without volume (in the rounding of double) or with a vertex twice are left out, as are
///   all but one of cells with the same vertices; both are counted.
/// * Negatively oriented cells are turned round and counted. A cell too thin for float32 keeps the
///   orientation of its double coordinates: its neighbours then still match.
/// * Two cells are neighbours where exactly these two share a face, from opposite sides. A face
///   that more cells share, or two from one side, is a boundary face of each and counted.
///
/// * NaN among field values is kept: Field::cellsWithoutValue counts the cells it concerns.
///
/// Errors: kInvalidArgument (a coordinate that is not finite or a value that is infinite, either
/// beyond float32, a field of NaN alone, an index out of range, a wrong number of values, a doubled
/// or empty field name, no cell with a volume), kLimitExceeded (counts).
Result<Mesh> buildMesh(MeshInput input);

}  // namespace volcast::data
