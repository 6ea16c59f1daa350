#include "renderer/scene/map_table.h"

#include <algorithm>
#include <span>

#include "renderer/shading/shared.h"

namespace volcast::scene {

namespace {

constexpr std::size_t kHeaderBytes = kMapHeaderTexels * sizeof(glm::vec4);

}  // namespace

Result<void> MapTable::set(gpu::Device& device, const MapContent& content) {
    if (buffer_.valid() && content == content_) return {};
    const MapTexels table = mapTexels(content);
    const auto bytes = std::as_bytes(std::span{table.texels});
    if (buffer_.bytes() >= bytes.size()) {
        buffer_.update(0, bytes);
    } else {
        // Room for a few more points, so that adding one while editing stays an update.
        Result<gpu::Buffer> buffer = gpu::Buffer::create(device,
                                                         {.bytes = bytes.size() * 2,
                                                          .updatable = true,
                                                          .texels = gpu::TexelFormat::kRgba32F,
                                                          .label = "transfer function"},
                                                         bytes);
        if (!buffer) return buffer.error();
        buffer_ = std::move(*buffer);
    }
    content_ = content;
    search_ = table.search;
    densitySearch_ = table.densitySearch;
    slopes_ = table.slopes;
    densitySlopes_ = table.densitySlopes;
    return {};
}

void MapTable::bind() const noexcept {
    buffer_.bindUniform(shading::shared::kMapBinding, 0, kHeaderBytes);
    buffer_.bindTexels(shading::shared::kMapUnit);
}

std::vector<float> MapTable::levels() const {
    std::vector<float> values;
    for (const LevelColour& level : content_.levels) values.push_back(level.value);
    return values;
}

std::vector<shading::Constant> MapTable::constants() const {
    return {{.name = "kMapSearch", .value = static_cast<int>(search_)},
            {.name = "kDensitySearch", .value = static_cast<int>(densitySearch_)},
            {.name = "kMapSlopes", .value = slopes_},
            {.name = "kDensitySlopes", .value = densitySlopes_},
            {.name = "kTwoMaps", .value = !content_.densityMap.points.empty()},
            {.name = "kPreintegratedSide", .value = kPreintegratedSide}};
}

}  // namespace volcast::scene
