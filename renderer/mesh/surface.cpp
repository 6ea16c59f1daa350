#include <epoxy/gl.h>

#include "renderer/mesh/mesh_buffers.h"
#include "renderer/mesh/shared.h"
#include "renderer/mesh/walk.h"
#include "renderer/plan/effects.h"

namespace volcast::mesh {

shading::Recipe surfaceRecipe(const SurfaceTraits& traits,
                              std::vector<shading::Constant> constants) {
    constants.insert(constants.end(), {{"kReadsValues", traits.coloured || traits.interval},
                                       {"kHeadlight", traits.headlight},
                                       {"kEdges", traits.edges},
                                       {"kInterval", traits.interval},
                                       {"kClipPlanes", traits.clipPlanes},
                                       {"kClipsAtStart", false},
                                       {"kValuesAt", traits.valuesAt}});
    return {.evaluator = traits.coloured ? "mesh/surface_coloured.glsl" : "mesh/surface_plain.glsl",
            .classify = traits.coloured ? "classify/transfer_function.glsl" : "",
            .segment = "",
            .model = "",
            .constants = std::move(constants)};
}

Result<void> drawSurface(const DrawInputs& inputs) {
    const MeshBuffers& mesh = MeshBuffers::of(*inputs.meshGpu);
    const SurfaceTraits traits{.coloured = inputs.layer->coloured && inputs.field != nullptr,
                               .headlight = inputs.layer->headlight,
                               .edges = inputs.layer->model == scene::RayModel::kWireframe,
                               .interval = inputs.plan->has(plan::kInterval),
                               .clipPlanes = inputs.clipPlanes,
                               .valuesAt = valuesAt(inputs.field)};
    const auto program =
        inputs.programs->ray(surfaceRecipe(traits, inputs.constants), kSurfaceVertex);
    if (!program) return program.error();
    // From outside, the nearest boundary faces the eye; within the mesh, or where parts are cut
    // away, it may face away.
    const bool outside = inputs.planeDepth > 0.0 && !traits.interval && traits.clipPlanes == 0;
    inputs.target->begin(
        {.depth = gpu::DepthTest::kNearest, .cull = outside ? gpu::Cull::kBack : gpu::Cull::kNone});
    (*program)->use();
    mesh.positions.bindTexels(shared::kPositionUnit);
    mesh.boundary.bindTexels(shared::kBoundaryUnit);
    if (inputs.field != nullptr)
        FieldBuffer::of(*inputs.field).values.bindTexels(shared::kFieldUnit);
    glEnable(GL_DEPTH_CLAMP);  // Nothing in front of the eye is cut away.
    inputs.device->draw(gpu::Primitive::kTriangles, 3 * mesh.boundaryCount);
    glDisable(GL_DEPTH_CLAMP);
    return {};
}

}  // namespace volcast::mesh
