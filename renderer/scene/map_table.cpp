#include "renderer/scene/map_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/shading/shared.h"

namespace volcast::scene {
namespace {

using data::ControlPoint;

constexpr std::size_t kHeaderTexels = 3, kTexelsAPiece = 3;
constexpr std::size_t kComparedPoints = 8;
constexpr std::size_t kCellsAPoint = 4;
constexpr int kMostPiecesACell = 4;  // What two halvings can tell apart.
constexpr float kHuge = std::numeric_limits<float>::max();

glm::vec4 matter(const ControlPoint& point) {
    return {point.colour, point.extinction};
}

/// Slope between two points; 0 at a step, also where the difference is too steep for a float.
glm::vec4 slope(const ControlPoint& from, const ControlPoint& to) {
    const glm::dvec4 rise = glm::dvec4(matter(to)) - glm::dvec4(matter(from));
    const double run = static_cast<double>(to.value) - static_cast<double>(from.value);
    const glm::vec4 ratio = run > 0.0 ? glm::vec4(rise / run) : glm::vec4(0.0F);
    for (int i = 0; i < 4; ++i) {
        if (!std::isfinite(ratio[i])) return glm::vec4(0.0F);
    }
    return ratio;
}

void appendPieces(const std::vector<ControlPoint>& points, std::vector<glm::vec4>& texels) {
    float withExtinction = 0.0F;
    for (std::size_t piece = 0; piece <= points.size(); ++piece) {
        const bool inner = piece > 0 && piece < points.size();
        const ControlPoint& from = points[piece == 0 ? 0 : piece - 1];
        const ControlPoint& to = points[std::min(piece, points.size() - 1)];
        const float below = withExtinction;
        if (from.extinction > 0.0F || to.extinction > 0.0F) withExtinction += 1.0F;
        texels.push_back(matter(from));
        texels.push_back(inner ? slope(from, to) : glm::vec4(0.0F));
        texels.emplace_back(from.value, below, withExtinction, 0.0F);
    }
}

/// A uniform grid over the points' values; each cell knows which pieces it may hold.
struct Grid {
    float begin = 0.0F;
    float cellsAUnit = 0.0F;
    std::vector<glm::ivec2> pieces;  ///< Lowest and highest piece of each cell.
};

Grid gridOf(const std::vector<ControlPoint>& points) {
    const std::size_t cells = points.size() * kCellsAPoint;
    Grid grid{
        .begin = points.front().value,
        .cellsAUnit = static_cast<float>(cells) / (points.back().value - points.front().value),
        .pieces = {}};
    if (!std::isfinite(grid.cellsAUnit)) return grid;
    // The shader's own float32 formula: it is monotone, so a point in a lower cell than a value is
    // below that value, and one in a higher cell above it, whatever the rounding.
    const auto cellOf = [&](float value) {
        const float cell = (value - grid.begin) * grid.cellsAUnit;
        return static_cast<std::size_t>(std::clamp(cell, 0.0F, static_cast<float>(cells) - 1.0F));
    };
    std::vector<int> count(cells + 1, 0);
    for (const ControlPoint& point : points) ++count[cellOf(point.value)];
    int below = 0;
    for (std::size_t cell = 0; cell < cells; ++cell) {
        grid.pieces.emplace_back(below, below + count[cell]);
        below += count[cell];
    }
    return grid;
}

bool narrowEnough(const Grid& grid) {
    return !grid.pieces.empty() && std::ranges::all_of(grid.pieces, [](const glm::ivec2& cell) {
        return cell.y - cell.x < kMostPiecesACell;
    });
}

}  // namespace

MapTexels mapTexels(const data::TransferFunction& map) {
    const std::vector<ControlPoint>& points = map.points;
    MapTexels table;
    table.texels.resize(kHeaderTexels, glm::vec4(kHuge));
    table.texels.reserve(kHeaderTexels + kTexelsAPiece * (points.size() + 1));
    for (std::size_t i = 0; i < std::min(points.size(), kComparedPoints); ++i) {
        table.texels[1 + i / 4][static_cast<int>(i % 4)] = points[i].value;
    }
    appendPieces(points, table.texels);
    Grid grid;
    if (points.size() > kComparedPoints) {
        grid = gridOf(points);
        table.search = narrowEnough(grid) ? MapSearch::kGrid : MapSearch::kHalve;
    }
    table.texels[0] = {static_cast<float>(points.size()), static_cast<float>(grid.pieces.size()),
                       grid.begin, grid.cellsAUnit};
    if (table.search != MapSearch::kGrid) return table;
    for (const glm::ivec2& cell : grid.pieces) table.texels.emplace_back(cell.x, cell.y, 0, 0);
    return table;
}

Result<void> MapTable::set(gpu::Device& device, const data::TransferFunction& map) {
    if (buffer_.valid() && map == map_) return {};
    const MapTexels table = mapTexels(map);
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
    map_ = map;
    search_ = table.search;
    return {};
}

void MapTable::bind() const noexcept {
    buffer_.bindUniform(shading::shared::kMapBinding, 0, kHeaderTexels * sizeof(glm::vec4));
    buffer_.bindTexels(shading::shared::kMapUnit);
}

shading::Constant MapTable::constant() const {
    return {.name = "kMapSearch", .value = static_cast<int>(search_)};
}

}  // namespace volcast::scene
