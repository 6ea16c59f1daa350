// Meshes that rays leave and enter again: re-entry, holes, several parts, long lists and long rays.
#include <cmath>

#include "tests/support/mesh_scenes.h"
#include "tests/support/ray_caster.h"

namespace volcast {
namespace {

using scene::RayModel;
using support::addField;
using support::fog;
using support::latticeMesh;
using support::lengthOf;
using support::orthographic;
using support::perspective;
using support::pixelRay;

constexpr float kThin = 1e-3F;

class NonConvex : public support::MeshTest {
protected:
    /// Draws lengths and compares them with cast rays, but for pixels near a silhouette: those
    /// where a ray a hair beside has another number of pieces' worth of length.
    void expectLengths(const scene::Camera& camera, glm::ivec2 size, double tolerance) {
        const auto picture = draw(sceneOf(camera, RayModel::kVolume, fog(kThin)), size);
        const support::RayCaster caster{mesh_, mesh_.fields[0]};
        int compared = 0;
        int hits = 0;
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const auto ray = pixelRay(camera, size, x, y);
                const double length = pathLength(caster.pieces(ray));
                if (nearSilhouette(caster, ray, length)) continue;
                ++compared;
                hits += length > 0.0 ? 1 : 0;
                EXPECT_NEAR(lengthOf(picture.at(x, y).a, kThin), length, tolerance)
                    << x << ' ' << y;
            }
        }
        EXPECT_GT(compared, size.x * size.y / 2);
        EXPECT_GT(hits, size.x * size.y / 20);
    }

private:
    static bool nearSilhouette(const support::RayCaster& caster, const support::CastRay& ray,
                               double length) {
        const glm::dvec3 side =
            glm::normalize(glm::cross(ray.direction, glm::dvec3{0.3, 0.5, 0.8}));
        const glm::dvec3 other = glm::cross(ray.direction, side);
        const double hair = 2e-3;
        for (const glm::dvec3 offset : {side, -side, other, -other}) {
            support::CastRay beside = ray;
            beside.direction = glm::normalize(beside.direction + 0.2 * hair * offset);
            beside.origin += 0.5 * hair * offset;
            if (std::abs(pathLength(caster.pieces(beside)) - length) > 0.05) return true;
        }
        return false;
    }
};

struct Shape {
    const char* name;
    glm::ivec3 cubes;
    std::function<bool(const glm::ivec3&)> keep;
};

const std::vector<Shape>& shapes() {
    static const std::vector<Shape> kShapes{
        {"L", {4, 4, 2}, [](const auto& c) { return c.x < 2 || c.y < 2; }},
        {"two parts", {5, 2, 2}, [](const auto& c) { return c.x != 2; }},
        {"ring",
         {5, 5, 2},
         [](const auto& c) { return c.x == 0 || c.x == 4 || c.y == 0 || c.y == 4; }},
        {"shell",
         {4, 4, 4},
         [](const auto& c) {
             return c.x == 0 || c.y == 0 || c.z == 0 || c.x == 3 || c.y == 3 || c.z == 3;
         }},
        {"chequers", {4, 4, 4}, [](const auto& c) { return (c.x + c.y + c.z) % 2 == 0; }},
        {"comb", {9, 2, 3}, [](const auto& c) { return c.x % 2 == 0 || c.y == 0; }},
    };
    return kShapes;
}

TEST_F(NonConvex, ShapesFromOutside) {
    for (const Shape& shape : shapes()) {
        SCOPED_TRACE(shape.name);
        use(latticeMesh({.cubes = shape.cubes,
                         .low = glm::dvec3{-1},
                         .high = glm::dvec3{1},
                         .keep = shape.keep}));
        ASSERT_FALSE(mesh_.convex);
        for (const glm::dvec3 eye : {glm::dvec3{3.1, 2.3, 4.4}, glm::dvec3{-4.1, 0.37, 0.23}}) {
            expectLengths(perspective(eye, {0, 0, 0}), {31, 31}, 2e-5);
        }
        expectLengths(orthographic({1.3, 4.1, 2.2}, {0, 0, 0}, 4.0), {31, 31}, 2e-5);
    }
}

TEST_F(NonConvex, ShapesFromInside) {
    for (const Shape& shape : shapes()) {
        SCOPED_TRACE(shape.name);
        use(latticeMesh({.cubes = shape.cubes,
                         .low = glm::dvec3{-1},
                         .high = glm::dvec3{1},
                         .keep = shape.keep}));
        // In a cell or in a hollow, depending on the shape.
        for (const glm::dvec3 eye :
             {glm::dvec3{-0.83, -0.71, -0.62}, glm::dvec3{0.03, 0.07, 0.11}}) {
            expectLengths(perspective(eye, {0.9, 0.7, 0.5}, 90.0), {31, 31}, 2e-5);
            expectLengths(orthographic(eye, {0.9, 0.7, 0.5}, 3.0), {31, 31}, 2e-5);
        }
    }
}

// Views along the axes meet many boundary faces edge-on.
TEST_F(NonConvex, AlongAxesInClosedForm) {
    const int n = 4;
    use(latticeMesh({.cubes = {n, n, n}, .high = glm::dvec3{n}, .keep = [](const auto& c) {
                         return c.x == 0 || c.y == 0 || c.z == 0 || c.x == 3 || c.y == 3 ||
                                c.z == 3;
                     }}));
    // Between lattice lines, and along lattice lines inside the cube.
    for (const double shift : {0.0, 0.25}) {
        const auto camera = orthographic({2 + shift, 2 + shift, 9}, {2 + shift, 2 + shift, 0}, n);
        const auto picture = draw(sceneOf(camera, RayModel::kVolume, fog(kThin)), {n, n});
        for (int y = 0; y < n - 1; ++y) {
            for (int x = 0; x < n - 1; ++x) {
                const bool hollow = x > 0 && x < 3 && y > 0 && y < 3;
                if (shift == 0.0) {
                    EXPECT_NEAR(lengthOf(picture.at(x, y).a, kThin), hollow ? 2.0 : 4.0, 2e-5);
                }
                EXPECT_TRUE(std::isfinite(picture.at(x, y).a));
            }
        }
    }
}

// The map sees the field of the part that is met: front part white, back part black.
TEST_F(NonConvex, PartsAreMetFrontToBack) {
    auto input = latticeMesh(
        {.cubes = {1, 1, 3}, .high = {1, 1, 3}, .keep = [](const auto& c) { return c.z != 1; }});
    addField(input, "f", data::Association::kCell,
             [](const glm::dvec3& p) { return p.z > 1.5 ? 1.0 : 0.0; });
    use(std::move(input));
    const float sigma = 0.8F;
    const double a = -std::expm1(-static_cast<double>(sigma));
    for (const bool front : {true, false}) {
        const auto camera = orthographic({0.4, 0.3, front ? 9.0 : -6.0}, {0.4, 0.3, 1.5}, 0.2);
        const auto pixel =
            draw(sceneOf(camera, RayModel::kVolume, support::ruler(0, 1, sigma)), {2, 2}).at(0, 0);
        EXPECT_NEAR(pixel.r, front ? a : (1.0 - a) * a, 2e-6);
        EXPECT_NEAR(pixel.a, 1.0 - (1.0 - a) * (1.0 - a), 2e-6);
        const auto mip =
            draw(sceneOf(camera, RayModel::kMip, support::ruler(0, 1)), {2, 2}).at(0, 0);
        EXPECT_NEAR(mip.r, 1.0, 1e-6);
    }
}

// More entries than the lists have room for at first: they grow, and nothing is lost.
TEST_F(NonConvex, ListsGrowToWhatThePictureNeeds) {
    const int n = 41;
    use(latticeMesh({.cubes = {1, 1, n}, .high = {1, 1, n}, .keep = [](const auto& c) {
                         return c.z % 2 == 0;
                     }}));
    const auto camera = orthographic({0.5, 0.5, 99}, {0.5, 0.5, 0}, 0.9);
    const glm::ivec2 size{128, 128};  // 21 entries each: more than 65,536.
    const auto picture = draw(sceneOf(camera, RayModel::kVolume, fog(kThin)), size);
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x)
            ASSERT_NEAR(lengthOf(picture.at(x, y).a, kThin), 21.0, 2e-4);
    }
}

// One ray through more cells than a draw may step through.
TEST_F(NonConvex, LongRaysGoOnInFurtherDraws) {
    const int n = 30000;
    auto input = latticeMesh({.cubes = {1, 1, n}, .high = {1, 1, n}});
    addField(input, "f", data::Association::kVertex, [](const glm::dvec3& p) { return p.z; });
    use(std::move(input));
    ASSERT_TRUE(mesh_.convex);
    const auto camera = orthographic({0.5, 0.5, n + 10.0}, {0.5, 0.5, 0}, 0.8);
    const glm::ivec2 size{5, 5};
    const float sigma = 1e-5F;
    const auto picture = draw(sceneOf(camera, RayModel::kVolume, fog(sigma)), size);
    const auto mip = draw(sceneOf(orthographic({0.5, 0.5, -10}, {0.5, 0.5, 0}, 0.8), RayModel::kMip,
                                  support::ruler(0, static_cast<float>(n))),
                          size);
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            EXPECT_NEAR(lengthOf(picture.at(x, y).a, sigma) / n, 1.0, 1e-3) << x << ' ' << y;
            EXPECT_NEAR(mip.at(x, y).r, 1.0, 1e-6) << x << ' ' << y;
        }
    }
}

// The same with lists, where a draw has fewer steps.
TEST_F(NonConvex, LongRaysGoOnAlsoBetweenParts) {
    const int n = 6001;
    use(latticeMesh({.cubes = {1, 1, n}, .high = {1, 1, n}, .keep = [](const auto& c) {
                         return c.z != 4000;
                     }}));
    const auto camera = orthographic({0.5, 0.5, n + 10.0}, {0.5, 0.5, 0}, 0.8);
    const float sigma = 1e-5F;
    const auto picture = draw(sceneOf(camera, RayModel::kVolume, fog(sigma)), {4, 4});
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 4; ++x) {
            EXPECT_NEAR(lengthOf(picture.at(x, y).a, sigma) / 6000.0, 1.0, 1e-3) << x << ' ' << y;
        }
    }
}

}  // namespace
}  // namespace volcast
