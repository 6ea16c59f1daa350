#pragma once

#include <memory>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/base/result.h"
#include "renderer/data/volume.h"
#include "renderer/gpu/buffer.h"

namespace volcast::volume {

/// What is known of the blocks (block_ranges.h) of one channel under one way to interpolate, as
/// rays see its values.
struct ChannelRanges {
    glm::ivec3 grid{0};             ///< Blocks along each axis.
    std::vector<glm::vec2> ranges;  ///< Of all voxels that a block's values are sums of.
    float overshoot = 0.0F;         ///< How far values leave a range to both sides, of its extent.
};

ChannelRanges channelRanges(const data::Volume& volume, const data::Channel& channel,
                            bool tricubic);

/// For each block the range of the voxels within kRangeReach of it, on the GPU: of one channel or
/// of several that are drawn together. Read by shaders/volume/ranges.glsl and channel_ranges.glsl.
class RangeTable {
public:
    /// `channels`: 1 to 4, of one grid.
    ///
    /// Errors: kOutOfGpuMemory.
    static Result<RangeTable> upload(
        gpu::Device& device, std::span<const std::shared_ptr<const ChannelRanges>> channels);

    void bind() const noexcept;

private:
    gpu::Buffer buffer_;
};

}  // namespace volcast::volume
