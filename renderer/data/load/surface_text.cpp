// OFF, .poly and .smesh: surfaces as text.

#include <utility>

#include "renderer/data/load/node_file.h"
#include "renderer/data/load/surface_files.h"
#include "renderer/data/load/text_lines.h"

namespace volcast::data::load {

namespace {

Result<glm::dvec3> readPoint(const TextLines& lines, std::size_t firstWord) {
    glm::dvec3 point{0.0};
    for (int axis = 0; axis < 3; ++axis) {
        const auto value = lines.number(firstWord + static_cast<std::size_t>(axis));
        if (!value) return value.error();
        point[axis] = *value;
    }
    return point;
}

/// A count and as many point indices, from word `at` on; may go on over the next lines.
Result<std::vector<std::int64_t>> readRing(TextLines& lines, std::size_t at, std::int64_t first) {
    const auto count = lines.count(at, "corners", 2);
    if (!count) return count.error();
    std::vector<std::int64_t> ring;
    ++at;
    while (ring.size() < *count) {
        if (at == lines.words().size()) {
            auto done = lines.need(1, "the rest of a polygon");
            if (!done) return done.error();
            at = 0;
        }
        const auto vertex = lines.integer(at++);
        if (!vertex) return vertex.error();
        ring.push_back(*vertex - first);
    }
    return ring;
}

/// Number at word `i`, or 0 where the line is shorter.
Result<std::size_t> optionalCount(const TextLines& lines, std::size_t i, const char* what) {
    if (i >= lines.words().size()) return std::size_t{0};
    return lines.count(i, what, 2);
}

/// A facet of a .poly file: polygons, then points in what is cut out.
Result<Facet> readPolyFacet(TextLines& lines, std::int64_t first) {
    auto done = lines.need(1, "a facet");
    if (!done) return done.error();
    const auto polygons = lines.count(0, "polygons", 4);
    if (!polygons) return polygons.error();
    const auto holes = optionalCount(lines, 1, "holes");
    if (!holes) return holes.error();
    Facet facet;
    for (std::size_t p = 0; p < *polygons; ++p) {
        done = lines.need(1, "a polygon");
        if (!done) return done.error();
        auto ring = readRing(lines, 0, first);
        if (!ring) return ring.error();
        facet.polygons.push_back(std::move(*ring));
    }
    for (std::size_t h = 0; h < *holes; ++h) {
        done = lines.need(4, "a hole of a facet");
        if (!done) return done.error();
        const auto point = readPoint(lines, 1);
        if (!point) return point.error();
        facet.holes.push_back(*point);
    }
    return facet;
}

Result<void> readFacets(TextLines& lines, bool smesh, std::int64_t first, Surface& surface) {
    auto done = lines.need(1, "the number of facets");
    if (!done) return done;
    const auto count = lines.count(0, "facets", 4);
    if (!count) return count.error();
    for (std::size_t f = 0; f < *count; ++f) {
        if (!smesh) {
            auto facet = readPolyFacet(lines, first);
            if (!facet) return facet.error();
            surface.facets.push_back(std::move(*facet));
            continue;
        }
        done = lines.need(1, "a facet");
        if (!done) return done;
        auto ring = readRing(lines, 0, first);
        if (!ring) return ring.error();
        surface.facets.push_back({.polygons = {std::move(*ring)}});
    }
    return {};
}

/// Points in hollows, then regions; both lists may be missing.
Result<void> readHolesAndRegions(TextLines& lines, Surface& surface) {
    if (!lines.next()) return {};
    const auto holes = lines.count(0, "holes", 8);
    if (!holes) return holes.error();
    for (std::size_t h = 0; h < *holes; ++h) {
        auto done = lines.need(4, "a hole");
        if (!done) return done;
        const auto point = readPoint(lines, 1);
        if (!point) return point.error();
        surface.holes.push_back(*point);
    }
    if (!lines.next()) return {};
    const auto regions = lines.count(0, "regions", 8);
    if (!regions) return regions.error();
    for (std::size_t r = 0; r < *regions; ++r) {
        auto done = lines.need(5, "a region");
        if (!done) return done;
        const auto point = readPoint(lines, 1);
        const auto attribute = lines.number(4);
        const auto volume = lines.words().size() > 5 ? lines.number(5) : Result<double>{-1.0};
        if (!point) return point.error();
        if (!attribute) return attribute.error();
        if (!volume) return volume.error();
        surface.regions.push_back({*point, *attribute, *volume});
    }
    return {};
}

}  // namespace

Result<Surface> parseOff(const std::string& path, std::string_view text) {
    TextLines lines{path, text};
    auto done = lines.need(1, "OFF");
    if (!done) return done.error();
    if (lines.words()[0] != "OFF") return lines.error("is no OFF file: it does not start with OFF");
    std::size_t at = 1;
    if (lines.words().size() == 1) {
        done = lines.need(2, "the numbers of points and faces");
        if (!done) return done.error();
        at = 0;
    }
    const auto points = lines.count(at, "points", 6);
    if (!points) return points.error();
    const auto faces = lines.count(at + 1, "faces", 6);
    if (!faces) return faces.error();
    Surface surface;
    for (std::size_t i = 0; i < *points; ++i) {
        done = lines.need(3, "point " + std::to_string(i) + " of " + std::to_string(*points));
        if (!done) return done.error();
        const auto point = readPoint(lines, 0);
        if (!point) return point.error();
        surface.points.push_back(*point);
    }
    for (std::size_t f = 0; f < *faces; ++f) {
        done = lines.need(4, "face " + std::to_string(f) + " of " + std::to_string(*faces));
        if (!done) return done.error();
        auto ring = readRing(lines, 0, 0);
        if (!ring) return ring.error();
        surface.facets.push_back({.polygons = {std::move(*ring)}});
    }
    return surface;
}

Result<Surface> parsePoly(const std::string& path, std::string_view text, std::string_view nodes) {
    TextLines lines{path, text};
    auto list = readNodes(lines);
    if (!list) return list.error();
    if (list->points.empty()) {
        if (nodes.empty())
            return lines.error("has no points, and there is no .node file beside it");
        TextLines nodeLines{path.substr(0, path.rfind('.')) + ".node", nodes};
        list = readNodes(nodeLines);
        if (!list) return list.error();
    }
    Surface surface{.points = std::move(list->points), .attributes = std::move(list->attributes)};
    auto done = readFacets(lines, path.ends_with(".smesh"), list->first, surface);
    if (done) done = readHolesAndRegions(lines, surface);
    if (!done) return done.error();
    return surface;
}

}  // namespace volcast::data::load
