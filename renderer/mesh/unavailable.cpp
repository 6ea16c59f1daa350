// Stands in until the walk exists, so that everything above it links; goes with walk.cpp.
#include "renderer/mesh/walk.h"

namespace volcast::mesh {
namespace {

Error missing() { return fail(ErrorCode::kUnsupported, "this build draws no meshes"); }

class EmptyWalkState final : public WalkState {};

}  // namespace

Result<std::unique_ptr<MeshGpu>> MeshGpu::upload(gpu::Device&, const data::Mesh&) {
    return missing();
}

Result<std::unique_ptr<FieldGpu>> FieldGpu::upload(gpu::Device&, const data::Mesh&,
                                                   const data::Field&, int) {
    return missing();
}

std::unique_ptr<WalkState> WalkState::create() { return std::make_unique<EmptyWalkState>(); }

Result<void> drawWalk(const DrawInputs&, WalkState&) { return missing(); }

Result<void> drawSurface(const DrawInputs&) { return missing(); }

}  // namespace volcast::mesh
