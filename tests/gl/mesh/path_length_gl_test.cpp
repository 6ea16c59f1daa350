// Path lengths: whatever the cells are, the pieces of a ray add up to its length in the mesh.
#include <cmath>

#include "tests/support/mesh_scenes.h"
#include "tests/support/ray_caster.h"

namespace volcast {
namespace {

using scene::RayModel;
using support::fog;
using support::latticeMesh;
using support::lengthInBox;
using support::lengthOf;
using support::orthographic;
using support::perspective;
using support::pixelRay;

constexpr float kThin = 1e-3F;

class PathLength : public support::MeshTest {
protected:
    /// Largest error of a picture's lengths against `expected(ray)`; rays that `skip` names are
    /// left out. Every number must be finite.
    template <class Expected, class Skip>
    double worstError(const scene::Camera& camera, glm::ivec2 size, const Expected& expected,
                      const Skip& skip) {
        const auto picture = draw(sceneOf(camera, RayModel::kVolume, fog(kThin)), size);
        double worst = 0.0;
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const glm::vec4 pixel = picture.at(x, y);
                EXPECT_TRUE(std::isfinite(pixel.r) && std::isfinite(pixel.a)) << x << ' ' << y;
                const support::CastRay ray = pixelRay(camera, size, x, y);
                if (skip(ray)) continue;
                worst = std::max(worst, std::abs(lengthOf(pixel.a, kThin) - expected(ray)));
            }
        }
        return worst;
    }
    double worstInBox(const scene::Camera& camera, glm::ivec2 size, const glm::dvec3& low,
                      const glm::dvec3& high) {
        // On a silhouette to within rounding, a pixel may see the box or miss it.
        const double hair = 1e-6 * glm::length(high - low);
        return worstError(
            camera, size,
            [&](const auto& ray) { return lengthInBox(ray.origin, ray.direction, low, high); },
            [&](const auto& ray) {
                const double more = lengthInBox(ray.origin, ray.direction, low - hair, high + hair);
                const double less = lengthInBox(ray.origin, ray.direction, low + hair, high - hair);
                return more > 0.0 && less == 0.0;
            });
    }
};

// Rays along the axes run through vertices, edges and within faces of the lattice.
TEST_F(PathLength, LatticeSeenAlongItsAxesIsExact) {
    const int n = 8;
    use(latticeMesh({.cubes = {n, n, n}, .high = glm::dvec3{n}}));
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            glm::dvec3 eye{0.5 * n};
            eye[axis] += side * 3.0 * n;
            glm::dvec3 up{0.0};
            up[(axis + 1) % 3] = 1.0;
            // 2n + 2 pixels over n + 1 units: centres at quarters; 2n + 1 over n + 0.5: on lattice
            // planes and halfway between them.
            for (const auto& [pixels, height] :
                 {std::pair{2 * n + 2, n + 1.0}, std::pair{2 * n + 1, n + 0.5},
                  std::pair{4 * n + 1, n + 0.25}}) {
                const auto camera = orthographic(eye, glm::dvec3{0.5 * n}, height, up);
                EXPECT_LT(worstInBox(camera, {pixels, pixels}, glm::dvec3{0}, glm::dvec3{n}), 2e-5)
                    << axis << ' ' << side << ' ' << pixels;
            }
        }
    }
}

TEST_F(PathLength, LatticeInPerspective) {
    use(latticeMesh({.cubes = {6, 7, 5}, .low = {-3, -3.5, -2.5}, .high = {3, 3.5, 2.5}}));
    const glm::dvec3 half{3, 3.5, 2.5};
    for (const glm::dvec3 eye : {glm::dvec3{0, 0, 12}, glm::dvec3{0, 12, 0.001},
                                 glm::dvec3{9, 7, -8}, glm::dvec3{3, 3.5, 30}}) {
        const auto camera = perspective(eye, {0, 0, 0}, 50.0);
        EXPECT_LT(worstInBox(camera, {65, 49}, -half, half), 3e-5) << eye.x << ' ' << eye.y;
    }
}

TEST_F(PathLength, DiagonalViewsRunAlongEdges) {
    const int n = 4;
    use(latticeMesh({.cubes = {n, n, n}, .low = glm::dvec3{-2}, .high = glm::dvec3{2}}));
    for (const glm::dvec3 direction :
         {glm::dvec3{1, 1, 1}, glm::dvec3{1, 1, 0}, glm::dvec3{1, 2, 0}, glm::dvec3{-1, 1, 2}}) {
        const auto camera = orthographic(-10.0 * direction, {0, 0, 0}, 7.0, {0, 0.3, 1});
        EXPECT_LT(worstInBox(camera, {33, 33}, glm::dvec3{-2}, glm::dvec3{2}), 2e-5);
    }
}

TEST_F(PathLength, CameraInside) {
    use(latticeMesh({.cubes = {4, 4, 4}, .low = glm::dvec3{-2}, .high = glm::dvec3{2}}));
    // In a cell, on a vertex, on an edge, on a face, in the middle of a diagonal, on the boundary.
    for (const glm::dvec3 eye :
         {glm::dvec3{0.31, 0.17, -0.73}, glm::dvec3{0, 0, 0}, glm::dvec3{0.5, 0, 0},
          glm::dvec3{0.25, 0.5, 0}, glm::dvec3{0.5, 0.5, 0.5}, glm::dvec3{2, 0.3, 0.2}}) {
        for (const glm::dvec3 view : {glm::dvec3{0, 0, -1}, glm::dvec3{1, 0.4, 0.2}}) {
            const auto camera = perspective(eye, eye + view, 90.0);
            EXPECT_LT(worstInBox(camera, {33, 33}, glm::dvec3{-2}, glm::dvec3{2}), 3e-5)
                << eye.x << ' ' << eye.y << ' ' << eye.z << " to " << view.x;
        }
    }
}

TEST_F(PathLength, OrthographicPlaneWithinTheMesh) {
    use(latticeMesh({.cubes = {4, 4, 4}, .low = glm::dvec3{-2}, .high = glm::dvec3{2}}));
    for (const glm::dvec3 eye :
         {glm::dvec3{0, 0, 0.3}, glm::dvec3{0, 0, 0}, glm::dvec3{0.1, 0.2, -2}}) {
        const auto straight = orthographic(eye, eye + glm::dvec3{0, 0, -1}, 5.0);
        EXPECT_LT(worstInBox(straight, {33, 33}, glm::dvec3{-2}, glm::dvec3{2}), 3e-5);
        const auto slanted = orthographic(eye, eye + glm::dvec3{0.3, 0.5, -1}, 5.0);
        EXPECT_LT(worstInBox(slanted, {33, 33}, glm::dvec3{-2}, glm::dvec3{2}), 3e-5);
    }
}

TEST_F(PathLength, FarAwayFromTheOriginOfTheWorld) {
    const glm::dvec3 far{1e6, -1e6, 2e6};
    use(latticeMesh({.cubes = {5, 5, 5}, .low = far, .high = far + 10.0}));
    const auto camera = perspective(far + glm::dvec3{25, 17, 31}, far + 5.0);
    EXPECT_LT(worstInBox(camera, {48, 48}, far, far + 10.0), 1e-4);
}

TEST_F(PathLength, TinyAndHugeUnits) {
    for (const double unit : {1e-12, 1e12}) {
        use(latticeMesh({.cubes = {4, 4, 4}, .low = glm::dvec3{-unit}, .high = glm::dvec3{unit}}));
        const auto camera = perspective(glm::dvec3{3, 2, 5} * unit, {0, 0, 0});
        const glm::ivec2 size{16, 16};
        const auto extinction = static_cast<float>(0.1 / unit);
        const auto picture = draw(sceneOf(camera, RayModel::kVolume, fog(extinction)), size);
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const auto ray = pixelRay(camera, size, x, y);
                const double length =
                    lengthInBox(ray.origin, ray.direction, glm::dvec3{-unit}, glm::dvec3{unit});
                EXPECT_NEAR(lengthOf(picture.at(x, y).a, extinction) / unit, length / unit, 1e-5);
            }
        }
    }
}

// The unit tetrahedron, whose path lengths are known by hand.
TEST_F(PathLength, OneCell) {
    const auto cell = [](double height) {
        return data::MeshInput{.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, height}},
                               .cells = {{0, 1, 2, 3}},
                               .fields = {}};
    };
    const auto lengthAlongZ = [&](double x, double y, double z) {
        const auto camera = orthographic({x, y, z}, {x, y, z + 1.0}, 0.01);
        return lengthOf(draw(sceneOf(camera, RayModel::kVolume, fog(kThin)), {1, 1}).at(0, 0).a,
                        kThin);
    };
    use(cell(1.0));
    EXPECT_NEAR(lengthAlongZ(0.25, 0.25, -1.0), 0.5, 1e-6);
    EXPECT_NEAR(lengthAlongZ(0.1, 0.1, 0.1), 0.7, 1e-6);
    EXPECT_NEAR(lengthAlongZ(0.6, 0.6, -1.0), 0.0, 0.0);
    use(cell(1e-6));
    EXPECT_NEAR(lengthAlongZ(0.25, 0.25, -1e-6), 5e-7, 5e-12);
    EXPECT_NEAR(lengthAlongZ(0.25, 0.25, -3.0), 5e-7, 5e-12);
    auto far = cell(1.0);
    for (auto& point : far.points) point = point * 1000.0 + 1e6;
    use(far);
    EXPECT_NEAR(lengthAlongZ(1e6 + 250, 1e6 + 250, 1e6 - 1000) / 500.0, 1.0, 1e-6);
}

}  // namespace
}  // namespace volcast
