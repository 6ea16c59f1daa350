// The rows of hard_cases.csv about geometry: lengths of rays, from the opacity of thin fog; where
// they enter and leave, from the extremes of a field that is the distance along them.
#include <array>
#include <map>
#include <string>
#include <vector>

#include "tests/support/mesh_scenes.h"
#include "tests/support/numerics/hard_cases.h"

namespace volcast {
namespace {

using glm::dvec3;

constexpr float kThin = 1e-3F;  // Its opacity keeps 7 digits of a length near 1.

class HardGeometry : public support::MeshTest {
protected:
    /// Length in the mesh of the ray from `origin` along `direction`.
    double lengthFrom(const dvec3& origin, const dvec3& direction) {
        const auto camera =
            support::orthographic(origin, origin + direction, 0.01, {0.31, 0.73, 0.17});
        const auto scene = sceneOf(camera, scene::RayModel::kVolume, support::fog(kThin));
        return support::lengthOf(draw(scene, {1, 1}).at(0, 0).a, kThin);
    }
    /// What the row says of where the ray from `origin` along `direction`, of length 1, enters and
    /// leaves the cells; `tolerance` relative to the way out.
    void expectEnds(const dvec3& origin, const dvec3& direction, double tolerance) {
        data::MeshInput input = cells_;
        support::addField(input, "t", data::Association::kVertex,
                          [&](const dvec3& p) { return glm::dot(p - origin, direction); });
        use(std::move(input));
        const double enters = support::after(row_[3], "t_in=");
        const double leaves = support::after(row_[3], "t_out=");
        const auto high = static_cast<float>(2.0 * leaves);
        const auto camera =
            support::orthographic(origin, origin + direction, 0.01, {0.31, 0.73, 0.17});
        const auto extreme = [&](scene::RayModel model) {
            const auto scene = sceneOf(camera, model, support::ruler(0.0F, high), "t");
            return static_cast<double>(draw(scene, {1, 1}).at(0, 0).r) * high;
        };
        EXPECT_NEAR(extreme(scene::RayModel::kMinip), enters, tolerance * leaves);
        EXPECT_NEAR(extreme(scene::RayModel::kMip), leaves, tolerance * leaves);
        endsSeen_ = true;
    }
    void useCells(std::vector<dvec3> points, std::vector<std::array<std::int64_t, 4>> cells) {
        cells_ = {.points = std::move(points), .cells = std::move(cells), .fields = {}};
        use(cells_);
    }
    void useTetrahedron(double height, double scale = 1.0, double offset = 0.0) {
        std::vector<dvec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, height}};
        for (dvec3& p : points) p = p * scale + offset;
        useCells(std::move(points), {{0, 1, 2, 3}});
    }

    data::MeshInput cells_;
    support::Row row_;       ///< The one that is checked.
    bool endsSeen_ = false;  ///< Its entry and exit were looked at.

    const std::map<std::string, void (HardGeometry::*)()> checks_{
        {"unit tet, axis ray", &HardGeometry::axisRay},
        {"through vertex", &HardGeometry::throughVertex},
        {"grazing face", &HardGeometry::grazingFace},
        {"sliver", &HardGeometry::sliver},
        {"sliver far eye", &HardGeometry::sliverFarEye},
        {"offset 1e6", &HardGeometry::offset},
        {"zero volume tet", &HardGeometry::zeroVolume},
        {"eye inside", &HardGeometry::eyeInside},
        {"Kuhn cube conservation", &HardGeometry::kuhnCube}};

    void axisRay() {
        useTetrahedron(1.0);
        EXPECT_NEAR(lengthFrom({.25, .25, -1}, {0, 0, 1}), 0.5, 1e-6);
        expectEnds({.25, .25, -1}, {0, 0, 1}, 1e-6 / 1.5);
    }
    // Four cells around the edge x = y = 0.
    void throughVertex() {
        useCells({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}},
                 {{0, 1, 2, 3}, {0, 1, 3, 4}, {0, 1, 4, 5}, {0, 1, 5, 2}});
        EXPECT_NEAR(lengthFrom({0, 0, -1}, {0, 0, 1}), 1.0, 1e-6);
    }
    // The cell and its mirror image below the face z = 0.
    void grazingFace() {
        useCells({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}},
                 {{0, 1, 2, 3}, {0, 1, 2, 4}});
        EXPECT_NEAR(lengthFrom({-1, .25, 0}, {1, 0, 0}), 0.75, 1e-6);
    }
    void sliver() {
        useTetrahedron(1e-6);
        EXPECT_NEAR(lengthFrom({.25, .25, -1e-6}, {0, 0, 1}), 5e-7, 5e-12);
    }
    void sliverFarEye() {
        useTetrahedron(1e-6);
        EXPECT_NEAR(lengthFrom({.25, .25, -3}, {0, 0, 1}), 5e-7, 5e-7);
    }
    void offset() {
        useTetrahedron(1.0, 1000.0, 1e6);
        EXPECT_NEAR(lengthFrom({1e6 + 250, 1e6 + 250, 1e6 - 1000}, {0, 0, 1}), 500.0, 5e-4);
        expectEnds({1e6 + 250, 1e6 + 250, 1e6 - 1000}, {0, 0, 1}, 1e-6);
    }
    // Another cell far aside, so that there is a mesh.
    void zeroVolume() {
        useCells({{0, 0, 0},
                  {1, 0, 0},
                  {0, 1, 0},
                  {1, 1, 0},
                  {5, 5, 5},
                  {6, 5, 5},
                  {5, 6, 5},
                  {5, 5, 6}},
                 {{0, 1, 2, 3}, {4, 5, 6, 7}});
        EXPECT_EQ(lengthFrom({.3, .2, -1}, {0, 0, 1}), 0.0);
        EXPECT_EQ(lengthFrom({-1, .2, 0}, {1, 0, 0}), 0.0);
    }
    void eyeInside() {
        useTetrahedron(1.0);
        EXPECT_NEAR(lengthFrom({.1, .1, .1}, {0, 0, 1}), 0.7, 1e-6);
        expectEnds({.1, .1, .1}, {0, 0, 1}, 1e-6 / 0.7);
    }
    // What is exact in the walk is read from an opacity: 2^-22 of a length of up to 7.
    void kuhnCube() {
        use(support::latticeMesh({.cubes = glm::ivec3{4}, .high = dvec3{4}}));
        for (int i = 0; i < 125; ++i) {
            const dvec3 direction{i % 5 - 2, i / 5 % 5 - 2, i / 25 - 2};
            if (direction == dvec3{0}) continue;
            for (const dvec3 through : {dvec3{2, 2, 1}, dvec3{1.5, 2, 2.5}}) {
                const dvec3 unit = glm::normalize(direction);
                const dvec3 eye = through - 10.0 * direction;
                EXPECT_NEAR(lengthFrom(eye, direction),
                            support::lengthInBox(eye, unit, dvec3{0}, dvec3{4}), 1e-5)
                    << i << ' ' << through.x;
            }
        }
    }
};

TEST_F(HardGeometry, EveryRow) {
    const auto rows = support::rowsOf("geometry");
    ASSERT_EQ(rows.size(), checks_.size());
    for (const support::Row& row : rows) {
        SCOPED_TRACE(row[1]);
        ASSERT_EQ(checks_.count(row[1]), 1U);
        row_ = row;
        endsSeen_ = false;
        (this->*checks_.at(row[1]))();
        EXPECT_EQ(endsSeen_, row[3].find("t_in=") != std::string::npos);
    }
}

}  // namespace
}  // namespace volcast
