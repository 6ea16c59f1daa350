#include "renderer/data/mesh_restrict.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "renderer/data/mesh_adjacency.h"
#include "renderer/data/packed_checks.h"
#include "tests/support/mesh_phantoms.h"

namespace volcast::data {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

double materialAt(const glm::dvec3& p) {
    return std::floor(2.0 * p.x);
}

/// A cube of 4^3 with materials 0 and 1 in its halves, and the three kinds of a linear field.
Mesh cube() {
    support::LatticeDesc desc;
    desc.cubes = {4, 4, 4};
    MeshInput input = support::latticeMesh(desc);
    const auto linear = [](const glm::dvec3& p) { return p.x + 10.0 * p.y + 100.0 * p.z; };
    support::addField(input, "material", Association::kCell, materialAt);
    support::addField(input, "p1", Association::kVertex, linear);
    support::addField(input, "p0", Association::kCell, linear);
    support::addField(input, "d1", Association::kCellVertex, linear);
    return buildMesh(std::move(input)).value();
}

/// `field` with a NaN for value `at`.
Field withNan(const Field& field, std::size_t at) {
    Field changed = field;
    std::vector<float> values{field.steps[0].begin(), field.steps[0].end()};
    values[at] = kNan;
    changed.steps[0] = std::move(values);
    return changed;
}

std::uint64_t cellsAt(const Mesh& mesh, std::int32_t vertex) {
    return static_cast<std::uint64_t>(std::ranges::count_if(mesh.cells, [&](const glm::ivec4& c) {
        return c.x == vertex || c.y == vertex || c.z == vertex || c.w == vertex;
    }));
}

TEST(MeshRestrict, NothingLeftOutIsNothing) {
    const Mesh mesh = cube();
    const std::array listed{0.0F, 1.0F};
    const std::array<FieldStep, 1> fields{{{.field = &mesh.fields[1]}}};
    EXPECT_FALSE(keptCells(mesh, {.field = &mesh.fields[0]}, listed, fields).value());
    EXPECT_FALSE(keptCells(mesh, {}, {}, {}).value());
}

TEST(MeshRestrict, HalfACubeIsTheMeshThatIsBuiltOfIt) {
    const Mesh mesh = cube();
    const std::array listed{1.0F, 7.0F, kNan};
    const auto kept = keptCells(mesh, {.field = &mesh.fields[0]}, listed, {}).value();
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->notListed, 3U * 64U);
    EXPECT_EQ(kept->withoutValue, 0U);
    const Restriction half = restrictMesh(mesh, kept->cells);
    ASSERT_EQ(half.mesh.cells.size(), 3U * 64U);
    EXPECT_TRUE(packed::check(half.mesh)) << packed::check(half.mesh).error().message;
    EXPECT_TRUE(half.mesh.convex);
    // Two sides of 4 x 4 squares, four of 2 x 4, two triangles each.
    EXPECT_EQ(half.mesh.boundaryFaces.size(), 2U * (2U * 16U + 4U * 8U));
    EXPECT_EQ(half.mesh.vertices.data(), mesh.vertices.data()) << "shared";
    for (std::size_t t = 0; t < half.mesh.cells.size(); ++t) {
        EXPECT_EQ(half.mesh.cells[t], mesh.cells[static_cast<std::size_t>(half.source[t])]);
    }
    const Adjacency found = findAdjacency(half.mesh.cells.span(), half.mesh.vertices.size());
    EXPECT_TRUE(std::ranges::equal(half.mesh.neighbours, found.neighbours));
    EXPECT_TRUE(std::ranges::equal(half.mesh.boundaryNeighbours, found.boundaryNeighbours));
}

TEST(MeshRestrict, HoleMakesTheRestNotConvex) {
    const Mesh mesh = cube();
    const std::array<Field, 1> changed{withNan(mesh.fields[2], 100)};
    const std::array<FieldStep, 1> fields{{{.field = changed.data()}}};
    const auto kept = keptCells(mesh, {}, {}, fields).value();
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->withoutValue, 1U);
    const Restriction rest = restrictMesh(mesh, kept->cells);
    EXPECT_FALSE(rest.mesh.convex);
    EXPECT_TRUE(packed::check(rest.mesh));
}

TEST(MeshRestrict, NanLeavesOutTheCellsThatInterpolateIt) {
    const Mesh mesh = cube();
    const std::size_t vertex = 62;
    const std::array<Field, 3> changed{withNan(mesh.fields[1], vertex), withNan(mesh.fields[2], 5),
                                       withNan(mesh.fields[3], 4 * 7 + 2)};
    const std::array<std::uint64_t, 3> expected{cellsAt(mesh, static_cast<int>(vertex)), 1, 1};
    ASSERT_GT(expected[0], 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::array<FieldStep, 1> fields{{{.field = &changed[i]}}};
        const auto kept = keptCells(mesh, {}, {}, fields).value();
        ASSERT_TRUE(kept) << i;
        EXPECT_EQ(kept->withoutValue, expected[i]) << i;
        EXPECT_EQ(kept->cells.size(), mesh.cells.size() - expected[i]) << i;
        const Restriction rest = restrictMesh(mesh, kept->cells);
        const Field field = restrictField(changed[i], 0, rest.source.span());
        const std::array<FieldStep, 1> again{{{.field = &field}}};
        EXPECT_FALSE(keptCells(rest.mesh, {}, {}, again).value()) << "none is left of " << i;
    }
}

TEST(MeshRestrict, CellsAreCountedForOneReason) {
    const Mesh mesh = cube();
    const std::array<Field, 1> changed{withNan(mesh.fields[2], 0)};
    const std::array<FieldStep, 1> fields{{{.field = changed.data()}}};
    const float other = mesh.fields[0].steps[0][0] == 0.0F ? 1.0F : 0.0F;
    const auto kept =
        keptCells(mesh, {.field = &mesh.fields[0]}, std::span{&other, 1}, fields).value();
    EXPECT_EQ(kept->notListed, 3U * 64U);
    EXPECT_EQ(kept->withoutValue, 0U);
}

TEST(MeshRestrict, FieldValuesFollowTheirCells) {
    const Mesh mesh = cube();
    const std::array listed{0.0F};
    const auto kept = keptCells(mesh, {.field = &mesh.fields[0]}, listed, {}).value();
    const Restriction half = restrictMesh(mesh, kept->cells);
    const Field vertices = restrictField(mesh.fields[1], 0, half.source.span());
    const Field cells = restrictField(mesh.fields[2], 0, half.source.span());
    const Field corners = restrictField(mesh.fields[3], 0, half.source.span());
    EXPECT_EQ(vertices.steps[0].data(), mesh.fields[1].steps[0].data()) << "shared";
    for (std::size_t t = 0; t < half.mesh.cells.size(); ++t) {
        float sum = 0.0F;
        for (int i = 0; i < 4; ++i) {
            const float value = vertices.steps[0][static_cast<std::size_t>(half.mesh.cells[t][i])];
            EXPECT_EQ(corners.steps[0][4 * t + static_cast<std::size_t>(i)], value);
            sum += value;
        }
        // Four roundings of a sum of up to 4 * 111, each half a unit of 2^-15.
        EXPECT_NEAR(cells.steps[0][t], sum / 4.0F, 1e-4F);
    }
}

TEST(MeshRestrict, CellsWithoutAValueAreCountedOverAllSteps) {
    const Mesh mesh = cube();
    Field changed = withNan(mesh.fields[2], 3);
    changed.steps.push_back(withNan(mesh.fields[2], 9).steps[0]);
    changed.steps.push_back(changed.steps[0]);
    EXPECT_EQ(countCellsWithoutValue(mesh, changed), 2U);
    EXPECT_EQ(countCellsWithoutValue(mesh, mesh.fields[2]), 0U);
}

TEST(MeshRestrict, AllLeftOutIsAMeshWithoutCells) {
    const Mesh mesh = cube();
    const std::array listed{5.0F};
    const auto kept = keptCells(mesh, {.field = &mesh.fields[0]}, listed, {}).value();
    ASSERT_TRUE(kept);
    EXPECT_TRUE(kept->cells.empty());
    const Restriction none = restrictMesh(mesh, kept->cells);
    EXPECT_TRUE(none.mesh.cells.empty());
    EXPECT_TRUE(none.mesh.boundaryFaces.empty());
    EXPECT_FALSE(none.mesh.convex);
}

TEST(MeshRestrict, RefusesWhatIsNoMarkerOrNoStep) {
    const Mesh mesh = cube();
    const auto refused = [&mesh](const FieldStep& marker) {
        const auto kept = keptCells(mesh, marker, {}, {});
        return kept ? std::string{"kept"} : kept.error().message;
    };
    EXPECT_NE(refused({.field = &mesh.fields[1]}).find("'p1'"), std::string::npos);
    EXPECT_NE(refused({.field = &mesh.fields[0], .step = 3}).find("step 3"), std::string::npos);
    EXPECT_NE(refused({.field = &mesh.fields[0], .step = -1}).find("step -1"), std::string::npos);
}

}  // namespace
}  // namespace volcast::data
