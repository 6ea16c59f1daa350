#pragma once

#include <cstdint>
#include <vector>

#include "renderer/data/load/mixed_mesh.h"

namespace volcast::data::load {

/// Linear cells of one kind; `parents` counts the cells of the mesh that they were cut from.
struct LinearBlock {
    CellKind kind = CellKind::kTetra;
    std::vector<std::int64_t> vertices = {};
    std::vector<std::uint32_t> parents = {};
};

struct LinearCells {
    std::vector<LinearBlock> blocks;
};

/// Cuts quadratic cells at their mid-edge points; linear ones stay. Adds the centres of faces and
/// cells that the cut needs to `mesh.points` and to its vertex fields.
LinearCells cutQuadratic(MixedMesh& mesh);

}  // namespace volcast::data::load
