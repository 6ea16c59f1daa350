#include "renderer/data/mesh_builder.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "renderer/data/dataset.h"
#include "renderer/data/mesh_adjacency.h"
#include "renderer/data/packed_checks.h"
#include "tests/support/mesh_phantoms.h"

namespace volcast::data {
namespace {

using support::addField;
using support::LatticeDesc;
using support::latticeMesh;

MeshInput singleTet() {
    return {.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
            .cells = {{0, 1, 2, 3}},
            .fields = {}};
}

Mesh built(MeshInput input) {
    auto mesh = buildMesh(std::move(input));
    EXPECT_TRUE(mesh) << mesh.error().message;
    if (!mesh) return {};
    EXPECT_TRUE(packed::check(*mesh)) << packed::check(*mesh).error().message;
    return std::move(*mesh);
}

glm::dvec3 vertex(const Mesh& mesh, int id) {
    return glm::dvec3{mesh.vertices[static_cast<std::size_t>(id)]};
}

double volumeOf(const Mesh& mesh) {
    double sum = 0.0;
    for (const glm::ivec4& c : mesh.cells) {
        const glm::dvec3 a = vertex(mesh, c.x);
        sum += glm::dot(glm::cross(vertex(mesh, c.y) - a, vertex(mesh, c.z) - a),
                        vertex(mesh, c.w) - a) /
               6.0;
    }
    return sum;
}

/// The volume the boundary faces enclose, by the divergence theorem: right only if they are closed
/// and counter-clockwise from outside.
double enclosedVolume(const Mesh& mesh) {
    double sum = 0.0;
    for (const BoundaryFace& f : mesh.boundaryFaces) {
        sum += glm::dot(vertex(mesh, f.vertices.x),
                        glm::cross(vertex(mesh, f.vertices.y), vertex(mesh, f.vertices.z))) /
               6.0;
    }
    return sum;
}

TEST(MeshBuilder, SingleCellHasFourBoundaryFacesAndIsConvex) {
    const Mesh mesh = built(singleTet());
    EXPECT_EQ(mesh.cells.size(), 1U);
    EXPECT_EQ(mesh.boundaryFaces.size(), 4U);
    EXPECT_TRUE(mesh.convex);
    EXPECT_EQ(mesh.origin, glm::dvec3{0.5});
    EXPECT_NEAR(volumeOf(mesh), 1.0 / 6.0, 1e-12);
    EXPECT_NEAR(enclosedVolume(mesh), 1.0 / 6.0, 1e-12);
}

TEST(MeshBuilder, InvertedCellIsTurnedAndCounted) {
    MeshInput input = singleTet();
    std::swap(input.cells[0][0], input.cells[0][1]);
    const Mesh mesh = built(input);
    EXPECT_EQ(mesh.cellsInverted, 1U);
    EXPECT_GT(volumeOf(mesh), 0.0);
}

TEST(MeshBuilder, CellsWithoutVolumeAreLeftOutAndCounted) {
    MeshInput input = singleTet();
    input.points.emplace_back(1, 1, 0);    // Coplanar with 0, 1, 2.
    input.points.emplace_back(9e9, 0, 0);  // Used by no cell that stays.
    input.cells.push_back({0, 1, 2, 4});
    input.cells.push_back({0, 1, 1, 3});
    input.cells.push_back({0, 1, 5, 5});
    const Mesh mesh = built(input);
    EXPECT_EQ(mesh.cells.size(), 1U);
    EXPECT_EQ(mesh.cellsWithoutVolume, 3U);
    EXPECT_EQ(mesh.vertices.size(), 4U);
    EXPECT_EQ(mesh.origin, glm::dvec3{0.5});
}

TEST(MeshBuilder, DoubledCellsAreLeftOutAndCounted) {
    MeshInput input = singleTet();
    input.cells.push_back({3, 1, 0, 2});
    const Mesh mesh = built(input);
    EXPECT_EQ(mesh.cells.size(), 1U);
    EXPECT_EQ(mesh.cellsDoubled, 1U);
    EXPECT_EQ(mesh.boundaryFaces.size(), 4U);
}

TEST(MeshBuilder, CoincidingPointsAreJoinedWhereFieldsAgree) {
    for (const bool jumps : {false, true}) {
        MeshInput input{.points = {{0, 0, 0},
                                   {1, 0, 0},
                                   {0, 1, 0},
                                   {0, 0, 1},
                                   {0, 0, 0},
                                   {1, 0, 0},
                                   {0, 1, 0},
                                   {0, 0, -1}},
                        .cells = {{0, 1, 2, 3}, {4, 5, 6, 7}},
                        .fields = {}};
        input.fields.push_back({.name = "f",
                                .unit = "",
                                .association = Association::kVertex,
                                .steps = {{1, 2, 3, 4, 1, 2, jumps ? 5.0 : 3.0, 6}},
                                .times = {}});
        const Mesh mesh = built(input);
        EXPECT_EQ(mesh.vertices.size(), jumps ? 6U : 5U);
        EXPECT_EQ(mesh.boundaryFaces.size(), jumps ? 8U : 6U);
        EXPECT_EQ(mesh.convex, !jumps);
    }
}

TEST(MeshBuilder, LatticeHasExactVolumeBoundaryAndConvexity) {
    const Mesh mesh = built(latticeMesh({.cubes = {4, 3, 2}, .high = {4, 3, 2}}));
    EXPECT_EQ(mesh.cells.size(), 6U * 24U);
    EXPECT_EQ(mesh.vertices.size(), 60U);
    EXPECT_EQ(mesh.boundaryFaces.size(), 2U * 2U * (12 + 8 + 6));
    EXPECT_NEAR(volumeOf(mesh), 24.0, 1e-9);
    EXPECT_NEAR(enclosedVolume(mesh), 24.0, 1e-9);
    EXPECT_TRUE(mesh.convex);
    EXPECT_EQ(mesh.facesNotManifold, 0U);
    for (const glm::ivec3& n : mesh.boundaryNeighbours) {
        EXPECT_TRUE(n.x >= 0 && n.y >= 0 && n.z >= 0);
    }
}

TEST(MeshBuilder, CellsHaveTheFormTheMeshPromises) {
    const Mesh mesh = built(support::shuffled(latticeMesh({.cubes = {3, 3, 3}}), 7));
    for (const glm::ivec4& c : mesh.cells) {
        EXPECT_LT(c.x, c.y);
        EXPECT_LT(c.y, std::min(c.z, c.w));
        const glm::dvec3 a = vertex(mesh, c.x);
        EXPECT_GT(glm::dot(glm::cross(vertex(mesh, c.y) - a, vertex(mesh, c.z) - a),
                           vertex(mesh, c.w) - a),
                  0.0);
    }
}

TEST(MeshBuilder, ResultDoesNotDependOnTheOrderOfTheInput) {
    MeshInput input = latticeMesh({.cubes = {4, 4, 4}});
    const auto f = [](const glm::dvec3& p) { return p.x + 10.0 * p.y + 100.0 * p.z; };
    addField(input, "p1", Association::kVertex, f);
    addField(input, "p0", Association::kCell, f);
    addField(input, "d1", Association::kCellVertex, f);
    const Mesh a = built(input);
    const Mesh b = built(support::shuffled(input, 3));
    EXPECT_TRUE(std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin()));
    EXPECT_TRUE(std::equal(a.cells.begin(), a.cells.end(), b.cells.begin(), b.cells.end()));
    EXPECT_TRUE(std::equal(a.neighbours.begin(), a.neighbours.end(), b.neighbours.begin()));
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& x = a.fields[i].steps[0];
        const auto& y = b.fields[i].steps[0];
        EXPECT_TRUE(std::equal(x.begin(), x.end(), y.begin(), y.end())) << a.fields[i].name;
        EXPECT_EQ(a.fields[i].range, b.fields[i].range);
    }
}

// A linear field is the same whether it is stored at vertices or at cell corners.
TEST(MeshBuilder, FieldValuesFollowTheirItems) {
    MeshInput input = latticeMesh({.cubes = {3, 2, 4}, .low = {10, 0, -5}, .high = {13, 2, 5}});
    const auto f = [](const glm::dvec3& p) { return p.x - 2.0 * p.y + 0.25 * p.z; };
    addField(input, "p1", Association::kVertex, f);
    addField(input, "p0", Association::kCell, f);
    addField(input, "d1", Association::kCellVertex, f);
    const Mesh mesh = built(support::shuffled(input, 11));
    for (std::size_t t = 0; t < mesh.cells.size(); ++t) {
        double mean = 0.0;
        for (int i = 0; i < 4; ++i) {
            const double expected = f(mesh.origin + vertex(mesh, mesh.cells[t][i]));
            const auto id = static_cast<std::size_t>(mesh.cells[t][i]);
            EXPECT_NEAR(mesh.fields[0].steps[0][id], expected, 1e-5);
            EXPECT_NEAR(mesh.fields[2].steps[0][4 * t + i], expected, 1e-5);
            mean += expected / 4.0;
        }
        EXPECT_NEAR(mesh.fields[1].steps[0][t], mean, 1e-5);
    }
}

TEST(MeshBuilder, StepsAndTimesAreKeptAndTheRangeCoversThemAll) {
    MeshInput input = singleTet();
    input.fields.push_back({.name = "f",
                            .unit = "K",
                            .association = Association::kCell,
                            .steps = {{5.0}, {-3.0}},
                            .times = {0.5, 0.75}});
    const Mesh mesh = built(input);
    EXPECT_EQ(mesh.fields[0].range, (Range{-3.0F, 5.0F}));
    EXPECT_EQ(mesh.fields[0].times, (std::vector<double>{0.5, 0.75}));
    EXPECT_EQ(mesh.fields[0].unit, "K");
}

TEST(MeshBuilder, FarAwayMeshKeepsItsShape) {
    const glm::dvec3 far{1e6, -2e6, 3e6};
    const Mesh mesh = built(latticeMesh({.cubes = {3, 3, 3}, .low = far, .high = far + 10.0}));
    EXPECT_EQ(mesh.origin, far + 5.0);
    EXPECT_NEAR(volumeOf(mesh), 1000.0, 1e-3);
    EXPECT_TRUE(mesh.convex);
}

TEST(MeshBuilder, SliverKeepsItsOrientationAndItsNeighbours) {
    MeshInput input{.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1e-12}, {0, 0, 1}},
                    .cells = {{0, 1, 2, 3}, {0, 1, 3, 4}, {1, 2, 3, 4}, {2, 0, 3, 4}},
                    .fields = {}};
    const Mesh mesh = built(input);
    EXPECT_EQ(mesh.cells.size(), 4U);
    EXPECT_EQ(mesh.boundaryFaces.size(), 4U);
    EXPECT_EQ(mesh.facesNotManifold, 0U);
}

TEST(MeshBuilder, FaceOfThreeCellsIsBoundaryOfEach) {
    MeshInput input{.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, -1}},
                    .cells = {{0, 1, 2, 3}, {0, 1, 2, 4}, {0, 2, 1, 5}},
                    .fields = {}};
    const Mesh mesh = built(input);
    EXPECT_GE(mesh.facesNotManifold, 1U);
    EXPECT_FALSE(mesh.convex);
    EXPECT_EQ(mesh.cells.size(), 3U);
}

TEST(MeshBuilder, ConvexIsNeverClaimedWrongly) {
    const auto build = [](const LatticeDesc& desc) { return built(latticeMesh(desc)).convex; };
    const glm::ivec3 n{3};
    EXPECT_FALSE(build({.cubes = {2, 2, 1}, .keep = [](auto& c) { return c.x + c.y < 2; }})) << "L";
    EXPECT_FALSE(build({.cubes = {3, 1, 1}, .keep = [](auto& c) { return c.x != 1; }})) << "two";
    EXPECT_FALSE(build({.cubes = n, .keep = [](auto& c) { return c != glm::ivec3{1}; }}))
        << "shell";
    EXPECT_FALSE(build({.cubes = n, .keep = [](auto& c) { return c.x != 1 || c.y != 1; }}))
        << "ring";
    EXPECT_FALSE(build({.cubes = {2, 2, 1}, .keep = [](auto& c) { return c.x == c.y; }})) << "edge";
    EXPECT_FALSE(build({.cubes = {4, 4, 4},
                        .move =
                            [](const glm::dvec3& p) {
                                return p + glm::dvec3{0, 0, 1e-4 * p.x * (p.x - 1.0)};
                            }}))
        << "slightly bent";
}

TEST(MeshBuilder, BallIsConvexThoughItsBoundaryIsCurved) {
    const auto ball = [](const glm::dvec3& p) {
        const double cube = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        return cube > 0.0 ? p * (cube / glm::length(p)) : p;
    };
    // A cube's six sides blown up to a sphere are convex only where quads are split the right way.
    const Mesh octahedron =
        built({.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
               .cells = {{4, 5, 0, 2}, {4, 5, 2, 1}, {4, 5, 1, 3}, {4, 5, 3, 0}},
               .fields = {}});
    EXPECT_TRUE(octahedron.convex);
    EXPECT_NEAR(volumeOf(octahedron), 4.0 / 3.0, 1e-9);
    const Mesh mesh = built(
        latticeMesh({.cubes = {8, 8, 8}, .low = {-1, -1, -1}, .high = {1, 1, 1}, .move = ball}));
    EXPECT_NEAR(volumeOf(mesh), enclosedVolume(mesh), 1e-5);
    EXPECT_LT(volumeOf(mesh), 4.0 / 3.0 * std::numbers::pi);
}

TEST(MeshBuilder, NanIsKeptCountedAndOutsideTheRange) {
    MeshInput input = latticeMesh({.cubes = {2, 2, 2}});
    const auto f = [](const glm::dvec3& p) { return p.x; };
    for (const auto association :
         {Association::kVertex, Association::kCell, Association::kCellVertex}) {
        addField(input, "f" + std::to_string(input.fields.size()), association, f);
        input.fields.back().steps[0][5] = std::numeric_limits<double>::quiet_NaN();
    }
    // Point 5 of 27 is the middle of an edge of the lattice.
    const auto atPoint = static_cast<std::uint64_t>(std::ranges::count_if(
        input.cells, [](const auto& c) { return std::ranges::count(c, 5) > 0; }));
    const Mesh mesh = built(input);
    EXPECT_GT(atPoint, 1U);
    EXPECT_EQ(mesh.fields[0].cellsWithoutValue, atPoint);
    EXPECT_EQ(mesh.fields[1].cellsWithoutValue, 1U);
    EXPECT_EQ(mesh.fields[2].cellsWithoutValue, 1U);
    EXPECT_EQ(mesh.fields[0].range, (Range{0.0F, 1.0F}));
    const DatasetSummary summary = summarize(Dataset{mesh});
    std::uint64_t counted = 0;
    for (const auto count : summary.fields[0].spread.histogram) counted += count;
    EXPECT_EQ(counted, 26U) << "all but the one";
    const std::vector<std::string> warnings = warningsOf(summary);
    ASSERT_EQ(warnings.size(), 3U);
    EXPECT_EQ(warnings[1], "1 cell has no value (NaN) in \"f1\" and is left out where it is drawn");
    EXPECT_EQ(warnings[0], std::to_string(atPoint) +
                               " cells have no value (NaN) in \"f0\" and are left out where it is "
                               "drawn");
}

TEST(MeshBuilder, PointsWithoutAValueAreJoined) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double other : {nan, 3.0}) {
        MeshInput input{.points = {{0, 0, 0},
                                   {1, 0, 0},
                                   {0, 1, 0},
                                   {0, 0, 1},
                                   {0, 0, 0},
                                   {1, 0, 0},
                                   {0, 1, 0},
                                   {0, 0, -1}},
                        .cells = {{0, 1, 2, 3}, {4, 5, 6, 7}},
                        .fields = {}};
        input.fields.push_back({.name = "f",
                                .unit = "",
                                .association = Association::kVertex,
                                .steps = {{1, 2, nan, 4, 1, 2, other, 6}},
                                .times = {}});
        const Mesh mesh = built(input);
        EXPECT_EQ(mesh.vertices.size(), std::isnan(other) ? 5U : 6U);
        EXPECT_EQ(mesh.fields[0].cellsWithoutValue, std::isnan(other) ? 2U : 1U);
    }
}

TEST(MeshBuilder, BadCoordinatesAndIdsAreRefusedByName) {
    MeshInput input = singleTet();
    input.points[2].y = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(buildMesh(input).error().message.find("point 2"), std::string::npos);
    for (const std::int64_t id : {std::int64_t{-1}, std::int64_t{4}, std::int64_t{1} << 40}) {
        input = singleTet();
        input.cells[0][3] = id;
        const auto error = buildMesh(input).error();
        EXPECT_EQ(error.code, ErrorCode::kInvalidArgument);
        EXPECT_NE(error.message.find("tetrahedron 0 names point " + std::to_string(id)),
                  std::string::npos);
    }
    EXPECT_FALSE(buildMesh({}));
    input = singleTet();
    input.points[3] = {0.5, 0.5, 0.0};
    EXPECT_EQ(buildMesh(input).error().code, ErrorCode::kInvalidArgument) << "nothing left";
    input = singleTet();
    for (auto& p : input.points) p *= 1e300;
    EXPECT_EQ(buildMesh(input).error().code, ErrorCode::kInvalidArgument) << "too wide";
}

TEST(MeshBuilder, BadFieldsAreRefusedByFieldItemAndValue) {
    const auto with = [](const FieldInput& field) {
        MeshInput input = singleTet();
        input.fields.push_back(field);
        return buildMesh(input);
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const FieldInput good{.name = "T",
                          .unit = "",
                          .association = Association::kVertex,
                          .steps = {{1, 2, 3, 4}},
                          .times = {}};
    EXPECT_TRUE(with(good));
    FieldInput bad = good;
    bad.steps = {{1, 2, HUGE_VAL, 4}};
    const std::string message = with(bad).error().message;
    EXPECT_NE(message.find("'T'"), std::string::npos) << message;
    EXPECT_NE(message.find("point 2"), std::string::npos) << message;
    EXPECT_NE(message.find("inf"), std::string::npos) << message;
    bad.steps = {{nan, nan, nan, nan}};
    EXPECT_NE(with(bad).error().message.find("'T': has no value, all 4 are NaN"), std::string::npos)
        << with(bad).error().message;
    for (const auto& steps : std::vector<std::vector<std::vector<double>>>{
             {}, {{1, 2, 3}}, {{1, 2, 3, 4}, {1, 2, 3}}, {{1, 2, 3, 1e39}}}) {
        bad.steps = steps;
        EXPECT_EQ(with(bad).error().code, ErrorCode::kInvalidArgument);
    }
    bad = good;
    bad.times = {nan};
    EXPECT_FALSE(with(bad));
    bad = good;
    bad.name = "";
    EXPECT_FALSE(with(bad));
    MeshInput twice = singleTet();
    twice.fields = {good, good};
    EXPECT_FALSE(buildMesh(twice));
    bad = good;
    bad.name = "T\xFFx";
    EXPECT_EQ(with(bad)->fields[0].name, "T?x");
}

}  // namespace
}  // namespace volcast::data
