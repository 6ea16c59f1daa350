#include "renderer/scene/channel_table.h"

#include <limits>

#include "renderer/scene/map_texels.h"
#include "renderer/scene/texel_buffer.h"
#include "renderer/shading/shared.h"

namespace volcast::scene {

ChannelTexels channelTexels(const std::vector<DrawnChannel>& channels) {
    constexpr float kHuge = std::numeric_limits<float>::max();
    ChannelTexels all{.texels = {glm::vec4{0.0F}, glm::vec4{-kHuge}, glm::vec4{kHuge}}};
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const MapTexels one = mapTexels({.map = channels[i].map});
        // Exact in a float: 4 maps of 1024 points take less than 2^15 texels.
        all.texels.front()[static_cast<int>(i)] = static_cast<float>(all.texels.size());
        if (channels[i].interval) {
            all.texels[1][static_cast<int>(i)] = channels[i].interval->min;
            all.texels[2][static_cast<int>(i)] = channels[i].interval->max;
        }
        all.search |= static_cast<int>(one.search) << (2 * i);
        all.texels.insert(all.texels.end(), one.texels.begin(), one.texels.end());
    }
    return all;
}

Result<void> ChannelTable::set(gpu::Device& device, const std::vector<DrawnChannel>& channels) {
    if (buffer_.valid() && channels == channels_) return {};
    const ChannelTexels table = channelTexels(channels);
    Result<void> filled = refill(device, buffer_, table.texels, "maps of channels");
    if (!filled) return filled;
    channels_ = channels;
    search_ = table.search;
    return {};
}

void ChannelTable::bind() const noexcept {
    buffer_.bindTexels(shading::shared::kMapUnit);
}

std::vector<shading::Constant> ChannelTable::constants() const {
    return {{.name = "kChannels", .value = static_cast<int>(channels_.size())},
            {.name = "kChannelSearch", .value = search_}};
}

}  // namespace volcast::scene
