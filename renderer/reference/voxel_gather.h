#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/data/field.h"
#include "renderer/reference/gather.h"
#include "renderer/reference/linear_map.h"
#include "renderer/reference/voxel_grid.h"

namespace volcast::reference {

/// Cuts `pieces` where f enters or leaves the interval, and keeps what is in it.
void cutVoxels(const std::optional<data::Range>& interval, std::vector<VoxelPiece>& pieces);

/// How a light changes the colour of matter at a distance: x times it, and y of white.
using LightAt = std::function<glm::dvec2(double distance)>;

/// int C(f) rho(f) T ds premultiplied, and 1 - T. `light` may be empty.
///
/// Cut where a map bends, so that C and rho are polynomials; panels of at most one unit of depth,
/// whose ends are where the depth takes whole numbers, are integrated by 10 Gauss points and once
/// more in halves, until both agree to 1e-12 (under a light, which is not smooth: 1e-9 or 12
/// halvings). Halves are at least as good as what they are compared with, so a ray of n panels is
/// off by n 1e-12 at most; what lies behind a depth of 60 is left out: exp(-60) = 9e-27.
glm::dvec4 volume(std::span<const VoxelPiece> pieces, const Matter& matter, const LightAt& light);
/// int rho(f) ds; exact but for rounding.
double opticalDepth(std::span<const VoxelPiece> pieces, const LinearMap& extinction);
/// int C(f) ds; exact but for rounding.
glm::dvec3 colourIntegral(std::span<const VoxelPiece> pieces, const LinearMap& colour);
std::optional<Extremes> extremes(std::span<const VoxelPiece> pieces);
/// The largest red, green and blue of C(f), each by itself; nothing without pieces.
std::optional<glm::dvec3> largestColour(std::span<const VoxelPiece> pieces,
                                        const LinearMap& colour);
/// How often the ray enters pieces that do not go on from each other.
std::uint64_t entries(std::span<const VoxelPiece> pieces);

/// Where a ray first goes from one side of a level to the other: in a piece or from one to the next
/// that goes on from it. `levels` ascend; values of a level itself count as above it.
std::optional<LevelHit> firstLevel(std::span<const VoxelPiece> pieces,
                                   std::span<const double> levels);

}  // namespace volcast::reference
