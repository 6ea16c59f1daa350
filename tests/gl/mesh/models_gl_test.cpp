// Ray models on meshes, in closed form and against rays cast in double precision.
#include <array>
#include <cmath>

#include "tests/support/mesh_scenes.h"
#include "tests/support/phantoms.h"
#include "tests/support/ray_caster.h"

namespace volcast {
namespace {

using data::Association;
using scene::RayModel;
using support::addField;
using support::fog;
using support::jitter;
using support::latticeMesh;
using support::orthographic;
using support::perspective;
using support::pixelRay;
using support::ruler;

constexpr std::array kAssociations{Association::kVertex, Association::kCell,
                                   Association::kCellVertex};

class MeshModels : public support::MeshTest {};

// Opacity of a slab is 1 - exp(-sigma length), its colour C times that.
TEST_F(MeshModels, SlabObeysBeerLambert) {
    use(latticeMesh({.cubes = {4, 4, 3}, .low = {-2, -2, 0}, .high = {2, 2, 1.5}}));
    const auto camera = orthographic({0.1, 0.2, 9}, {0.1, 0.2, 0}, 2.0);
    for (const float sigma : {1e-6F, 0.7F, 3.0F, 50.0F}) {
        auto map = fog(sigma);
        map.points[0].colour = {0.9F, 0.5F, 0.1F};
        const auto pixel = draw(sceneOf(camera, RayModel::kVolume, map), {4, 4}).at(1, 2);
        const double alpha = -std::expm1(-1.5 * static_cast<double>(sigma));
        EXPECT_NEAR(pixel.a / alpha, 1.0, 3e-6) << sigma;
        EXPECT_NEAR(pixel.r / alpha, 0.9, 3e-6) << sigma;
        EXPECT_NEAR(pixel.b / alpha, 0.1, 3e-6) << sigma;
    }
}

TEST_F(MeshModels, TransparentMapDrawsNothing) {
    use(latticeMesh({.cubes = {2, 2, 2}}));
    const auto camera = perspective({2, 3, 4}, {0.5, 0.5, 0.5});
    const auto picture = draw(sceneOf(camera, RayModel::kVolume, fog(0.0F)), {8, 8});
    for (const float number : picture.linear) EXPECT_EQ(number, 0.0F);
}

// The largest value of a linear field on a ray lies at one of its ends on the box.
TEST_F(MeshModels, MipOfALinearFieldIsItsLargerEnd) {
    const glm::dvec3 low{-1, -2, -1.5};
    const glm::dvec3 high{1, 2, 1.5};
    const auto f = [](const glm::dvec3& p) { return 0.3 * p.x - 0.2 * p.y + 0.5 * p.z; };
    auto input = latticeMesh({.cubes = {4, 5, 3}, .low = low, .high = high});
    addField(input, "p1", Association::kVertex, f);
    addField(input, "d1", Association::kCellVertex, f);
    use(std::move(input));
    const glm::ivec2 size{41, 31};
    for (const auto& camera :
         {perspective({4, 3, 6}, {0, 0, 0}), perspective({0.1, 0.2, 0.3}, {1, 1, 0}),
          orthographic({0, 0, 9}, {0, 0, 0}, 6.0)}) {
        for (const char* field : {"p1", "d1"}) {
            const auto picture = draw(sceneOf(camera, RayModel::kMip, ruler(-2, 2), field), size);
            int seen = 0;
            for (int y = 0; y < size.y; ++y) {
                for (int x = 0; x < size.x; ++x) {
                    const auto ray = pixelRay(camera, size, x, y);
                    const glm::dvec3 a = (low - ray.origin) / ray.direction;
                    const glm::dvec3 b = (high - ray.origin) / ray.direction;
                    const glm::dvec3 near = glm::min(a, b);
                    const glm::dvec3 far = glm::max(a, b);
                    const double front = std::max({near.x, near.y, near.z, 0.0});
                    const double back = std::min({far.x, far.y, far.z});
                    if (std::abs(back - front) < 0.02) continue;
                    const glm::vec4 pixel = picture.at(x, y);
                    EXPECT_EQ(pixel.a, back > front ? 1.0F : 0.0F);
                    if (back < front) continue;
                    ++seen;
                    const double expected = std::max(f(ray.origin + front * ray.direction),
                                                     f(ray.origin + back * ray.direction));
                    EXPECT_NEAR(4.0 * pixel.r - 2.0, expected, 5e-6) << field << x << ' ' << y;
                }
            }
            EXPECT_GT(seen, 100);
        }
    }
}

TEST_F(MeshModels, SurfaceHasTheColourAndLightOfItsFaces) {
    use(latticeMesh({.cubes = {2, 2, 2}, .low = glm::dvec3{-1}, .high = glm::dvec3{1}}));
    const auto camera = perspective({3, 4, 5}, {0, 0, 0});
    auto scene = sceneOf(camera, RayModel::kSurface, fog(1.0F));
    scene.layers[0].surfaceColour = {0.8F, 0.4F, 0.2F};
    const glm::ivec2 size{40, 40};
    for (const bool lit : {true, false}) {
        scene.layers[0].headlight = lit;
        const auto picture = draw(scene, size);
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const auto ray = pixelRay(camera, size, x, y);
                const auto hit = support::castSurface(mesh_, ray);
                if (picture.at(x, y).a == 0.0F || !hit) continue;
                const double light = lit ? hit->facing : 1.0;
                const glm::dvec3 p = ray.origin + hit->distance * ray.direction;
                // On an edge of the cube either of two sides may be seen.
                const glm::dvec3 near = glm::abs(glm::abs(p) - 1.0);
                if ((near.x < 0.05) + (near.y < 0.05) + (near.z < 0.05) > 1) continue;
                EXPECT_NEAR(picture.at(x, y).r, 0.8 * light, 1e-6);
                EXPECT_NEAR(picture.at(x, y).b, 0.2 * light, 1e-6);
            }
        }
    }
    // From inside, the far sides are seen.
    scene.camera = perspective({0.2, 0.1, 0.3}, {1, 0, 0}, 60.0);
    EXPECT_EQ(draw(scene, size).at(20, 20).a, 1.0F);
}

TEST_F(MeshModels, SurfaceIsColouredByEveryKindOfField) {
    const auto f = [](const glm::dvec3& p) { return p.x + 0.5 * p.y; };
    auto input = latticeMesh({.cubes = {3, 3, 3}});
    for (const auto association : kAssociations) {
        addField(input, std::to_string(static_cast<int>(association)), association, f);
    }
    use(std::move(input));
    const auto camera = orthographic({0.5, 0.5, 5}, {0.5, 0.5, 0}, 0.9);
    const glm::ivec2 size{20, 20};
    for (std::size_t i = 0; i < 3; ++i) {
        auto scene = sceneOf(camera, RayModel::kSurface, ruler(0, 2), mesh_.fields[i].name);
        scene.layers[0].coloured = true;
        scene.layers[0].headlight = false;
        const auto picture = draw(scene, size);
        for (int x = 0; x < size.x; ++x) {
            const auto ray = pixelRay(camera, size, x, 7);
            const auto hit = support::castSurface(mesh_, ray);
            ASSERT_TRUE(hit);
            const auto cell = static_cast<std::size_t>(mesh_.boundaryFaces[hit->face].cell);
            const double expected = mesh_.fields[i].association == Association::kCell
                                        ? mesh_.fields[i].steps[0][cell]
                                        : f(ray.origin + hit->distance * ray.direction);
            EXPECT_NEAR(2.0 * picture.at(x, 7).r, expected, 2e-6) << mesh_.fields[i].name;
        }
    }
}

// An opaque layer of the same mesh in front: nothing of the fog shows. In a mesh of two boxes, the
// surface of one ends the rays through the other.
TEST_F(MeshModels, RaysEndAtOpaqueSurfaces) {
    use(latticeMesh({.cubes = {4, 4, 4}, .low = glm::dvec3{-1}, .high = glm::dvec3{1}}));
    renderer_->addDataset(
        "plate",
        support::must(data::buildMesh(latticeMesh({.low = {-9, -9, -0.5}, .high = {9, 9, 0.25}}))));
    const float sigma = 0.6F;
    for (const auto& camera : {orthographic({0.1, 0.2, 9}, {0.1, 0.2, 0}, 1.0),
                               orthographic({0.1, 0.2, 0.7}, {0.1, 0.2, 0}, 1.0)}) {
        auto scene = sceneOf(camera, RayModel::kVolume, fog(sigma));
        scene::Layer plate;
        plate.id = "plate";
        plate.dataset = "plate";
        plate.model = RayModel::kSurface;
        plate.surfaceColour = {0.0F, 1.0F, 0.0F};
        plate.headlight = false;
        scene.layers.push_back(plate);
        const auto pixel = draw(scene, {4, 4}).at(1, 1);
        const double fogLength = std::min(camera.eye.z, 1.0) - 0.25;
        EXPECT_NEAR(pixel.r, -std::expm1(-sigma * fogLength), 3e-6);
        EXPECT_NEAR(pixel.g, 1.0, 3e-6);
        EXPECT_NEAR(pixel.a, 1.0, 1e-6);
    }
}

// A mesh without symmetry, a field without structure, against clipped rays in double.
TEST_F(MeshModels, AgreeWithRaysCastInDouble) {
    const glm::ivec3 cubes{7, 6, 8};
    const glm::dvec3 low{-1};
    const glm::dvec3 high{1};
    auto input = latticeMesh(
        {.cubes = cubes, .low = low, .high = high, .move = jitter(cubes, low, high, 0.12)});
    const auto f = [](const glm::dvec3& p) {
        return 0.5 +
               0.5 * std::sin(5.0 * p.x + 1.0) * std::cos(4.0 * p.y) * std::sin(3.0 * p.z + 2.0);
    };
    for (const auto association : kAssociations) {
        addField(input, std::to_string(static_cast<int>(association)), association, f);
    }
    use(std::move(input));
    const data::TransferFunction map{{{.value = 0.1F, .colour = {0, 0, 1}, .extinction = 0.0F},
                                      {.value = 0.45F, .colour = {0, 1, 0}, .extinction = 2.0F},
                                      {.value = 0.5F, .colour = {1, 1, 0}, .extinction = 0.1F},
                                      {.value = 0.9F, .colour = {1, 0, 0}, .extinction = 4.0F}}};
    const glm::ivec2 size{48, 40};
    for (const auto& camera : {perspective({2.1, 1.7, 3.3}, {0, 0, 0}),
                               perspective({0.21, -0.13, 0.34}, {1, 0.3, -0.2}, 80.0),
                               orthographic({-3, 2, 1}, {0, 0, 0}, 3.6),
                               orthographic({0.1, 0.2, 0.3}, {1, -1, 0.5}, 2.0)}) {
        for (const data::Field& field : mesh_.fields) {
            const support::RayCaster caster{mesh_, field};
            auto scene = sceneOf(camera, RayModel::kVolume, map, field.name);
            const auto exact = draw(scene, size);
            scene.layers[0].integrator = scene::Integrator::kAverage;
            const auto volume = draw(scene, size);
            const auto mip = draw(sceneOf(camera, RayModel::kMip, map, field.name), size);
            for (int y = 0; y < size.y; y += 3) {
                for (int x = 0; x < size.x; x += 3) {
                    const auto pieces = caster.pieces(pixelRay(camera, size, x, y));
                    const double length = support::pathLength(pieces);
                    if (length > 0.0 && length < 0.02) continue;  // A silhouette.
                    const glm::dvec4 average = castAverage(pieces, map);
                    // Midpoints in 256 slices of a cell are off by 1e-6 here.
                    const glm::dvec4 all = castExact(pieces, map);
                    const glm::dvec4 largest = castMip(pieces, map);
                    for (int i = 0; i < 4; ++i) {
                        EXPECT_NEAR(volume.at(x, y)[i], average[i], 1e-5)
                            << field.name << ' ' << x << ' ' << y << ' ' << i;
                        EXPECT_NEAR(exact.at(x, y)[i], all[i], 1e-5)
                            << field.name << ' ' << x << ' ' << y << ' ' << i;
                        EXPECT_NEAR(mip.at(x, y)[i], largest[i], 1e-4)
                            << field.name << ' ' << x << ' ' << y << ' ' << i;
                    }
                }
            }
        }
    }
}

// The picture belongs to the mesh, not to the order in which a file holds it.
TEST_F(MeshModels, OrderOfTheFileDoesNotMatter) {
    auto input = latticeMesh({.cubes = {5, 5, 5}});
    for (const auto association : kAssociations) {
        addField(input, std::to_string(static_cast<int>(association)), association,
                 [](const glm::dvec3& p) { return std::sin(9.0 * p.x) + p.y * p.z; });
    }
    const auto camera = perspective({2, 3, 4}, {0.5, 0.5, 0.5});
    for (const char* field : {"0", "1", "2"}) {
        use(input);
        const auto scene = sceneOf(camera, RayModel::kVolume, ruler(-1, 2), field);
        const auto before = draw(scene, {32, 32});
        use(support::shuffled(input, 5));
        const auto after = draw(scene, {32, 32});
        for (std::size_t i = 0; i < before.linear.size(); ++i) {
            EXPECT_NEAR(before.linear[i], after.linear[i], 1e-6) << field << ' ' << i;
        }
    }
}

// Cells a hundred thousand times thinner than wide, and flat in float32: finite and right.
TEST_F(MeshModels, SliversAreFiniteAndCount) {
    for (const double thickness : {1e-3, 1e-5, 1e-9}) {
        use(latticeMesh({.cubes = {3, 3, 4}, .move = [thickness](const glm::dvec3& p) {
                             const double z = p.z < 0.4 ? p.z : p.z < 0.6 ? 0.25 + thickness : p.z;
                             return glm::dvec3{p.x, p.y, z};
                         }}));
        const auto camera = perspective({1.9, 2.3, 3.1}, {0.5, 0.5, 0.5});
        const glm::ivec2 size{24, 24};
        const auto picture = draw(sceneOf(camera, RayModel::kVolume, fog(1e-3F)), size);
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const auto ray = pixelRay(camera, size, x, y);
                const auto box = [&](double hair) {
                    return support::lengthInBox(ray.origin, ray.direction, glm::dvec3{-hair},
                                                glm::dvec3{1.0 + hair});
                };
                ASSERT_TRUE(std::isfinite(picture.at(x, y).a));
                if (box(1e-3) > 0.0 && box(-1e-3) == 0.0) continue;
                EXPECT_NEAR(support::lengthOf(picture.at(x, y).a, 1e-3F), box(0.0), 5e-5);
            }
        }
    }
}

}  // namespace
}  // namespace volcast
