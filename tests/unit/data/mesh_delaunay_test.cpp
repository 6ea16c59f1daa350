#include "renderer/data/mesh_delaunay.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/mesh_phantoms.h"

namespace volcast::data {
namespace {

Mesh built(MeshInput input) {
    return buildMesh(std::move(input)).value();
}

/// Two cells that share the triangle z = 0; the lower apex stands `depth` below its middle.
///
/// The triangle's corners lie on the unit circle, the upper apex at height 2: its sphere has its
/// centre at height h with 1 + h^2 = (2 - h)^2, so h = 3/4, R = 5/4, and reaches down to z = -1/2.
Mesh twoCells(double depth) {
    const double s = std::sqrt(0.75);
    return built({.points = {{1, 0, 0}, {-0.5, s, 0}, {-0.5, -s, 0}, {0, 0, 2}, {0, 0, -depth}},
                  .cells = {{0, 1, 2, 3}, {0, 1, 2, 4}},
                  .fields = {}});
}

TEST(MeshDelaunay, VertexBelowTheSphereIsDelaunayAndInsideItIsNot) {
    EXPECT_TRUE(isDelaunay(twoCells(0.501)));
    EXPECT_EQ(countDelaunayFaces(twoCells(0.501)).tied, 0U);
    EXPECT_FALSE(isDelaunay(twoCells(0.499)));
    EXPECT_EQ(countDelaunayFaces(twoCells(0.499)).violated, 1U);
}

TEST(MeshDelaunay, VertexOnTheSphereTies) {
    EXPECT_TRUE(isDelaunay(twoCells(0.5)));
    EXPECT_EQ(countDelaunayFaces(twoCells(0.5)).tied, 1U);
}

// Kuhn's six cells of a cube have its sphere, and across its sides stand cubes of the same size.
TEST(MeshDelaunay, LatticeIsDelaunayAndTiesInsideItsCubes) {
    support::LatticeDesc desc;
    desc.cubes = {3, 3, 3};
    desc.high = {0.3, 0.3, 0.3};  // No float32 numbers: rounding must be forgiven.
    const DelaunayFaces faces = countDelaunayFaces(built(support::latticeMesh(desc)));
    EXPECT_EQ(faces.violated, 0U);
    EXPECT_EQ(faces.tied, 27U * 6U);
}

TEST(MeshDelaunay, FlatteningALatticeKeepsItsSpheresTies) {
    support::LatticeDesc desc;
    desc.cubes = {3, 3, 3};
    desc.move = [](const glm::dvec3& p) { return p * glm::dvec3{1.0, 1.0, 0.1}; };
    EXPECT_TRUE(isDelaunay(built(support::latticeMesh(desc)))) << "boxes have spheres, too";
    desc.move = [](const glm::dvec3& p) { return glm::dvec3{p.x + 0.8 * p.y, p.y, p.z}; };
    EXPECT_FALSE(isDelaunay(built(support::latticeMesh(desc)))) << "sheared";
}

TEST(MeshDelaunay, SpheresPassThroughTheCorners) {
    support::LatticeDesc desc;
    desc.cubes = {3, 3, 3};
    desc.move = support::jitter(desc.cubes, desc.low, desc.high, 0.2);
    const Mesh mesh = built(support::latticeMesh(desc));
    const std::vector<glm::dvec4> spheres = powerSpheres(mesh);
    ASSERT_EQ(spheres.size(), mesh.cells.size());
    for (std::size_t t = 0; t < spheres.size(); ++t) {
        for (int i = 0; i < 4; ++i) {
            const glm::dvec3 p{mesh.vertices[static_cast<std::size_t>(mesh.cells[t][i])]};
            const glm::dvec3 arm = p - glm::dvec3{spheres[t]};
            // A jittered cell's volume is above 1e-3 of its cube's: 1e3 roundings of 2^-53.
            EXPECT_NEAR(glm::dot(arm, arm), spheres[t].w, 1e-12 * (1.0 + spheres[t].w));
        }
    }
}

// The order of power distances is the visibility order, seen from anywhere outside the tie.
TEST(MeshDelaunay, PowerDistanceOrdersTheTwoCells) {
    const Mesh mesh = twoCells(0.8);
    const std::vector<glm::dvec4> spheres = powerSpheres(mesh);
    const auto upper = static_cast<std::size_t>(
        mesh.vertices[static_cast<std::size_t>(mesh.cells[0].z)].z +
                    mesh.vertices[static_cast<std::size_t>(mesh.cells[0].w)].z >
                mesh.vertices[static_cast<std::size_t>(mesh.cells[1].z)].z +
                    mesh.vertices[static_cast<std::size_t>(mesh.cells[1].w)].z
            ? 0
            : 1);
    const auto distance = [&](std::size_t t, const glm::dvec3& eyeWorld) {
        const glm::dvec3 arm = eyeWorld - mesh.origin - glm::dvec3{spheres[t]};
        return glm::dot(arm, arm) - spheres[t].w;
    };
    for (const glm::dvec3 eye : {glm::dvec3{5, 1, 0.1}, {-3, 2, 3}, {0.1, 0.1, 20}}) {
        EXPECT_LT(distance(upper, eye), distance(1 - upper, eye));
        const glm::dvec3 below{eye.x, eye.y, -eye.z};
        EXPECT_GT(distance(upper, below), distance(1 - upper, below));
    }
}

TEST(MeshDelaunay, CellFlatInFloat32HasNoSphere) {
    MeshInput input{.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.25, 1e-12}},
                    .cells = {{0, 1, 2, 3}},
                    .fields = {}};
    input.points.emplace_back(0.25, 0.25, -0.5);
    input.cells.push_back({0, 1, 2, 4});
    const Mesh mesh = built(input);
    ASSERT_EQ(mesh.cells.size(), 2U);
    const DelaunayFaces faces = countDelaunayFaces(mesh);
    EXPECT_EQ(faces.cellsFlat, 1U);
    EXPECT_FALSE(isDelaunay(mesh));
    for (const glm::dvec4& sphere : powerSpheres(mesh)) {
        EXPECT_TRUE(std::isfinite(sphere.x) && std::isfinite(sphere.w));
    }
}

}  // namespace
}  // namespace volcast::data
