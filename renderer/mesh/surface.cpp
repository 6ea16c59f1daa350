#include <epoxy/gl.h>

#include "renderer/mesh/mesh_buffers.h"
#include "renderer/mesh/shared.h"
#include "renderer/mesh/walk.h"

namespace volcast::mesh {

shading::Recipe surfaceRecipe(const SurfaceTraits& traits,
                              std::vector<shading::Constant> constants) {
    constants.insert(constants.end(), {{"kColoured", traits.coloured},
                                       {"kHeadlight", traits.headlight},
                                       {"kValuesAt", valuesAt(traits.association)}});
    return {.evaluator = traits.coloured ? "mesh/surface_coloured.glsl" : "mesh/surface_plain.glsl",
            .classify = traits.coloured ? "classify/transfer_function.glsl" : "",
            .segment = "",
            .model = "",
            .constants = std::move(constants)};
}

Result<void> drawSurface(const DrawInputs& inputs) {
    const MeshBuffers& mesh = MeshBuffers::of(*inputs.meshGpu);
    const bool coloured = inputs.layer->coloured && inputs.field != nullptr;
    const auto program = inputs.programs->ray(surfaceRecipe({.coloured = coloured,
                                                             .headlight = inputs.layer->headlight,
                                                             .association = inputs.association},
                                                            inputs.constants),
                                              kSurfaceVertex);
    if (!program) return program.error();
    // From outside, the nearest boundary faces the eye; within the mesh it faces away.
    inputs.target->begin({.depth = gpu::DepthTest::kNearest,
                          .cull = inputs.planeDepth > 0.0 ? gpu::Cull::kBack : gpu::Cull::kNone});
    (*program)->use();
    mesh.positions.bindTexels(shared::kPositionUnit);
    mesh.boundary.bindTexels(shared::kBoundaryUnit);
    if (coloured) FieldBuffer::of(*inputs.field).values.bindTexels(shared::kFieldUnit);
    glEnable(GL_DEPTH_CLAMP);  // Nothing in front of the eye is cut away.
    inputs.device->draw(gpu::Primitive::kTriangles, 3 * mesh.boundaryCount);
    glDisable(GL_DEPTH_CLAMP);
    return {};
}

}  // namespace volcast::mesh
