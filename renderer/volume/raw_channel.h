#pragma once

#include "renderer/base/result.h"
#include "renderer/data/volume.h"
#include "renderer/gpu/texture3d.h"

namespace volcast::volume {

/// One channel of a volume on the GPU for code that users write: float32 values as they are, which
/// is exact for 8 and 16 bits. Shared by all views.
class RawChannel {
public:
    /// Errors: kLimitExceeded (too many voxels along an axis), kOutOfGpuMemory.
    static Result<RawChannel> upload(gpu::Device& device, const data::Volume& volume,
                                     const data::Channel& channel);

    void bind(unsigned unit) const noexcept { voxels_.bind(unit); }

private:
    gpu::Texture3D voxels_;
};

}  // namespace volcast::volume
