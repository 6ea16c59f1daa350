#include "renderer/scene/channel_table.h"

#include "renderer/scene/map_texels.h"
#include "renderer/scene/texel_buffer.h"
#include "renderer/shading/shared.h"

namespace volcast::scene {

ChannelTexels channelTexels(const std::vector<data::TransferFunction>& maps) {
    ChannelTexels all{.texels = {glm::vec4{0.0F}}};
    for (std::size_t i = 0; i < maps.size(); ++i) {
        const MapTexels one = mapTexels({.map = maps[i]});
        // Exact in a float: 4 maps of 1024 points take less than 2^15 texels.
        all.texels.front()[static_cast<int>(i)] = static_cast<float>(all.texels.size());
        all.search |= static_cast<int>(one.search) << (2 * i);
        all.texels.insert(all.texels.end(), one.texels.begin(), one.texels.end());
    }
    return all;
}

Result<void> ChannelTable::set(gpu::Device& device,
                               const std::vector<data::TransferFunction>& maps) {
    if (buffer_.valid() && maps == maps_) return {};
    const ChannelTexels table = channelTexels(maps);
    const Result<void> filled = refill(device, buffer_, table.texels, "maps of channels");
    if (!filled) return filled;
    maps_ = maps;
    search_ = table.search;
    return {};
}

void ChannelTable::bind() const noexcept {
    buffer_.bindTexels(shading::shared::kMapUnit);
}

std::vector<shading::Constant> ChannelTable::constants() const {
    return {{.name = "kChannels", .value = static_cast<int>(maps_.size())},
            {.name = "kChannelSearch", .value = search_}};
}

}  // namespace volcast::scene
