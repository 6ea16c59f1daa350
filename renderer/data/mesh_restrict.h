#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "renderer/base/result.h"
#include "renderer/data/mesh.h"

namespace volcast::data {

/// One time step of a field.
struct FieldStep {
    const Field* field = nullptr;
    int step = 0;
};

/// Cells of `mesh` with a NaN among the values they interpolate, in any step of `field`.
std::uint64_t countCellsWithoutValue(const Mesh& mesh, const Field& field);

/// The cells of a mesh that are drawn, and why the others are not.
struct KeptCells {
    std::vector<std::int32_t> cells;  ///< Ascending; empty where none is left.
    std::uint64_t notListed = 0;      ///< Left out: their marker is none of the listed values.
    std::uint64_t withoutValue = 0;   ///< Left out: listed, but NaN in one of the fields.
};

/// Leaves out the cells of `mesh` whose marker is not one of `listed`, then those with a NaN in one
/// of `fields` (a vertex field: at one of their vertices). Nothing where all cells stay, so that
/// the mesh serves as it is.
///
/// `marker`: a field of the mesh with one value a cell; its field is null where all cells count.
/// Errors: kInvalidArgument (a marker field of another association; a step out of range; a field
/// that has not this mesh's number of values).
Result<std::optional<KeptCells>> keptCells(const Mesh& mesh, const FieldStep& marker,
                                           std::span<const float> listed,
                                           std::span<const FieldStep> fields);

/// A mesh of some of the cells of another.
struct Restriction {
    /// Vertices, and so vertex fields, are those of the whole mesh with the same ids (shared, not
    /// copied; some are in no cell now). `fields` is empty: see restrictField(). Without cells
    /// where none was kept. `convex` is proven again from the float32 vertices: now and then false
    /// for a mesh that is convex, which costs time only.
    Mesh mesh;
    base::Array<std::int32_t> source;  ///< Of each cell: its id in the whole mesh; ascending.
};

/// The mesh of `cells` (ascending ids, no doubles). Costs one pass over them: the neighbours
/// are those of `mesh`, only faces towards cells that are left out become boundary.
Restriction restrictMesh(const Mesh& mesh, std::vector<std::int32_t> cells);

/// Time step `step` of `field` (in range) for the cells of a restriction, as step 0 of a field.
/// Vertex values are shared. Range and cellsWithoutValue stay those of the whole field.
Field restrictField(const Field& field, int step, std::span<const std::int32_t> source);

}  // namespace volcast::data
