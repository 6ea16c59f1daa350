#include "renderer/mesh/camera_vertices.h"

#include <span>

#include <epoxy/gl.h>

#include "renderer/mesh/dispatch.h"
#include "renderer/mesh/locate.h"
#include "renderer/mesh/mesh_buffers.h"
#include "renderer/mesh/shared.h"
#include "renderer/mesh/view_block.h"
#include "renderer/shading/shared.h"

namespace volcast::mesh {

namespace {

bool holds(const data::Box& box, const glm::dvec3& point) {
    return glm::all(glm::lessThanEqual(box.min, point)) &&
           glm::all(glm::lessThanEqual(point, box.max));
}

}  // namespace

Result<void> CameraVertices::prepare(const DrawInputs& inputs) {
    const MeshBuffers& mesh = MeshBuffers::of(*inputs.meshGpu);
    // Only values at vertices travel with the vertices.
    const bool carried = valuesAt(inputs.field) == shared::kValuesAtVertices;
    const Key key{.mesh = mesh.serial,
                  .field = carried ? FieldBuffer::of(*inputs.field).serial : 0,
                  .camera = inputs.cameraVersion,
                  .valuesAt = carried ? shared::kValuesAtVertices : shared::kValuesAtCells};
    if (key == key_) return {};
    const bool sameView = key.mesh == key_.mesh && key.camera == key_.camera;
    key_ = {};  // Until all of it is made, nothing of it counts.
    if (!sameView) {
        ++version_;
        if (auto done = allocate(inputs); !done) return done;
        lookFrom(inputs);
    }
    if (auto done = transform(inputs, carried); !done) return done;
    key_ = key;
    return {};
}

Result<void> CameraVertices::allocate(const DrawInputs& inputs) {
    const auto make = [&inputs](gpu::Buffer& buffer, const gpu::BufferDesc& desc) -> Result<void> {
        if (buffer.valid() && buffer.bytes() == desc.bytes) return {};
        auto made = gpu::Buffer::create(*inputs.device, desc);
        if (!made) return made.error();
        buffer = std::move(*made);
        return {};
    };
    auto done = make(
        block_, {.bytes = sizeof(shared::MeshBlock), .updatable = true, .label = "mesh block"});
    if (!done) return done;
    const auto vertices = static_cast<std::size_t>(MeshBuffers::of(*inputs.meshGpu).vertexCount);
    return make(vertices_, {.bytes = vertices * sizeof(glm::vec4),
                            .texels = gpu::TexelFormat::kRgba32F,
                            .label = "camera space vertices"});
}

void CameraVertices::lookFrom(const DrawInputs& inputs) {
    const MeshBuffers& mesh = MeshBuffers::of(*inputs.meshGpu);
    eye_ = inputs.camera->eye - inputs.mesh->origin;
    std::optional<Place> start;
    if (inputs.camera->projection == scene::Projection::kPerspective && inputs.planeDepth <= 0.0 &&
        holds(mesh.bounds, eye_)) {
        start = locate(*inputs.mesh, eye_, startCell_ < mesh.cellCount ? startCell_ : -1);
    }
    startCell_ = start ? start->cell : -1;
    if (start) eye_ = start->point;
    const glm::ivec4 startVertices =
        start ? inputs.mesh->cells[static_cast<std::size_t>(start->cell)] : glm::ivec4{0};
    const shared::MeshBlock block = viewBlock(mesh, inputs.mesh->origin, *inputs.camera,
                                              inputs.planeDepth, inputs.size, start, startVertices);
    block_.update(0, std::as_bytes(std::span{&block, 1}));
}

Result<void> CameraVertices::transform(const DrawInputs& inputs, bool carried) {
    const MeshBuffers& mesh = MeshBuffers::of(*inputs.meshGpu);
    const auto program = inputs.programs->compute(
        "mesh/transform.comp.glsl",
        {{"kValuesAt", carried ? shared::kValuesAtVertices : shared::kValuesAtCells}});
    if (!program) return program.error();
    (*program)->use();
    bindBlock();
    mesh.positions.bindTexels(shared::kPositionUnit);
    if (carried) FieldBuffer::of(*inputs.field).values.bindTexels(shared::kFieldUnit);
    vertices_.bindStorage(shared::kVertexStorage);
    dispatchEach(*inputs.device, mesh.vertexCount);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    return inputs.device->check("camera space vertices");
}

void CameraVertices::bindBlock() const {
    block_.bindUniform(shading::shared::kMeshBinding);
}

void CameraVertices::bindVertices() const {
    vertices_.bindTexels(shared::kVertexUnit);
}

}  // namespace volcast::mesh
