// The reference of voxels where its answer is known: by hand, or from a mesh of the same field.
#include <cmath>
#include <random>

#include "tests/unit/reference/voxel_scenes.h"

namespace volcast::reference::test {
namespace {

using scene::RayModel;
using scene::Sampling;

constexpr double kRounding = 1e-12;

/// A turn by 3-4-5 about z: exact to rounding.
const glm::dmat3 kTurn{{0.6, 0.8, 0.0}, {-0.8, 0.6, 0.0}, {0.0, 0.0, 1.0}};

scene::Layer sampled(RayModel model, data::TransferFunction map, Sampling sampling) {
    scene::Layer layer = layerOf(model, std::move(map));
    layer.sampling = sampling;
    return layer;
}

TEST(Voxels, ConstantExtinctionIsBeerLambertWhateverTheGrid) {
    const GridDesc desc{.size = {4, 7, 3},
                        .spacing = {0.4, 0.7, 2.5},
                        .origin = {100.0, -3.0, 7.0},
                        .direction = kTurn};
    const data::Volume volume = gridOf(desc, [](const auto&) { return 2.0; });
    const glm::dvec3 extent = desc.spacing * glm::dvec3(desc.size - 1);
    const glm::dvec3 middle = desc.origin + kTurn * (0.5 * extent);
    for (const Sampling sampling :
         {Sampling::kNearest, Sampling::kTrilinear, Sampling::kTricubic}) {
        for (int axis = 0; axis < 3; ++axis) {
            const glm::dvec3 eye = middle - 30.0 * kTurn[axis];
            const auto layer =
                sampled(RayModel::kVolume, constant({0.5F, 0.25F, 1.0F}, 0.7F), sampling);
            const glm::dvec4 pixel = seen(volume, layer, eye, middle);
            const double alpha = -std::expm1(-static_cast<double>(0.7F) * extent[axis]);
            EXPECT_NEAR(pixel.a, alpha, kRounding);
            EXPECT_NEAR(pixel.g, 0.25 * alpha, kRounding);
        }
    }
}

// Of a linear field, trilinear and tetrahedral interpolation are the same function.
TEST(Voxels, ALinearFieldIsThatOfAMesh) {
    const auto field = [](const glm::dvec3& p) { return p.x * 0.25 - p.y * 0.125 + p.z * 0.5; };
    const data::Mesh mesh = boxOf({.cubes = glm::ivec3{4}, .high = glm::dvec3{4.0}}, field);
    const data::Volume volume = gridOf({.size = glm::ivec3{5}}, field);
    data::TransferFunction map{{{.value = 0.1F, .colour = {1, 0, 0}, .extinction = 0.0F},
                                {.value = 0.7F, .colour = {0, 1, 0.5F}, .extinction = 2.0F},
                                {.value = 1.1F, .colour = {0.2F, 0.1F, 1}, .extinction = 0.3F},
                                {.value = 1.1F, .colour = {1, 1, 0}, .extinction = 0.1F},
                                {.value = 2.0F, .colour = {1, 1, 1}, .extinction = 40.0F}}};
    std::mt19937 random{3};
    std::uniform_real_distribution<double> place{0.3, 3.7};
    for (const RayModel model :
         {RayModel::kVolume, RayModel::kXray, RayModel::kSplat, RayModel::kMip, RayModel::kMinip,
          RayModel::kMipColour, RayModel::kIsosurface}) {
        for (int ray = 0; ray < 12; ++ray) {
            const glm::dvec3 center{place(random), place(random), place(random)};
            const glm::dvec3 eye{9.0 + place(random), -4.0 - place(random), 5.0 * place(random)};
            scene::Layer layer = layerOf(model, map);
            layer.headlight = true;
            layer.levels.values = {0.3F, 0.9F, 1.6F};
            if (ray % 3 == 1) layer.interval = data::Range{.min = 0.4F, .max = 1.5F};
            scene::Scene scene = sceneOf(along(eye, center), {layer});
            if (ray % 4 == 2) scene.clipPlanes = {{.normal = {1, 1, 0}, .offset = 2.2}};
            const glm::dvec4 ofMesh = drawn(scene, mesh).pixels.at(0);
            const glm::dvec4 ofVoxels = drawn(scene, volume).pixels.at(0);
            for (int c = 0; c < 4; ++c) {
                // The mesh's cells are found with points rounded to 2^-52 of their distance.
                EXPECT_NEAR(ofVoxels[c], ofMesh[c], 1e-10) << static_cast<int>(model) << ' ' << ray;
            }
        }
    }
}

// f = x y z is trilinear; on the diagonal of a unit cell it is u^3.
TEST(Voxels, ACubicOnTheDiagonalOfACell) {
    const data::Volume volume =
        gridOf({.size = glm::ivec3{2}}, [](const glm::dvec3& p) { return p.x * p.y * p.z; });
    const glm::dvec3 eye{-1.0}, center{1.0};
    const double length = std::sqrt(3.0);
    for (const float k : {0.5F, 7.0F, 300.0F}) {
        // C = 1: alpha = 1 - exp(-k sqrt(3) / 4).
        data::TransferFunction map = ramp(k);
        map.points[0].colour = glm::vec3{1.0F};
        const glm::dvec4 pixel = seen(volume, layerOf(RayModel::kVolume, map), eye, center);
        EXPECT_NEAR(pixel.a, -std::expm1(-k * length / 4.0), kRounding);
        EXPECT_NEAR(pixel.r, pixel.a, 1e-11);
    }
    scene::Layer xray = layerOf(RayModel::kXray, ramp(3.0F));
    EXPECT_NEAR(seen(volume, xray, eye, center).r, std::exp(-3.0 * length / 4.0), kRounding);
    scene::Layer splat = layerOf(RayModel::kSplat, ramp());
    EXPECT_NEAR(seen(volume, splat, eye, center).r, length / 4.0, kRounding);
}

// Along x through the middle of y and z, f = 4 x (1 - x) in [0, 1], by twisting corners.
TEST(Voxels, ExtremesInsideACellCount) {
    // On (u, u, 1/2): f = sum over corners; with f = x + y - 2 x y it is 2 u (1 - u).
    const data::Volume volume = gridOf(
        {.size = glm::ivec3{2}}, [](const glm::dvec3& p) { return p.x + p.y - 2.0 * p.x * p.y; });
    const glm::dvec3 eye{-1.0, -1.0, 0.5}, center{1.0, 1.0, 0.5};
    EXPECT_NEAR(seen(volume, layerOf(RayModel::kMip, ramp()), eye, center).r, 0.5, kRounding);
    EXPECT_NEAR(seen(volume, layerOf(RayModel::kMinip, ramp()), eye, center).r, 0.0, kRounding);
    // A peak of the map at 0.3, which no corner has.
    const data::TransferFunction tent{
        {{.value = 0.2F}, {.value = 0.3F, .colour = {1, 1, 1}}, {.value = 0.4F}}};
    const scene::Layer colour = layerOf(RayModel::kMipColour, tent);
    EXPECT_NEAR(seen(volume, colour, eye, center).r, 1.0, kRounding);
    // The first of two crossings: 2 u (1 - u) = 3/8 at u = 1/4, gradient (1 - 2 y, 1 - 2 x, 0):
    // along the ray; from the other side at 3/4, as far away.
    scene::Layer iso = layerOf(RayModel::kIsosurface, ramp());
    iso.levels.values = {0.375F, 0.49F};
    EXPECT_NEAR(seen(volume, iso, eye, center).r, 0.375, kRounding);
}

TEST(Voxels, IsosurfacesEndWhatIsBehind) {
    // f = x y z on the diagonal: the level c is met at c^(1/3); matter of f before it shows.
    const data::Volume volume =
        gridOf({.size = glm::ivec3{2}}, [](const glm::dvec3& p) { return p.x * p.y * p.z; });
    for (const float level : {1e-3F, 0.2F, 0.9F}) {
        scene::Layer iso = layerOf(RayModel::kIsosurface, ramp());
        iso.levels.values = {level};
        const scene::Layer matter = layerOf(RayModel::kVolume, constant({0, 0, 0}, 1.0F));
        const glm::dvec4 pixel =
            drawn(sceneOf(along(glm::dvec3{-1.0}, glm::dvec3{1.0}), {iso, matter}), volume)
                .pixels.at(0);
        const double before = std::sqrt(3.0) * std::cbrt(static_cast<double>(level));
        EXPECT_NEAR(pixel.r, level * std::exp(-before), kRounding);
    }
}

TEST(Voxels, TheNearestValueFillsItsVoxel) {
    const data::Volume volume =
        gridOf({.size = {4, 2, 2}}, [](const glm::dvec3& p) { return p.x == 2.0 ? 1.0 : 0.0; });
    const glm::dvec3 eye{-2.0, 0.3, 0.2}, center{1.0, 0.3, 0.2};
    const auto alpha = [&](float extinction) {
        const auto layer = sampled(RayModel::kVolume, ramp(extinction), Sampling::kNearest);
        return seen(volume, layer, eye, center).a;
    };
    EXPECT_NEAR(alpha(0.5F), -std::expm1(-0.5), kRounding);  // From 1.5 to 2.5.
    scene::Layer iso = sampled(RayModel::kIsosurface, ramp(), Sampling::kNearest);
    iso.levels.values = {0.25F};
    const scene::Layer matter = layerOf(RayModel::kVolume, constant({0, 0, 0}, 1.0F));
    const glm::dvec4 pixel = drawn(sceneOf(along(eye, center), {iso, matter}), volume).pixels.at(0);
    EXPECT_NEAR(pixel.r, 0.25 * std::exp(-1.5), kRounding);
}

// Catmull-Rom reproduces quadratics where it needs no point beyond a face.
TEST(Voxels, TricubicKeepsQuadratics) {
    const auto field = [](const glm::dvec3& p) {
        return 0.05 * (p.x * p.x + 0.5 * p.y * p.z - p.z * p.z) + 0.3;
    };
    const data::Volume volume = gridOf({.size = glm::ivec3{8}}, [&](const glm::dvec3& p) {
        return std::round(field(p) * 1024.0 * 40.0) / (1024.0 * 40.0);
    });
    scene::Layer layer = sampled(
        RayModel::kSplat,
        {{{.value = -10.0F, .colour = {0, 0, 0}}, {.value = 10.0F, .colour = {20, 20, 20}}}},
        Sampling::kTricubic);
    scene::Scene scene = sceneOf(along({-3.0, 2.3, 3.1}, {4.0, 4.7, 4.0}), {layer});
    scene.clipPlanes = {{.normal = {1, 0, 0}, .offset = 2.0},
                        {.normal = {-1, 0, 0}, .offset = -5.0}};
    const double pixel = drawn(scene, volume).pixels.at(0).r;
    // int (f + 10) ds by Simpson's rule, exact for quadratics.
    const glm::dvec3 a = glm::mix(glm::dvec3(-3.0, 2.3, 3.1), glm::dvec3(4.0, 4.7, 4.0), 5.0 / 7.0);
    const glm::dvec3 way = glm::dvec3(7.0, 2.4, 0.9) / 7.0;
    const glm::dvec3 b = a + 3.0 * way;
    const double mean = (field(a) + 4.0 * field(0.5 * (a + b)) + field(b)) / 6.0 + 10.0;
    // Voxels are off by 1/2^17 at most where they were rounded.
    EXPECT_NEAR(pixel, mean * glm::length(b - a), 5e-5);
}

TEST(Voxels, AVolumeWithoutThicknessIsAPlane) {
    const data::Volume volume =
        gridOf({.size = {3, 1, 3}}, [](const auto& p) { return p.x / 2.0; });
    const glm::dvec3 eye{1.0, -2.0, 1.0}, center{1.0, 0.0, 1.0};
    EXPECT_EQ(seen(volume, layerOf(RayModel::kMip, ramp()), eye, center),
              (glm::dvec4{0.5, 0.5, 0.5, 1.0}));
    EXPECT_EQ(seen(volume, layerOf(RayModel::kVolume, ramp(9.0F)), eye, center), glm::dvec4{0.0});
    EXPECT_EQ(seen(volume, layerOf(RayModel::kXray, ramp(9.0F)), eye, center), glm::dvec4{1.0});
    // Within the plane rays have a length.
    const glm::dvec4 inside =
        seen(volume, layerOf(RayModel::kXray, ramp(1.0F)), {-1.0, 0.0, 1.0}, center);
    EXPECT_NEAR(inside.r, std::exp(-1.0), kRounding);
}

TEST(Voxels, RefusesWhatVoxelsDoNotHave) {
    const data::Volume volume = gridOf({}, [](const auto& p) { return p.x; });
    const auto refused = [&](const scene::Layer& layer) {
        const auto picture = tryDrawn(sceneOf(along({0, 0, -9}, {2, 2, 2}), {layer}), volume);
        EXPECT_FALSE(picture.has_value());
        return picture ? ErrorCode::kIo : picture.error().code;
    };
    EXPECT_EQ(refused(layerOf(RayModel::kSurface, ramp())), ErrorCode::kUnsupported);
    scene::Layer other = layerOf(RayModel::kVolume, ramp());
    other.field = "nothing";
    EXPECT_EQ(refused(other), ErrorCode::kNotFound);
    other.field = "f";
    other.dataset = "nowhere";
    EXPECT_EQ(refused(other), ErrorCode::kNotFound);
}

}  // namespace
}  // namespace volcast::reference::test
