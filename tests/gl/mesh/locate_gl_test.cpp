// Finding the cell of a point; needs no GL, but lives with the walk that uses it.
#include <gtest/gtest.h>

#include "renderer/data/mesh_builder.h"
#include "renderer/mesh/locate.h"
#include "tests/support/mesh_phantoms.h"

namespace volcast::mesh {
namespace {

data::Mesh lattice(int n) {
    return data::buildMesh(support::latticeMesh({.cubes = {n, n, n}, .high = glm::dvec3{1.0 * n}}))
        .value();
}

/// True where every barycentric coordinate of `place` in its cell is positive.
bool isInside(const data::Mesh& mesh, const Place& place) {
    const glm::ivec4 ids = mesh.cells[static_cast<std::size_t>(place.cell)];
    const auto at = [&](int i) {
        return glm::dvec3{mesh.vertices[static_cast<std::size_t>(ids[i])]};
    };
    const glm::dmat3 edges{at(0) - at(3), at(1) - at(3), at(2) - at(3)};
    const glm::dvec3 parts = glm::inverse(edges) * (place.point - at(3));
    return parts.x > 0.0 && parts.y > 0.0 && parts.z > 0.0 && parts.x + parts.y + parts.z < 1.0;
}

TEST(Locate, FindsTheCellWhateverTheHint) {
    const data::Mesh mesh = lattice(5);
    const glm::dvec3 point{0.31, -1.27, 2.04};
    for (const int hint : {-1, 0, 17, static_cast<int>(mesh.cells.size()) - 1}) {
        const auto place = locate(mesh, point, hint);
        ASSERT_TRUE(place);
        EXPECT_TRUE(isInside(mesh, *place));
        EXPECT_EQ(place->point, point);
    }
}

TEST(Locate, MovesPointsOnVerticesEdgesAndFacesInwards) {
    const data::Mesh mesh = lattice(4);
    for (const glm::dvec3 point :
         {glm::dvec3{0, 0, 0}, glm::dvec3{0.5, 0, 0}, glm::dvec3{0.5, 0.25, 0}, glm::dvec3{2, 2, 2},
          glm::dvec3{-2, 0.3, 0.7}}) {
        const auto place = locate(mesh, point, -1);
        ASSERT_TRUE(place);
        EXPECT_TRUE(isInside(mesh, *place));
        EXPECT_LT(glm::length(place->point - point), 1e-5);
    }
}

TEST(Locate, FindsNothingOutside) {
    const data::Mesh mesh = lattice(3);
    EXPECT_FALSE(locate(mesh, {1.6, 0, 0}, -1));
    EXPECT_FALSE(locate(mesh, {0, 0, -1.5001}, 5));
}

// The way from the hint is barred by the gap; the search then looks everywhere.
TEST(Locate, FindsTheOtherPartOfAMesh) {
    const data::Mesh mesh =
        data::buildMesh(support::latticeMesh({.cubes = {3, 1, 1},
                                              .high = {3, 1, 1},
                                              .keep = [](const auto& c) { return c.x != 1; }}))
            .value();
    const auto first = locate(mesh, {-1.1, 0.1, 0.2}, -1);
    ASSERT_TRUE(first);
    const auto second = locate(mesh, {1.1, 0.1, 0.2}, first->cell);
    ASSERT_TRUE(second);
    EXPECT_TRUE(isInside(mesh, *second));
    EXPECT_FALSE(locate(mesh, {0.0, 0.0, 0.0}, first->cell));
}

}  // namespace
}  // namespace volcast::mesh
