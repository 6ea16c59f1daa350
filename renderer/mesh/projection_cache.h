#pragma once

#include <cstdint>
#include <optional>

#include "renderer/gpu/buffer.h"
#include "renderer/gpu/canvas.h"
#include "renderer/mesh/camera_vertices.h"
#include "renderer/mesh/level_cells.h"
#include "renderer/mesh/projection.h"

namespace volcast::mesh {

/// What stands behind ProjectionState.
class ProjectionCache final : public ProjectionState {
public:
    /// Makes all that cells need fit `inputs`; what is still right is kept. `sorted`: the order of
    /// cells too, which takes the CPU some 0.1 us a cell.
    ///
    /// Errors: kShaderBuild, kOutOfGpuMemory, kLimitExceeded.
    Result<void> prepare(const DrawInputs& inputs, bool sorted);

    /// The same for isosurfaces: the cells that meet levels.
    Result<void> prepareLevels(const DrawInputs& inputs);

    /// Binds the mesh block, vertices, cells and their order.
    void bind(const DrawInputs& inputs) const;

    [[nodiscard]] const LevelCells& levels() const noexcept { return levels_; }

    /// What shares of cells are blended in.
    [[nodiscard]] const gpu::Target& shares() const noexcept { return shares_.target(); }
    void bindShares() const;

    [[nodiscard]] OrderReport order() const override;
    [[nodiscard]] std::uint64_t cellsDrawn() const override { return cellsDrawn_; }

    static ProjectionCache& of(ProjectionState& state) {
        return static_cast<ProjectionCache&>(state);
    }

private:
    Result<void> findCorners(const DrawInputs& inputs);
    Result<void> sort(const DrawInputs& inputs);

    CameraVertices camera_;
    std::optional<VisibilityOrder> order_;
    std::uint64_t orderMesh_ = 0;    ///< The serial of the mesh that `order_` is for.
    std::uint64_t orderCamera_ = 0;  ///< The version of `camera_` that it was sorted for.
    bool sorted_ = false;            ///< The last picture was.
    std::uint64_t cellsDrawn_ = 0;
    gpu::Buffer corners_, cells_;
    LevelCells levels_;
    std::uint64_t cornersMesh_ = 0;
    gpu::Canvas shares_;
};

}  // namespace volcast::mesh
