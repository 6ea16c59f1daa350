#pragma once

// The contract between renderer/scene, which calls, and renderer/mesh, which implements.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/base/result.h"
#include "renderer/data/mesh.h"
#include "renderer/gpu/buffer.h"
#include "renderer/gpu/target.h"
#include "renderer/plan/plan.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/scale.h"
#include "renderer/scene/scene.h"
#include "renderer/shading/program_cache.h"

namespace volcast::mesh {

/// A mesh's vertices, cells, adjacency and boundary on the GPU; shared by all views.
class MeshGpu {
public:
    /// Errors: kLimitExceeded (more texels than the device addresses), kOutOfGpuMemory.
    static Result<std::unique_ptr<MeshGpu>> upload(gpu::Device& device, const data::Mesh& mesh);
    virtual ~MeshGpu() = default;
    MeshGpu(const MeshGpu&) = delete;
    MeshGpu& operator=(const MeshGpu&) = delete;
    MeshGpu(MeshGpu&&) = delete;
    MeshGpu& operator=(MeshGpu&&) = delete;

protected:
    MeshGpu() = default;
};

/// One time step of one field on the GPU; shared by all views.
class FieldGpu {
public:
    /// `step` is in [0, field.steps.size()). Values are stored as `scale` makes them.
    ///
    /// Errors: as MeshGpu::upload.
    static Result<std::unique_ptr<FieldGpu>> upload(gpu::Device& device, const data::Mesh& mesh,
                                                    const data::Field& field, int step,
                                                    const scene::ScaleFunction& scale);
    virtual ~FieldGpu() = default;
    FieldGpu(const FieldGpu&) = delete;
    FieldGpu& operator=(const FieldGpu&) = delete;
    FieldGpu(FieldGpu&&) = delete;
    FieldGpu& operator=(FieldGpu&&) = delete;

protected:
    FieldGpu() = default;
};

/// What one view keeps for one layer between frames: entry lists, vertices in camera space.
/// Made empty; drawWalk() fills and resizes it.
class WalkState {
public:
    static std::unique_ptr<WalkState> create();
    virtual ~WalkState() = default;
    WalkState(const WalkState&) = delete;
    WalkState& operator=(const WalkState&) = delete;
    WalkState(WalkState&&) = delete;
    WalkState& operator=(WalkState&&) = delete;

    /// What all rays of the last picture took, where DrawInputs::countsSteps; else 0. A step
    /// crosses a cell or takes one more part of a piece that is split; on meshes that are not
    /// convex, the search for entries counts too. Rays too long for one draw begin anew.
    [[nodiscard]] virtual std::uint64_t steps() const = 0;

protected:
    WalkState() = default;
};

/// What a draw needs besides where a user's code says what samples show.
struct UserInputs {
    std::vector<shading::TextChunk> texts;  ///< Its chunks that are no files.
    std::vector<const FieldGpu*> others;    ///< Fields that it reads besides the layer's own.
    int iterations = 0;                     ///< Of its loops, for one sample.
};

/// One layer's draw. All pointers are borrowed for the call.
///
/// Bound by the caller: the layer block (kLayerBinding, see shaders/shared/layer_block.glsl), the
/// transfer function (kMapBinding and kMapUnit), the opaque distances (kOpaqueDistanceUnit). Units
/// from kFirstMeshUnit on and kMeshBinding are the mesh's own.
struct DrawInputs {
    gpu::Device* device = nullptr;
    shading::ProgramCache* programs = nullptr;
    const data::Mesh* mesh = nullptr;
    const MeshGpu* meshGpu = nullptr;
    const FieldGpu* field = nullptr;    ///< f; null where the layer needs no values.
    const FieldGpu* density = nullptr;  ///< g; null where f serves as g.
    const scene::Layer* layer = nullptr;
    const plan::LayerPlan* plan = nullptr;
    const scene::Camera* camera = nullptr;
    double planeDepth = 0.0;  ///< LayerBlock::rayStart.w in double.
    glm::ivec2 size{0};
    /// Equal numbers: camera, size and planeDepth are as they were when this view last drew.
    std::uint64_t cameraVersion = 0;
    /// To be put, before the mesh's own, into every recipe and pass that includes lib/layer.glsl or
    /// classifies by classify/transfer_function.glsl.
    std::vector<shading::Constant> constants;
    int clipPlanes = 0;                     ///< In the layer block.
    std::span<const float> levels = {};     ///< Of an isosurface, ascending, as `field` is scaled.
    bool countsSteps = false;               ///< The walk's, by another program.
    const UserInputs* user = nullptr;       ///< Code instead of the map, bound at kMapUnit.
    const gpu::Buffer* psiTable = nullptr;  ///< Where the integrator reads it, else null.
    /// Rays: colour 0, 32F, premultiplied, blended "over" (PassState{.blend = Blend::kOver}).
    /// Opaque models: colour 0 as before (opaque: alpha 1), colour 1 R32F the distance along the
    /// ray from its origin, and a depth attachment (DepthTest::kNearest; clip positions by
    /// LayerBlock::clipFromData), so that several surfaces hide one another.
    const gpu::Target* target = nullptr;
};

/// Draws a layer of any ray model by walking from cell to cell. Rays end at the opaque distance of
/// their pixel.
///
/// Errors: kShaderBuild, kOutOfGpuMemory, kLimitExceeded.
Result<void> drawWalk(const DrawInputs& inputs, WalkState& state);

/// Draws a layer of the models surface and wireframe: boundary faces as triangles.
///
/// Errors: kShaderBuild.
Result<void> drawSurface(const DrawInputs& inputs);

/// What tells the programs of users' codes apart.
struct CodeTraits {
    std::vector<shading::TextChunk> texts;
    std::vector<int> othersAt;  ///< As WalkTraits::valuesAt, of UserInputs::others.
    int iterations = 0;
};

/// What tells the programs of drawWalk() apart.
struct WalkTraits {
    scene::RayModel model = scene::RayModel::kVolume;
    scene::Integrator integrator = scene::Integrator::kExact;
    int valuesAt = 0;        ///< Of f; see shaders/shared/mesh_bindings.glsl.
    int densityAt = 3;       ///< Of g; 3: f serves as g.
    bool levels = false;     ///< volume: isosurfaces end its rays.
    bool oneColour = false;  ///< volume: only opacity is gathered.
    bool lit = false;        ///< Isosurfaces.
    bool interval = false;   ///< Only values in an interval count.
    int clipPlanes = 0;
    bool convex = true;         ///< A line enters the mesh once at most.
    bool clipsAtStart = false;  ///< Rays may start within the mesh.
    bool earlyStop = true;
    bool counts = false;                  ///< Rays may need more steps than one draw has.
    bool resumes = false;                 ///< They go on where the last draw ended.
    bool countsSteps = false;             ///< For WalkState::steps().
    std::optional<CodeTraits> code = {};  ///< volume, mip, minip: instead of the map.
};

/// The program of drawWalk(). `constants`: as in DrawInputs.
shading::Recipe walkRecipe(const WalkTraits& traits, std::vector<shading::Constant> constants);

/// What tells the programs of drawSurface() apart.
struct SurfaceTraits {
    bool coloured = false;  ///< By the values of a field at `association`.
    bool headlight = true;
    bool edges = false;
    bool interval = false;
    int clipPlanes = 0;
    int valuesAt = 0;
};

/// The vertex file of drawSurface()'s programs.
inline constexpr const char* kSurfaceVertex = "mesh/surface.vert.glsl";

/// The program of drawSurface(), behind kSurfaceVertex.
shading::Recipe surfaceRecipe(const SurfaceTraits& traits,
                              std::vector<shading::Constant> constants);

}  // namespace volcast::mesh
