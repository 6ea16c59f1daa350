#include "renderer/mesh/projection_cache.h"

#include <span>

#include "renderer/mesh/mesh_buffers.h"
#include "renderer/mesh/shared.h"
#include "renderer/shading/shared.h"

namespace volcast::mesh {

Result<void> ProjectionCache::prepare(const DrawInputs& inputs, bool sorted) {
    if (auto done = camera_.prepare(inputs); !done) return done;
    if (auto done = findCorners(inputs); !done) return done;
    sorted_ = sorted;
    cellsDrawn_ = inputs.mesh->cells.size();
    if (sorted) {
        if (auto done = sort(inputs); !done) return done;
    }
    return shares_.fit(*inputs.device, inputs.size, "shares of cells");
}

Result<void> ProjectionCache::prepareLevels(const DrawInputs& inputs) {
    if (auto done = camera_.prepare(inputs); !done) return done;
    if (auto done = findCorners(inputs); !done) return done;
    sorted_ = false;
    if (auto done = levels_.prepare(inputs, corners_); !done) return done;
    cellsDrawn_ = static_cast<std::uint64_t>(levels_.count());
    return {};
}

Result<void> ProjectionCache::findCorners(const DrawInputs& inputs) {
    const MeshBuffers& mesh = MeshBuffers::of(*inputs.meshGpu);
    if (cornersMesh_ == mesh.serial) return {};
    cornersMesh_ = 0;
    const std::span<const glm::ivec4> cells = inputs.mesh->cells.span();
    auto made = gpu::Buffer::create(*inputs.device,
                                    {.bytes = cells.size_bytes(),
                                     .texels = gpu::TexelFormat::kRgba32I,
                                     .label = "corners of cells"},
                                    std::as_bytes(cells));
    if (!made) return made.error();
    corners_ = std::move(*made);
    cornersMesh_ = mesh.serial;
    return {};
}

Result<void> ProjectionCache::sort(const DrawInputs& inputs) {
    const MeshBuffers& mesh = MeshBuffers::of(*inputs.meshGpu);
    if (orderMesh_ != mesh.serial) {
        order_.emplace(*inputs.mesh);
        orderMesh_ = mesh.serial;
        orderCamera_ = 0;
    }
    if (orderCamera_ == camera_.version()) return {};
    const bool perspective = inputs.camera->projection == scene::Projection::kPerspective;
    const auto order =
        order_->sort({.perspective = perspective,
                      .at = perspective ? camera_.eye() : scene::frame(*inputs.camera).forward});
    if (!cells_.valid() || cells_.bytes() != order.size_bytes()) {
        cells_ = {};
        auto made = gpu::Buffer::create(*inputs.device, {.bytes = order.size_bytes(),
                                                         .updatable = true,
                                                         .texels = gpu::TexelFormat::kR32I,
                                                         .label = "order of cells"});
        if (!made) return made.error();
        cells_ = std::move(*made);
    }
    cells_.update(0, std::as_bytes(order));
    orderCamera_ = camera_.version();
    return {};
}

void ProjectionCache::bind(const DrawInputs& inputs) const {
    camera_.bindBlock();
    camera_.bindVertices();
    corners_.bindTexels(shared::kCornerUnit);
    if (sorted_) cells_.bindTexels(shared::kOrderUnit);
    if (inputs.field != nullptr) {
        FieldBuffer::of(*inputs.field).values.bindTexels(shared::kFieldUnit);
    }
    if (inputs.density != nullptr) {
        FieldBuffer::of(*inputs.density).values.bindTexels(shared::kDensityUnit);
    }
}

void ProjectionCache::bindShares() const {
    shares_.bind(shading::shared::kShareUnit);
}

OrderReport ProjectionCache::order() const {
    return sorted_ && order_ ? order_->report() : OrderReport{};
}

}  // namespace volcast::mesh
