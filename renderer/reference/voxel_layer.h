#pragma once

#include <span>

#include "renderer/reference/layer_data.h"
#include "renderer/reference/voxel_gather.h"

namespace volcast::reference {

/// What a layer of voxels that ends no rays shows of the pieces of one ray.
glm::dvec4 gathered(const LayerData& data, const Ray& ray, std::span<const VoxelPiece> pieces);

/// |cosine| between a ray and the field's slope at a distance; 1 where it is flat.
double facingSlope(const VoxelGrid& grid, const Ray& ray, double distance);

}  // namespace volcast::reference
