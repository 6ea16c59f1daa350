#include "renderer/volume/channel_ranges.h"

#include <cstddef>

#include "renderer/plan/plan.h"
#include "renderer/scene/scale.h"
#include "renderer/shading/shared.h"
#include "renderer/volume/block_ranges.h"

namespace volcast::volume {

ChannelRanges channelRanges(const data::Volume& volume, const data::Channel& channel,
                            bool tricubic) {
    ChannelRanges known{.grid = blockGrid(volume.size),
                        .ranges = blockRanges(volume, channel, tricubic ? 1 : 0),
                        .overshoot = tricubic ? plan::kTricubicOvershoot : 0.0F};
    // As maps, intervals and levels are: relative to the range where that lies far from 0.
    const scene::ScaleFunction scale{scene::Scale{}, channel.range};
    if (scale.identity()) return known;
    for (glm::vec2& range : known.ranges) {
        if (range.x <= range.y) range = {scale.ofData(range.x), scale.ofData(range.y)};
    }
    return known;
}

Result<RangeTable> RangeTable::upload(
    gpu::Device& device, std::span<const std::shared_ptr<const ChannelRanges>> channels) {
    static_assert(kRangeReach == kRangeBlock);  // One block more on all sides.
    // Two texels a block: the smallest values, then the largest; a component a channel.
    const std::size_t components = channels.size() == 1 ? 1 : 4;
    std::vector<float> texels;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        const std::vector<glm::vec2> reached = joinedAround(channels[c]->ranges, channels[c]->grid);
        texels.resize(2 * components * reached.size());
        for (std::size_t i = 0; i < reached.size(); ++i) {
            texels[2 * i * components + c] = reached[i].x;
            texels[(2 * i + 1) * components + c] = reached[i].y;
        }
    }
    const auto bytes = std::as_bytes(std::span{texels});
    auto buffer = gpu::Buffer::create(
        device,
        {.bytes = bytes.size(),
         .texels = components == 1 ? gpu::TexelFormat::kR32F : gpu::TexelFormat::kRgba32F,
         .label = "block ranges"},
        bytes);
    if (!buffer) return buffer.error();
    RangeTable table;
    table.buffer_ = std::move(*buffer);
    return table;
}

void RangeTable::bind() const noexcept {
    buffer_.bindTexels(shading::shared::kBrickUnit);
}

}  // namespace volcast::volume
