#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/base/result.h"
#include "renderer/data/mesh_builder.h"

namespace volcast::data::load {

/// Cells with a volume, their vertices in VTK's order.
enum class CellKind {
    kTetra,
    kPyramid,
    kWedge,
    kHexahedron,
    kTetra10,
    kPyramid13,
    kPyramid14,
    kWedge15,
    kWedge18,
    kHexahedron20,
    kHexahedron27,
};

/// Vertices of one cell.
std::size_t vertexCount(CellKind kind) noexcept;

/// The kind called `name`, such as "hexahedron" or "tetra10" (the names that meshio uses).
std::optional<CellKind> cellKind(std::string_view name) noexcept;

struct CellBlock {
    CellKind kind = CellKind::kTetra;
    std::vector<std::int64_t> vertices = {};  ///< vertexCount(kind) point indices a cell.
};

/// A mesh of any cells. Cell fields count the cells of all blocks, one block after the other;
/// cell-vertex fields are for meshes of linear tetrahedra alone.
struct MixedMesh {
    std::vector<glm::dvec3> points;
    std::vector<CellBlock> blocks;
    std::vector<FieldInput> fields;
};

/// Splits all cells into tetrahedra, so that cells which share a face split it alike.
///
/// A face of four vertices is cut by the diagonal through its smallest point index; a cell then is
/// the cones from its smallest point to the faces that do not have it. Quadratic cells are cut at
/// their mid-edge points first (a tetrahedron into 8, a hexahedron into 8 hexahedra, a wedge into
/// 8, a pyramid into 6 pyramids and 4 tetrahedra); points that the cut needs at the centre of faces
/// and cells, and that the cell does not have, are added with the values of its shape functions.
/// Tetrahedra that would have a point twice (of collapsed cells) are left out.
/// Source of the cones: J. Dompierre et al., How to Subdivide Pyramids, Prisms and Hexahedra into
/// Tetrahedra, 8th International Meshing Roundtable, 1999.
///
/// Errors: kInvalidArgument (an index out of range, a count that does not fit).
Result<MeshInput> splitCells(MixedMesh mesh);

}  // namespace volcast::data::load
