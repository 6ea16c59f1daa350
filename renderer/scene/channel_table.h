#pragma once

#include <optional>
#include <vector>

#include "renderer/data/transfer_function.h"
#include "renderer/gpu/buffer.h"
#include "renderer/shading/assemble.h"

namespace volcast::scene {

/// How values of one channel are shown, as rays see them.
struct DrawnChannel {
    data::TransferFunction map;
    std::optional<data::Range> interval;
    friend bool operator==(const DrawnChannel&, const DrawnChannel&) = default;
};

/// Several channels as texels; the layout is described in classify/channel_maps.glsl.
struct ChannelTexels {
    std::vector<glm::vec4> texels;
    int search = 0;  ///< 2 bits a channel.
};
ChannelTexels channelTexels(const std::vector<DrawnChannel>& channels);

/// The maps of a layer's channels on the GPU.
class ChannelTable {
public:
    /// Uploads `channels` (1 to kMaxChannels, valid) unless they are what the table holds already.
    ///
    /// Errors: kOutOfGpuMemory; the table then stays as it was.
    Result<void> set(gpu::Device& device, const std::vector<DrawnChannel>& channels);

    void bind() const noexcept;
    [[nodiscard]] std::vector<shading::Constant> constants() const;

private:
    std::vector<DrawnChannel> channels_;
    int search_ = 0;
    gpu::Buffer buffer_;
};

}  // namespace volcast::scene
