#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/base/array.h"

namespace volcast::data {

/// Where a mesh field's values sit; the finite-element names are P0, P1 and D1 (discontinuous).
enum class Association {
    kCell,        ///< P0: one value a cell.
    kVertex,      ///< P1: one value a vertex, linear in each cell.
    kCellVertex,  ///< D1: four values a cell, linear in each cell, may jump between cells.
};

/// Smallest and largest value; empty where min > max.
struct Range {
    float min = 0.0F;
    float max = 0.0F;
    friend bool operator==(const Range&, const Range&) = default;
};

/// One named scalar field on a mesh, at one or more time steps. Values are finite, or NaN where
/// there is none: cells that would interpolate it are left out where the field is drawn.
struct Field {
    std::string name;
    std::string unit;  ///< As the file says; may be empty.
    Association association = Association::kVertex;
    Range range;  ///< Over all steps, NaN apart; never empty.
    /// Values a step: cells (kCell), vertices (kVertex) or 4 * cells (kCellVertex, in the cell's
    /// vertex order).
    std::vector<base::Array<float>> steps;
    std::vector<double> times;            ///< One a step; {0} where the file has no time.
    std::uint64_t cellsWithoutValue = 0;  ///< Cells with a NaN in any step.
};

}  // namespace volcast::data
