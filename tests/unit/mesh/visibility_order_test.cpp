// The order of cells along lines of sight: what is before comes first.
#include "renderer/mesh/visibility_order.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "renderer/data/mesh_builder.h"
#include "tests/support/delaunay.h"
#include "tests/support/mesh_phantoms.h"

namespace volcast {
namespace {

using mesh::OrderReport;
using mesh::Viewpoint;
using mesh::VisibilityOrder;
using support::latticeMesh;

data::Mesh built(data::MeshInput input) {
    auto mesh = data::buildMesh(std::move(input));
    EXPECT_TRUE(mesh.has_value()) << mesh.error().message;
    return std::move(*mesh);
}

const std::vector<Viewpoint>& viewpoints() {
    static const std::vector<Viewpoint> kViewpoints{
        {true, {3.1, 2.3, 4.4}}, {true, {-40, 3, 7}}, {true, {0.13, 0.21, -0.17}},
        {true, {1, 1, 1}},       {false, {0, 0, -1}}, {false, {0.3, -0.4, 0.5}}};
    return kViewpoints;
}

/// Where a ray of `viewpoint` through `target` is in a cell: the middle of its part there, or < 0.
double middleIn(const data::Mesh& mesh, std::size_t cell, const Viewpoint& viewpoint,
                const glm::dvec3& target) {
    const glm::dvec3 direction = viewpoint.perspective ? glm::normalize(target - viewpoint.at)
                                                       : glm::normalize(viewpoint.at);
    const glm::dvec3 origin = viewpoint.perspective ? viewpoint.at : target - 100.0 * direction;
    double begin = 0.0;
    double end = 1e300;
    const auto at = [&](int corner) {
        return glm::dvec3{mesh.vertices[static_cast<std::size_t>(mesh.cells[cell][corner])]};
    };
    constexpr std::array<std::array<int, 3>, 4> kFaces{
        {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
    for (const auto& face : kFaces) {
        const glm::dvec3 outwards =
            glm::cross(at(face[1]) - at(face[0]), at(face[2]) - at(face[0]));
        const double slope = glm::dot(outwards, direction);
        const double meets = glm::dot(outwards, at(face[0]) - origin) / slope;
        if (slope < 0.0) begin = std::max(begin, meets);
        if (slope > 0.0) end = std::min(end, meets);
        if (slope == 0.0 && glm::dot(outwards, at(face[0]) - origin) <= 0.0) return -1.0;
    }
    return end > begin + 1e-9 ? 0.5 * (begin + end) : -1.0;
}

/// Cells on rays that are met in another order than `order` has them.
int wrongOnRays(const data::Mesh& mesh, std::span<const std::uint32_t> order,
                const Viewpoint& viewpoint) {
    std::mt19937 random{7};
    std::uniform_real_distribution<double> place{-0.9, 0.9};
    int wrong = 0;
    for (int ray = 0; ray < 50; ++ray) {
        const double x = place(random);
        const double y = place(random);
        const glm::dvec3 target{x, y, place(random)};
        double last = -1.0;
        for (const std::uint32_t cell : order) {
            const double middle = middleIn(mesh, cell, viewpoint, target);
            if (middle < 0.0) continue;
            if (middle < last) ++wrong;
            last = middle;
        }
    }
    return wrong;
}

void expectPermutation(std::span<const std::uint32_t> order) {
    std::vector<std::uint32_t> sorted{order.begin(), order.end()};
    std::ranges::sort(sorted);
    for (std::size_t i = 0; i < sorted.size(); ++i) ASSERT_EQ(sorted[i], i);
}

TEST(VisibilityOrder, PowerDistanceIsExactForDelaunayMeshes) {
    for (const unsigned seed : {1U, 2U, 3U}) {
        const data::Mesh mesh = built(support::randomDelaunay(300, seed));
        ASSERT_GT(mesh.cells.size(), 1000U);
        VisibilityOrder order{mesh};
        for (const Viewpoint& viewpoint : viewpoints()) {
            const auto cells = order.sort(viewpoint);
            expectPermutation(cells);
            EXPECT_TRUE(order.report().byPowerDistance);
            EXPECT_EQ(order.report().cells, static_cast<std::int64_t>(mesh.cells.size()));
            EXPECT_EQ(order.report().sortViolations, 0);
            EXPECT_EQ(order.report().orderViolations, 0);
            EXPECT_EQ(wrongOnRays(mesh, cells, viewpoint), 0);
        }
    }
}

// Centroids put cells of a jittered lattice in the wrong order; their neighbours mend it.
TEST(VisibilityOrder, WhereCentroidsErrNeighboursMendTheOrder) {
    const glm::ivec3 cubes{6};
    const data::Mesh mesh =
        built(latticeMesh({.cubes = cubes,
                           .low = glm::dvec3{-1},
                           .high = glm::dvec3{1},
                           .move = support::jitter(cubes, glm::dvec3{-1}, glm::dvec3{1}, 0.3)}));
    VisibilityOrder order{mesh};
    for (const Viewpoint& viewpoint : viewpoints()) {
        const auto cells = order.sort(viewpoint);
        expectPermutation(cells);
        EXPECT_FALSE(order.report().byPowerDistance);
        EXPECT_GT(order.report().sortViolations, 0);
        EXPECT_EQ(order.report().orderViolations, 0);
        EXPECT_EQ(wrongOnRays(mesh, cells, viewpoint), 0);
    }
}

// All cells of a cube have one sphere, so keys tie: the neighbours decide.
TEST(VisibilityOrder, LatticesAreInOrderThoughTheirKeysTie) {
    const data::Mesh mesh =
        built(latticeMesh({.cubes = {5, 5, 5}, .low = glm::dvec3{-1}, .high = glm::dvec3{1}}));
    VisibilityOrder order{mesh};
    for (const Viewpoint& viewpoint : viewpoints()) {
        const auto cells = order.sort(viewpoint);
        expectPermutation(cells);
        EXPECT_TRUE(order.report().byPowerDistance);
        EXPECT_EQ(order.report().orderViolations, 0);
        EXPECT_EQ(wrongOnRays(mesh, cells, viewpoint), 0);
    }
}

TEST(VisibilityOrder, CellsThatHideOneAnotherInACircleAreCounted) {
    const data::Mesh mesh = built(support::shutterMesh());
    ASSERT_EQ(mesh.cells.size(), 12U);
    VisibilityOrder order{mesh};
    expectPermutation(order.sort({.at = -mesh.origin}));
    EXPECT_EQ(order.report().orderViolations, 1);  // A circle has to be broken somewhere.
    expectPermutation(order.sort({.at = glm::dvec3{9, 8, 7} - mesh.origin}));
    EXPECT_EQ(order.report().orderViolations, 0);
}

}  // namespace
}  // namespace volcast
