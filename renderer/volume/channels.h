#pragma once

#include <span>

#include "renderer/volume/march.h"

namespace volcast::volume {

/// Several channels of a volume on the GPU, side by side in the texels of one float32 texture.
///
/// Each has a map, an interval and a light of its own: the slope that turns a light is that of the
/// channel's field, as VTK's independent components have it. A slope of all matter together would
/// show edges of one channel on the others.
class ChannelsGpu {
public:
    /// `channels`: 1 to 4 of `volume`.
    ///
    /// Errors: kLimitExceeded (too many voxels along an axis), kOutOfGpuMemory.
    static Result<ChannelsGpu> upload(gpu::Device& device, const data::Volume& volume,
                                      std::span<const data::Channel* const> channels);

    void bind() const noexcept;

private:
    gpu::Texture3D voxels_;
};

/// Draws a layer's channels over what is in the target; `inputs.channel` is not looked at. Their
/// maps, the layer block and the opaque distances are bound by the caller.
///
/// Errors: kShaderBuild.
Result<void> drawChannels(const DrawInputs& inputs, const ChannelsGpu& channels);

}  // namespace volcast::volume
