#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/base/array.h"
#include "renderer/base/result.h"
#include "renderer/reference/caster.h"
#include "renderer/reference/linear_map.h"
#include "renderer/reference/reference.h"
#include "renderer/reference/voxel_grid.h"

namespace volcast::reference {

/// One layer, its data looked up and scaled: all that its rays need.
struct LayerData {
    const scene::Layer* layer = nullptr;
    const Caster* caster = nullptr;  ///< Of a mesh; null: the layer is one of voxels.
    FieldValues f, g;        ///< Scaled; without values where the layer does not read the field.
    LinearMap colour;        ///< C, of f.
    LinearMap extinction;    ///< rho, of g; an isosurface's colour of g where it has two fields.
    bool twoFields = false;  ///< g is a field of its own.
    std::optional<data::Range> interval;  ///< Scaled.
    std::vector<double> levels;           ///< Scaled, within the interval, ascending.
    std::vector<char> kept;               ///< One a cell, 0: left out; empty: all are kept.
    /// What `f` and `g` point to where a scale had to be applied.
    base::Array<float> ownF, ownG;
    std::vector<float> voxels;      ///< Scaled; what `grid` reads.
    std::optional<VoxelGrid> grid;  ///< Of voxels.
};

/// Looks up and scales what `layer`, named `path` in errors, needs. `layer` and `bodies` must
/// outlive the result.
///
/// Errors: those of draw() that concern a layer.
Result<LayerData> prepare(const scene::Layer& layer, const Bodies& bodies, const std::string& path);

}  // namespace volcast::reference
