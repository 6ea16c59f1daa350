#include "renderer/scene/map_texels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace volcast::scene {
namespace {

using data::ControlPoint;

constexpr std::size_t kHeaderOfMap = 13;                    // Texels.
constexpr std::size_t kScales = 3, kBelow = 5, kRises = 6;  // Places in it.
constexpr std::size_t kMostSlopes = 7;
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

/// The points between which a piece runs; the same one twice for those at both ends.
std::pair<const ControlPoint*, const ControlPoint*> endsOf(const std::vector<ControlPoint>& points,
                                                           std::size_t piece) {
    return {&points[piece == 0 ? 0 : piece - 1], &points[std::min(piece, points.size() - 1)]};
}

/// For each piece the value below which nothing from the piece's begin on has extinction.
std::vector<float> transparentUpTo(const std::vector<ControlPoint>& points) {
    std::vector<float> ends(points.size() + 1, kHuge);
    float end = kHuge;
    for (std::size_t piece = points.size() + 1; piece-- > 0;) {
        const auto [from, to] = endsOf(points, piece);
        const bool absorbs = from->extinction > 0.0F || to->extinction > 0.0F;
        if (absorbs) end = piece == 0 ? -kHuge : from->value;
        ends[piece] = absorbs ? -kHuge : end;
    }
    return ends;
}

void appendPieces(const std::vector<ControlPoint>& points, std::vector<glm::vec4>& texels) {
    const std::vector<float> transparent = transparentUpTo(points);
    for (std::size_t piece = 0; piece <= points.size(); ++piece) {
        const bool inner = piece > 0 && piece < points.size();
        const auto [from, to] = endsOf(points, piece);
        texels.push_back(matter(*from));
        texels.push_back(inner ? slope(*from, *to) : glm::vec4(0.0F));
        const float end = piece < points.size() ? points[piece].value : kHuge;
        texels.emplace_back(from->value, transparent[piece], 0.0F, end);
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

/// How a map is found, and of how many slopes it is the sum.
struct Found {
    MapSearch search = MapSearch::kCompareAll;
    int slopes = 0;
};

/// The sum that the shader makes, in its own order and precision.
glm::vec4 sumOfSlopes(const std::vector<glm::vec4>& texels, std::size_t header, float value) {
    glm::vec4 matter = texels[header + kBelow];
    for (std::size_t i = 0; i < kMostSlopes; ++i) {
        const int part = static_cast<int>(i % 4);
        const float share =
            (value - texels[header + 1 + i / 4][part]) * texels[header + kScales + i / 4][part];
        matter += std::clamp(share, 0.0F, 1.0F) * texels[header + kRises + i];
    }
    return matter;
}

/// Whether the sum is as good as looking a piece up: at points, where its terms cancel worst, it
/// gives what the map says to a millionth, and 0 where that is 0.
bool sumIsExact(const std::vector<ControlPoint>& points, const std::vector<glm::vec4>& texels,
                std::size_t header) {
    constexpr float kTolerance = 1e-6F;
    return std::ranges::all_of(points, [&](const ControlPoint& point) {
        const glm::vec4 wanted = matter(point);
        const glm::vec4 made = sumOfSlopes(texels, header, point.value);
        for (int i = 0; i < 4; ++i) {
            if (!(std::abs(made[i] - wanted[i]) <= kTolerance * std::abs(wanted[i]))) return false;
        }
        return true;
    });
}

/// Fills the sum's part of the header. A step has no slope: maps with one are looked up.
Found fillSlopes(const std::vector<ControlPoint>& points, std::size_t header,
                 std::vector<glm::vec4>& texels) {
    for (std::size_t i = kScales; i < kHeaderOfMap; ++i) texels[header + i] = glm::vec4(0.0F);
    texels[header + kBelow] = matter(points.front());
    if (points.size() > kMostSlopes + 1) return {};
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const double width =
            static_cast<double>(points[i + 1].value) - static_cast<double>(points[i].value);
        const auto scale = static_cast<float>(1.0 / width);
        if (!std::isfinite(scale)) return {};
        texels[header + kScales + i / 4][static_cast<int>(i % 4)] = scale;
        texels[header + kRises + i] = matter(points[i + 1]) - matter(points[i]);
    }
    if (!sumIsExact(points, texels, header)) return {};
    constexpr std::size_t kFew = 4;
    return {.search = MapSearch::kSlopes,
            .slopes = static_cast<int>(points.size() <= kFew + 1 ? kFew : kMostSlopes)};
}

/// Header, pieces and grid of one map.
Found appendMap(const data::TransferFunction& map, std::size_t header,
                std::vector<glm::vec4>& texels) {
    const std::vector<ControlPoint>& points = map.points;
    for (std::size_t i = 0; i < std::min(points.size(), kComparedPoints); ++i) {
        texels[header + 1 + i / 4][static_cast<int>(i % 4)] = points[i].value;
    }
    appendPieces(points, texels);
    Found found = fillSlopes(points, header, texels);
    Grid grid;
    if (points.size() > kComparedPoints) {
        grid = gridOf(points);
        found.search = narrowEnough(grid) ? MapSearch::kGrid : MapSearch::kHalve;
    }
    texels[header] = {static_cast<float>(points.size()), static_cast<float>(grid.pieces.size()),
                      grid.begin, grid.cellsAUnit};
    if (found.search != MapSearch::kGrid) return found;
    for (const glm::ivec2& cell : grid.pieces) texels.emplace_back(cell.x, cell.y, 0, 0);
    return found;
}

void append(std::vector<glm::vec4>& texels, const std::vector<glm::vec4>& section) {
    texels.insert(texels.end(), section.begin(), section.end());
}

}  // namespace

std::vector<glm::vec4> largestColours(const data::TransferFunction& map) {
    const std::size_t count = map.points.size();
    std::vector<glm::vec4> table;
    for (const ControlPoint& point : map.points) table.emplace_back(point.colour, 0.0F);
    for (std::size_t half = 1; 2 * half <= count; half *= 2) {
        const std::size_t row = table.size() - count;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t other = std::min(i + half, count - 1);
            table.push_back(glm::max(table[row + i], table[row + other]));
        }
    }
    return table;
}

MapTexels mapTexels(const MapContent& content) {
    MapTexels table;
    table.texels.resize(kMapHeaderTexels, glm::vec4(kHuge));
    const Found found = appendMap(content.map, 0, table.texels);
    table.search = found.search;
    table.slopes = found.slopes;
    glm::vec4 sections{0.0F};
    const auto here = [&table] { return static_cast<float>(table.texels.size()); };
    if (!content.densityMap.points.empty()) {
        sections.x = here();
        const Found second = appendMap(content.densityMap, kHeaderOfMap, table.texels);
        table.densitySearch = second.search;
        table.densitySlopes = second.slopes;
    }
    sections.y = here();
    for (const LevelColour& level : content.levels) {
        table.texels.emplace_back(level.value, level.colour.r, level.colour.g, level.colour.b);
    }
    if (content.largestColours) {
        sections.z = here();
        append(table.texels, largestColours(content.map));
    }
    if (content.preintegrated) {
        sections.w = here();
        append(table.texels, preintegrated(content.map));
    }
    table.texels[kMapHeaderTexels - 2] = sections;
    table.texels[kMapHeaderTexels - 1] = {static_cast<float>(content.levels.size()),
                                          content.map.points.front().value,
                                          content.map.points.back().value, 0.0F};
    return table;
}

}  // namespace volcast::scene
