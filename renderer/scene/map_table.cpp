#include "renderer/scene/map_table.h"

#include "renderer/scene/texel_buffer.h"
#include "renderer/shading/shared.h"

namespace volcast::scene {

namespace {

constexpr std::size_t kHeaderBytes = kMapHeaderTexels * sizeof(glm::vec4);

}  // namespace

Result<void> MapTable::set(gpu::Device& device, const MapContent& content) {
    if (buffer_.valid() && content == content_) return {};
    const MapTexels table = mapTexels(content);
    Result<void> filled = refill(device, buffer_, table.texels, "transfer function");
    if (!filled) return filled;
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
