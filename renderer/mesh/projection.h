#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "renderer/mesh/visibility_order.h"
#include "renderer/mesh/walk.h"

namespace volcast::mesh {

/// What one view keeps for one layer that is projected, between frames: vertices in camera space,
/// the order of cells, and the texture in which they are blended. Made empty.
class ProjectionState {
public:
    static std::unique_ptr<ProjectionState> create();
    virtual ~ProjectionState() = default;
    ProjectionState(const ProjectionState&) = delete;
    ProjectionState& operator=(const ProjectionState&) = delete;
    ProjectionState(ProjectionState&&) = delete;
    ProjectionState& operator=(ProjectionState&&) = delete;

    /// Of the last picture; no cells where its model needs no order.
    [[nodiscard]] virtual OrderReport order() const = 0;

    /// Cells in the last picture; of isosurfaces one for each level that a cell meets.
    [[nodiscard]] virtual std::uint64_t cellsDrawn() const = 0;

protected:
    ProjectionState() = default;
};

/// Draws a layer of any ray model cell by cell: each cell's share of a ray is computed by itself,
/// and shares are blended. The other evaluator, which draws the same pictures, is drawWalk().
/// The plan's evaluator kMeshProjectionFaces draws the values at faces alone where that is enough.
/// Of isosurfaces only the cells that meet a level are drawn, by what the level cuts out of them.
///
/// Errors: kShaderBuild, kOutOfGpuMemory, kLimitExceeded.
Result<void> drawProjection(const DrawInputs& inputs, ProjectionState& state);

/// Which faces of cells are drawn; as in shaders/mesh/projection_sides.glsl.
enum class Sides {
    kNear,  ///< Where lines enter; where they leave is computed.
    kFar,   ///< Where lines leave; for rays that start within the mesh.
    kAll,   ///< Only values at faces.
};

/// What tells the programs of drawProjection() apart.
struct ProjectionTraits {
    scene::RayModel model = scene::RayModel::kVolume;
    scene::Integrator integrator = scene::Integrator::kExact;
    int valuesAt = 0;       ///< Of f; see shaders/shared/mesh_bindings.glsl.
    int densityAt = 3;      ///< Of g; 3: f serves as g.
    bool interval = false;  ///< Only values in an interval count.
    int clipPlanes = 0;
    bool clipsAtStart = false;  ///< Rays may start within the mesh.
    Sides sides = Sides::kNear;
};

/// The vertex file of the programs that draw cells.
inline constexpr const char* kProjectionVertex = "mesh/projection.vert.glsl";

/// The program that draws cells, behind kProjectionVertex. Not of opaque models. `constants`: as in
/// DrawInputs.
shading::Recipe projectionRecipe(const ProjectionTraits& traits,
                                 std::vector<shading::Constant> constants);

/// The full-screen program that makes a picture of the blended shares.
shading::Recipe projectionFinishRecipe(const ProjectionTraits& traits,
                                       std::vector<shading::Constant> constants);

/// What tells the programs that draw isosurfaces apart.
struct LevelTraits {
    int valuesAt = 0;   ///< Of f.
    int densityAt = 3;  ///< Of g.
    bool lit = false;
    int clipPlanes = 0;
    bool clipsAtStart = false;  ///< Rays may start within the mesh.
};

/// The vertex file of the programs that draw isosurfaces.
inline constexpr const char* kLevelVertex = "mesh/level_polygons.vert.glsl";

/// The program that draws isosurfaces, behind kLevelVertex. `constants`: as in DrawInputs.
shading::Recipe levelRecipe(const LevelTraits& traits, std::vector<shading::Constant> constants);

}  // namespace volcast::mesh
