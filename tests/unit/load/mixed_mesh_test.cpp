#include "renderer/data/load/mixed_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include <gtest/gtest.h>

namespace volcast::data::load {
namespace {

double volume(const MeshInput& mesh) {
    double sum = 0.0;
    for (const auto& cell : mesh.cells) {
        const auto at = [&](std::size_t i) {
            return mesh.points[static_cast<std::size_t>(cell.at(i))];
        };
        sum += glm::dot(glm::cross(at(1) - at(0), at(2) - at(0)), at(3) - at(0)) / 6.0;
    }
    return sum;
}

const std::vector<glm::dvec3> kCube{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                    {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

// All 40,320 ways to number the corners: every diagonal that the rule can choose.
TEST(SplitCells, AHexahedronIsFilledHoweverItsCornersAreNumbered) {
    std::array<std::int64_t, 8> numbers{};
    std::iota(numbers.begin(), numbers.end(), 0);
    do {
        MixedMesh mesh;
        mesh.points.resize(8);
        for (std::size_t i = 0; i < 8; ++i) {
            mesh.points[static_cast<std::size_t>(numbers.at(i))] = kCube[i];
        }
        mesh.blocks.push_back(
            {.kind = CellKind::kHexahedron, .vertices = {numbers.begin(), numbers.end()}});
        const auto split = splitCells(std::move(mesh));
        ASSERT_TRUE(split.has_value());
        ASSERT_EQ(split->cells.size(), 6U);
        ASSERT_NEAR(volume(*split), 1.0, 1e-12);
    } while (std::next_permutation(numbers.begin(), numbers.end()));
}

TEST(SplitCells, ACollapsedHexahedronHasNoFlatCells) {
    MixedMesh wedge{.points = kCube, .blocks = {}, .fields = {}};
    wedge.blocks.push_back({.kind = CellKind::kHexahedron, .vertices = {0, 1, 2, 2, 4, 5, 6, 6}});
    const auto split = splitCells(std::move(wedge));
    ASSERT_TRUE(split.has_value());
    EXPECT_NEAR(volume(*split), 0.5, 1e-12);
    for (auto cell : split->cells) {
        std::sort(cell.begin(), cell.end());
        EXPECT_EQ(std::unique(cell.begin(), cell.end()), cell.end());
    }
}

TEST(SplitCells, CellValuesGoToAllPartsOfTheirCell) {
    MixedMesh mesh{.points = kCube, .blocks = {}, .fields = {}};
    mesh.points.emplace_back(0.5, 0.5, 2.0);
    mesh.blocks.push_back({.kind = CellKind::kPyramid, .vertices = {4, 5, 6, 7, 8}});
    mesh.blocks.push_back({.kind = CellKind::kHexahedron, .vertices = {0, 1, 2, 3, 4, 5, 6, 7}});
    mesh.fields.push_back({.name = "n", .association = Association::kCell, .steps = {{10, 20}}});
    const auto split = splitCells(std::move(mesh));
    ASSERT_TRUE(split.has_value());
    const auto& values = split->fields[0].steps[0];
    ASSERT_EQ(values.size(), 8U);
    EXPECT_EQ(std::count(values.begin(), values.end(), 10.0), 2);
    EXPECT_EQ(std::count(values.begin(), values.end(), 20.0), 6);
}

// The 20-point shape functions carry any quadratic field without mixed terms exactly to the
// centres of faces and of the cell.
TEST(SplitCells, CentresOfQuadraticCellsTakeTheirShapeFunctions) {
    constexpr std::array<std::array<int, 2>, 12> kEdges{{{0, 1},
                                                         {1, 2},
                                                         {2, 3},
                                                         {3, 0},
                                                         {4, 5},
                                                         {5, 6},
                                                         {6, 7},
                                                         {7, 4},
                                                         {0, 4},
                                                         {1, 5},
                                                         {2, 6},
                                                         {3, 7}}};
    MixedMesh mesh{.points = kCube, .blocks = {}, .fields = {}};
    for (const auto& edge : kEdges) {
        mesh.points.push_back(0.5 * (kCube[static_cast<std::size_t>(edge[0])] +
                                     kCube[static_cast<std::size_t>(edge[1])]));
    }
    std::vector<std::int64_t> vertices(20);
    std::iota(vertices.begin(), vertices.end(), 0);
    mesh.blocks.push_back({.kind = CellKind::kHexahedron20, .vertices = vertices});
    std::vector<double> values;
    for (const glm::dvec3& p : mesh.points) values.push_back(glm::dot(p, p));
    mesh.fields.push_back({.name = "r2", .steps = {values}});
    const auto split = splitCells(std::move(mesh));
    ASSERT_TRUE(split.has_value());
    ASSERT_EQ(split->points.size(), 27U);
    EXPECT_EQ(split->cells.size(), 48U);
    EXPECT_NEAR(volume(*split), 1.0, 1e-12);
    for (std::size_t i = 0; i < 27; ++i) {
        const glm::dvec3 p = split->points[i];
        EXPECT_NEAR(split->fields[0].steps[0][i], glm::dot(p, p), 1e-12) << i;
    }
}

TEST(SplitCells, RefusesPointsThatDoNotExistAndWrongCounts) {
    MixedMesh outside{.points = kCube, .blocks = {}, .fields = {}};
    outside.blocks.push_back({.kind = CellKind::kTetra, .vertices = {0, 1, 2, 8}});
    EXPECT_EQ(splitCells(outside).error().code, ErrorCode::kInvalidArgument);
    outside.blocks[0].vertices[3] = -1;
    EXPECT_EQ(splitCells(outside).error().code, ErrorCode::kInvalidArgument);
    outside.blocks[0].vertices = {0, 1, 2};
    EXPECT_EQ(splitCells(outside).error().code, ErrorCode::kInvalidArgument);
    MixedMesh shortField{.points = kCube, .blocks = {}, .fields = {}};
    shortField.blocks.push_back({.kind = CellKind::kWedge, .vertices = {0, 1, 2, 4, 5, 6}});
    shortField.fields.push_back({.name = "f", .steps = {{1.0}}});
    EXPECT_EQ(splitCells(shortField).error().code, ErrorCode::kInvalidArgument);
    shortField.fields[0].association = Association::kCellVertex;
    EXPECT_EQ(splitCells(shortField).error().code, ErrorCode::kUnsupported);
}

}  // namespace
}  // namespace volcast::data::load
