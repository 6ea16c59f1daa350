#include "renderer/data/load/tetgen_mesh.h"

#include <array>
#include <limits>
#include <utility>

#include "renderer/data/load/file.h"
#include "renderer/data/load/mixed_mesh.h"
#include "renderer/data/load/node_file.h"
#include "renderer/data/load/tetrahedralize.h"

namespace volcast::data::load {

namespace {

/// Ends of the edges that points 4 to 9 of a quadratic tetrahedron are the middles of.
constexpr std::array<std::array<std::size_t, 2>, 6> kEdges{
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

/// Puts mid-edge points, whatever order the program that wrote them has, into VTK's order.
Result<void> sortMiddles(std::int64_t* cell, const std::vector<glm::dvec3>& points,
                         const TextLines& lines) {
    const auto at = [&](std::size_t i) { return points[static_cast<std::size_t>(cell[i])]; };
    std::array<std::int64_t, 6> sorted{};
    std::array<bool, 6> taken{};
    for (std::size_t edge = 0; edge < kEdges.size(); ++edge) {
        const glm::dvec3 middle = 0.5 * (at(kEdges.at(edge)[0]) + at(kEdges.at(edge)[1]));
        double nearest = std::numeric_limits<double>::infinity();
        std::size_t best = 0;
        for (std::size_t i = 0; i < 6; ++i) {
            const glm::dvec3 offset = at(4 + i) - middle;
            if (glm::dot(offset, offset) < nearest) {
                nearest = glm::dot(offset, offset);
                best = i;
            }
        }
        if (taken.at(best)) return lines.error("its mid-edge points do not lie on its edges");
        taken.at(best) = true;
        sorted.at(edge) = cell[4 + best];
    }
    std::copy(sorted.begin(), sorted.end(), cell + 4);
    return {};
}

Result<void> readCell(TextLines& lines, std::size_t i, const NodeList& nodes, std::size_t corners,
                      MixedMesh& mesh) {
    auto& block = mesh.blocks[0];
    auto done = lines.need(1 + corners + mesh.fields.size(), "cell " + std::to_string(i));
    if (!done) return done;
    const auto points = static_cast<std::int64_t>(nodes.points.size());
    for (std::size_t v = 0; v < corners; ++v) {
        const auto vertex = lines.integer(1 + v);
        if (!vertex) return vertex.error();
        if (*vertex < nodes.first || *vertex - nodes.first >= points) {
            return lines.error("names point " + std::to_string(*vertex) + ", there are " +
                               std::to_string(nodes.first) + " to " +
                               std::to_string(points - 1 + nodes.first));
        }
        block.vertices.push_back(*vertex - nodes.first);
    }
    if (corners == 10) {
        done = sortMiddles(block.vertices.data() + block.vertices.size() - 10, nodes.points, lines);
        if (!done) return done;
    }
    for (std::size_t a = 0; a < mesh.fields.size(); ++a) {
        const auto value = lines.value(1 + corners + a);
        if (!value) return value.error();
        mesh.fields[a].steps[0].push_back(*value);
    }
    return {};
}

/// Reads "count corners attributes", then "index corners attributes" a cell.
Result<MixedMesh> readCells(TextLines& lines, const NodeList& nodes, const Progress& progress) {
    auto done = lines.need(1, "the number of cells");
    if (!done) return done.error();
    constexpr std::size_t kShortestLine = 10;  // "0 0 1 2 3\n"
    const auto count = lines.count(0, "cells", kShortestLine);
    if (!count) return count.error();
    const auto corners = lines.words().size() > 1 ? lines.integer(1) : Result<std::int64_t>{4};
    if (!corners) return corners.error();
    if (*corners != 4 && *corners != 10) {
        return lines.error("has cells of " + std::to_string(*corners) + " points, not 4 or 10");
    }
    const auto attributes = lines.words().size() > 2 ? lines.count(2, "attributes", 2)
                                                     : Result<std::size_t>{std::size_t{0}};
    if (!attributes) return attributes.error();
    if (*attributes > kMaxFields) return lines.error("has too many attributes");
    MixedMesh mesh;
    mesh.blocks.push_back({.kind = *corners == 4 ? CellKind::kTetra : CellKind::kTetra10});
    for (std::string& name : attributeNames(lines.comments(), *attributes, "region")) {
        mesh.fields.push_back({.name = std::move(name),
                               .association = Association::kCell,
                               .steps = {{}},
                               .times = {0.0}});
    }
    constexpr std::size_t kProgressEvery = 1 << 16;
    for (std::size_t i = 0; i < *count; ++i) {
        done = readCell(lines, i, nodes, static_cast<std::size_t>(*corners), mesh);
        if (!done) return done.error();
        if (i % kProgressEvery == 0) {
            progress("read", static_cast<double>(i) / static_cast<double>(*count));
        }
    }
    return mesh;
}

}  // namespace

Result<Loaded> readTetgenMesh(const Request& request, const Progress& progress) {
    const auto nodeText = readFile(request.path, request.maxMemoryBytes);
    if (!nodeText) return nodeText.error();
    TextLines nodeLines{request.path, *nodeText};
    auto nodes = readNodes(nodeLines);
    if (!nodes) return nodes.error();
    if (nodes->points.empty()) return nodeLines.error("has no points");
    const std::string elePath = withSuffix(request.path, ".ele");
    if (!exists(elePath)) {
        const Surface cloud{.points = std::move(nodes->points),
                            .attributes = std::move(nodes->attributes)};
        auto mesh = delaunay(cloud);
        if (!mesh) {
            return fail(mesh.error().code, request.path + ": " + mesh.error().message);
        }
        return Loaded{.input = std::move(mesh->mesh),
                      .format = "TetGen points",
                      .warnings = {"there is no .ele file: the cells are the Delaunay mesh of the "
                                   "points"}};
    }
    const auto eleText = readFile(elePath, request.maxMemoryBytes);
    if (!eleText) return eleText.error();
    TextLines eleLines{elePath, *eleText};
    auto mesh = readCells(eleLines, *nodes, progress);
    if (!mesh) return mesh.error();
    mesh->points = std::move(nodes->points);
    for (FieldInput& attribute : nodes->attributes) mesh->fields.push_back(std::move(attribute));
    auto split = splitCells(std::move(*mesh));
    if (!split) return fail(split.error().code, elePath + ": " + split.error().message);
    return Loaded{.input = std::move(*split), .format = "TetGen"};
}

}  // namespace volcast::data::load
