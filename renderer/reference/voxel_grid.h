#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/data/volume.h"
#include "renderer/reference/bernstein.h"
#include "renderer/reference/ray.h"
#include "renderer/scene/scene.h"

namespace volcast::reference {

/// A ray in one cell of a grid, where the field is one polynomial of the way.
struct VoxelPiece {
    double front = 0.0, length = 0.0;  ///< World distance of its near end; may have no length.
    Bernstein f;                       ///< From its near end to its far one.
};

/// The field of a channel between its grid points: constant around each (nearest), a cubic on any
/// ray in a cell (trilinear), a polynomial of degree 9 (tricubic: Catmull-Rom along each axis,
/// values on faces go on beyond). A cell that would use a NaN has no value.
class VoxelGrid {
public:
    /// `values`: one a grid point, x fastest; both must outlive the grid.
    VoxelGrid(const data::Volume& volume, std::span<const float> values, scene::Sampling sampling)
        : volume_{&volume}, values_{values}, sampling_{sampling} {}

    [[nodiscard]] bool continuous() const { return sampling_ != scene::Sampling::kNearest; }

    /// The pieces of `ray` in `span`, front to back; those without a value are left out.
    void trace(const Ray& ray, const Span& span, std::vector<double>& scratch,
               std::vector<VoxelPiece>& pieces) const;

    /// The direction in the world in which the field rises most, by differences over a grid
    /// interval to each side, a shorter one at a face and none where there is no value; of length
    /// 1, or 0 where it is flat.
    [[nodiscard]] glm::dvec3 normalAt(const glm::dvec3& world) const;

private:
    [[nodiscard]] glm::dvec3 gridFrom(const glm::dvec3& world) const;
    [[nodiscard]] double voxel(glm::ivec3 at) const;
    /// The field from grid position `from` to `to`, in the cell of their middle.
    [[nodiscard]] Bernstein between(const glm::dvec3& from, const glm::dvec3& to) const;
    template <std::size_t N>
    [[nodiscard]] Bernstein weighted(const glm::ivec3& first,
                                     const std::array<std::array<Bernstein, N>, 3>& weights) const;

    const data::Volume* volume_;
    std::span<const float> values_;
    scene::Sampling sampling_;
};

}  // namespace volcast::reference
