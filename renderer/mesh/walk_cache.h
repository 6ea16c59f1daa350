#pragma once

#include <cstdint>

#include "renderer/gpu/buffer.h"
#include "renderer/gpu/target.h"
#include "renderer/gpu/texture2d.h"
#include "renderer/mesh/camera_vertices.h"
#include "renderer/mesh/walk.h"

namespace volcast::mesh {

/// What stands behind WalkState: all that depends on the camera and not on the map.
class WalkCache final : public WalkState {
public:
    /// Makes everything fit `inputs`; what is still right is kept. Binds nothing.
    ///
    /// Errors: kShaderBuild, kOutOfGpuMemory, kLimitExceeded, kDeviceLost.
    Result<void> prepare(const DrawInputs& inputs);

    /// Binds the mesh block, vertices, entries and the records of the mesh and its field.
    void bind(const DrawInputs& inputs) const;

    /// Sets the counts to 0, so that a pass can add to them.
    void clearCounts() const;
    /// Rays that the last pass could not finish. Waits for the GPU.
    [[nodiscard]] std::uint32_t unfinishedRays() const;

    /// Begins and goes on to add up what draws count. addSteps() waits for the GPU.
    void clearSteps() noexcept { steps_ = 0; }
    void addSteps();
    [[nodiscard]] std::uint64_t steps() const override { return steps_; }

    /// Zeroed memory for paused rays of `bytesARay` each, one a pixel, bound to its place.
    ///
    /// Errors: kOutOfGpuMemory, kLimitExceeded.
    Result<void> bindPausedRays(gpu::Device& device, std::size_t bytesARay);

    static WalkCache& of(WalkState& state) { return static_cast<WalkCache&>(state); }

private:
    Result<void> allocate(const DrawInputs& inputs);
    Result<void> findEntries(const DrawInputs& inputs);
    Result<void> drawEntries(const DrawInputs& inputs);
    Result<void> growNodes(gpu::Device& device, std::size_t nodes);
    [[nodiscard]] std::uint32_t readCount(std::size_t index) const;

    CameraVertices camera_;
    std::uint64_t steps_ = 0;
    std::uint64_t entriesOf_ = 0;  ///< The version of `camera_` whose entries these are.
    gpu::Buffer nodes_, counts_, paused_;
    gpu::Texture2D heads_;
    gpu::Target headTarget_;
};

}  // namespace volcast::mesh
