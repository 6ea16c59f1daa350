#pragma once

#include "renderer/data/volume.h"
#include "renderer/shading/assemble.h"
#include "renderer/volume/voxel_blocks.h"

namespace volcast::volume {

struct DrawInputs;

/// How programs read the voxels of a layer: all of a channel in one texture, or bricks of it.
struct FieldTraits {
    bool bricked = false;
    data::VoxelType type = data::VoxelType::kF32;  ///< These two of bricks alone.
    int coarserLevels = 0;
};

FieldTraits fieldTraits(const DrawInputs& inputs);

/// Adds to a recipe whose chunks include volume/voxels.glsl what these functions of `traits` are.
void addField(shading::Recipe& recipe, const FieldTraits& traits);

/// What a texel of a channel holds that is there as a whole.
VoxelTexels texelsOf(const DrawInputs& inputs);

/// Binds the voxels that the recipe reads.
void bindField(const DrawInputs& inputs);

}  // namespace volcast::volume
