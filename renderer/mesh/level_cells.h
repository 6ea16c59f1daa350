#pragma once

#include <cstdint>
#include <vector>

#include "renderer/gpu/buffer.h"
#include "renderer/mesh/walk.h"

namespace volcast::mesh {

/// Which cells meet which levels of a field: all that is drawn of an isosurface.
class LevelCells {
public:
    /// Lists them for `inputs`, unless the mesh, the field and the levels are those of before.
    /// `corners`: a texel a cell. Waits for the GPU.
    ///
    /// Errors: kShaderBuild, kOutOfGpuMemory, kLimitExceeded.
    Result<void> prepare(const DrawInputs& inputs, const gpu::Buffer& corners);

    /// Binds the levels and the list.
    void bind() const;

    /// Pairs of a cell and a level that it meets.
    [[nodiscard]] int count() const noexcept { return count_; }

private:
    struct Key {
        std::uint64_t mesh = 0;
        std::uint64_t field = 0;
        std::vector<float> levels;
        friend bool operator==(const Key&, const Key&) = default;
    };

    Result<void> upload(const DrawInputs& inputs);
    /// Runs over all cells; lists as many as `list_` holds. Returns how many there are.
    Result<std::uint32_t> list(const DrawInputs& inputs, const gpu::Buffer& corners);

    Key key_;
    gpu::Buffer values_, list_, found_;
    int count_ = 0;
};

}  // namespace volcast::mesh
