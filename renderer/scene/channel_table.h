#pragma once

#include <vector>

#include "renderer/data/transfer_function.h"
#include "renderer/gpu/buffer.h"
#include "renderer/shading/assemble.h"

namespace volcast::scene {

/// The maps of several channels as texels; the layout is described in classify/channel_maps.glsl.
struct ChannelTexels {
    std::vector<glm::vec4> texels;
    int search = 0;  ///< 2 bits a channel.
};
ChannelTexels channelTexels(const std::vector<data::TransferFunction>& maps);

/// The maps of a layer's channels on the GPU.
class ChannelTable {
public:
    /// Uploads `maps` (1 to kMaxChannels, valid, their values as rays see them) unless they are
    /// what the table holds already.
    ///
    /// Errors: kOutOfGpuMemory; the table then stays as it was.
    Result<void> set(gpu::Device& device, const std::vector<data::TransferFunction>& maps);

    void bind() const noexcept;
    [[nodiscard]] std::vector<shading::Constant> constants() const;

private:
    std::vector<data::TransferFunction> maps_;
    int search_ = 0;
    gpu::Buffer buffer_;
};

}  // namespace volcast::scene
