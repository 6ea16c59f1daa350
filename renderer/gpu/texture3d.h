#pragma once

#include <cstddef>
#include <span>

#include <glm/glm.hpp>

#include "renderer/base/result.h"
#include "renderer/gpu/handle.h"

namespace volcast::gpu {

/// kR8U to kR32U: read as they are, by usampler3D and texelFetch().
enum class VoxelFormat { kF32, kRg32F, kRgba32F, kR8U, kR16U, kR32U };

struct Texture3DDesc {
    glm::ivec3 size{1};  ///< Voxels along x, y, z; each in [1, DeviceLimits::texture3DSide].
    VoxelFormat format = VoxelFormat::kF32;
    bool linear = false;     ///< texture() filters linearly; otherwise the nearest voxel.
    const char* label = "";  ///< Shown by GL debuggers and in error messages.
};

/// A grid of numbers in GPU memory, clamped at its faces.
class Texture3D {
public:
    /// Allocates; the content is undefined until upload().
    ///
    /// Errors: kLimitExceeded (size), kOutOfGpuMemory.
    static Result<Texture3D> create(Device& device, const Texture3DDesc& desc);

    Texture3D() = default;

    /// Fills the slices [firstSlice, firstSlice + slices): x fastest, no row padding. Volumes go
    /// up in pieces, so that a converted copy of a large one never exists as a whole.
    ///
    /// Errors: kInvalidArgument (size disagrees), kOutOfGpuMemory.
    Result<void> upload(int firstSlice, int slices, std::span<const std::byte> voxels);
    /// Fills the box of `size` from `first` on; likewise.
    Result<void> upload(glm::ivec3 first, glm::ivec3 size, std::span<const std::byte> voxels);

    void bind(unsigned unit) const noexcept { glBindTextureUnit(unit, handle_.name()); }
    [[nodiscard]] glm::ivec3 size() const noexcept { return size_; }
    [[nodiscard]] bool valid() const noexcept { return static_cast<bool>(handle_); }

private:
    Device* device_ = nullptr;
    TextureHandle handle_;
    glm::ivec3 size_{0};
    VoxelFormat format_ = VoxelFormat::kF32;
};

}  // namespace volcast::gpu
