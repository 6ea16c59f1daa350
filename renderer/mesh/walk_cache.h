#pragma once

#include <cstdint>

#include "renderer/gpu/buffer.h"
#include "renderer/gpu/target.h"
#include "renderer/gpu/texture2d.h"
#include "renderer/mesh/locate.h"
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

    /// Zeroed memory for paused rays of `bytesARay` each, one a pixel, bound to its place.
    ///
    /// Errors: kOutOfGpuMemory, kLimitExceeded.
    Result<void> bindPausedRays(gpu::Device& device, std::size_t bytesARay);

    static WalkCache& of(WalkState& state) { return static_cast<WalkCache&>(state); }

private:
    /// What the contents were made from.
    struct Key {
        std::uint64_t mesh = 0, field = 0, camera = 0;
        int valuesAt = -1;
        friend bool operator==(const Key&, const Key&) = default;
    };

    Result<void> allocate(const DrawInputs& inputs);
    Result<void> lookFrom(const DrawInputs& inputs);
    Result<void> transformVertices(const DrawInputs& inputs);
    Result<void> findEntries(const DrawInputs& inputs);
    Result<void> drawEntries(const DrawInputs& inputs);
    Result<void> growNodes(gpu::Device& device, std::size_t nodes);
    [[nodiscard]] std::uint32_t readCount(std::size_t index) const;

    Key key_;
    gpu::Buffer block_, vertices_, nodes_, counts_, paused_;
    gpu::Texture2D heads_;
    gpu::Target headTarget_;
    int startCell_ = -1;  ///< Where the search for the eye's cell starts next time.
};

}  // namespace volcast::mesh
