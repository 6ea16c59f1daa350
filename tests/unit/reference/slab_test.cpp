#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/reference/scenes.h"

namespace volcast::reference::test {
namespace {

using scene::RayModel;

constexpr double kRounding = 1e-13;  // Some hundred roundings of numbers around 1.
const glm::dvec3 kEye{0.37, 0.41, -2.0};
const glm::dvec3 kCenter{0.37, 0.41, 0.5};

/// f = z in the unit cube, whose points float32 holds exactly: along z, f rises from 0 to 1 over a
/// length of 1.
data::Mesh linearCube(int cubes = 4) {
    return boxOf({.cubes = glm::ivec3{cubes}}, [](const auto& p) { return p.z; });
}

TEST(Slab, ConstantExtinctionIsBeerLambert) {
    const data::Mesh mesh = linearCube();
    for (const float extinction : {1e-6F, 0.7F, 30.0F, 1e6F}) {
        const auto layer = layerOf(RayModel::kVolume, constant({0.5F, 0.25F, 1.0F}, extinction));
        const glm::dvec4 pixel = seen(mesh, layer, kEye, kCenter);
        const double alpha = -std::expm1(-static_cast<double>(extinction));
        EXPECT_NEAR(pixel.a / alpha, 1.0, kRounding);
        EXPECT_NEAR(pixel.r / alpha, 0.5, kRounding);
        EXPECT_NEAR(pixel.g / alpha, 0.25, kRounding);
        EXPECT_NEAR(pixel.b / alpha, 1.0, kRounding);
    }
}

TEST(Slab, LinearExtinctionHasAClosedForm) {
    // C = 1 - z, rho = k z: int (1 - z) k z exp(-k z^2 / 2) dz over [0, 1]
    // = 1 - sqrt(pi / (2 k)) erf(sqrt(k / 2)), by parts.
    const data::Mesh mesh = linearCube();
    for (const float k : {0.5F, 4.0F, 100.0F}) {
        data::TransferFunction map = ramp(k);
        map.points[0].colour = glm::vec3{1.0F};
        map.points[1].colour = glm::vec3{0.0F};
        const glm::dvec4 pixel = seen(mesh, layerOf(RayModel::kVolume, map), kEye, kCenter);
        const double kk = k;
        EXPECT_NEAR(pixel.r, 1.0 - std::sqrt(M_PI / (2.0 * kk)) * std::erf(std::sqrt(0.5 * kk)),
                    kRounding);
        EXPECT_NEAR(pixel.a, -std::expm1(-0.5 * kk), kRounding);
    }
}

TEST(Slab, LineIntegralsOfALinearField) {
    const data::Mesh mesh = linearCube();
    scene::Layer xray = layerOf(RayModel::kXray, ramp(3.0F));
    xray.extinctionScale = 2.0F;
    const glm::dvec4 through = seen(mesh, xray, kEye, kCenter);
    EXPECT_NEAR(through.r, std::exp(-2.0 * 1.5), kRounding);
    EXPECT_EQ(through.a, 1.0);
    scene::Layer splat = layerOf(RayModel::kSplat, ramp());
    splat.exposure = 3.0F;
    const glm::dvec4 sum = seen(mesh, splat, kEye, kCenter);
    EXPECT_NEAR(sum.r, 8.0 * 0.5, kRounding);
    EXPECT_EQ(sum.a, 0.0);
}

TEST(Slab, ExtremesOfALinearField) {
    const data::Mesh mesh = linearCube();
    // C is 1 at 1/2 and 0 at both ends: extremes of the field show 0, extremes of the colour 1.
    const data::TransferFunction tent{{{.value = 0.0F},
                                       {.value = 0.5F, .colour = {1, 1, 1}},
                                       {.value = 1.0F, .colour = {0, 0.25F, 0}}}};
    const glm::dvec4 mip = seen(mesh, layerOf(RayModel::kMip, tent), kEye, kCenter);
    EXPECT_EQ(mip, (glm::dvec4{0.0, 0.25, 0.0, 1.0}));
    const glm::dvec4 minip = seen(mesh, layerOf(RayModel::kMinip, tent), kEye, kCenter);
    EXPECT_EQ(minip, (glm::dvec4{0.0, 0.0, 0.0, 1.0}));
    const glm::dvec4 colour = seen(mesh, layerOf(RayModel::kMipColour, tent), kEye, kCenter);
    EXPECT_EQ(colour, (glm::dvec4{1.0, 1.0, 1.0, 1.0}));
}

TEST(Slab, ASurfaceIsSeenWhereTheRayEnters) {
    const data::Mesh mesh = linearCube();
    scene::Layer layer = layerOf(RayModel::kSurface, ramp());
    layer.surfaceColour = {0.25F, 0.5F, 1.0F};
    EXPECT_EQ(seen(mesh, layer, kEye, kCenter), (glm::dvec4{0.25, 0.5, 1.0, 1.0}));
    layer.coloured = true;
    const glm::dvec4 far = seen(mesh, layer, {0.37, 0.41, 3.0}, kCenter);
    EXPECT_EQ(far, (glm::dvec4{1.0, 1.0, 1.0, 1.0}));  // f = 1 at z = 1.
    layer.headlight = true;
    // A ray that leaves z = 0 at 45 degrees: |n . d| = 1 / sqrt(2).
    layer.coloured = false;
    const glm::dvec4 lit = seen(mesh, layer, {0.37, -1.59, -2.0}, {0.37, 0.41, 0.0});
    EXPECT_NEAR(lit.b, std::sqrt(0.5), kRounding);
}

TEST(Slab, IsosurfacesAreTheirLevels) {
    const data::Mesh mesh = linearCube();
    scene::Layer layer = layerOf(RayModel::kIsosurface, ramp());
    layer.levels.values = {0.3F, 0.5F, 0.8F};
    EXPECT_NEAR(seen(mesh, layer, kEye, kCenter).r, 0.3F, kRounding);
    EXPECT_NEAR(seen(mesh, layer, {0.37, 0.41, 3.0}, kCenter).r, 0.8F, kRounding);
    layer.headlight = true;  // The gradient is along z.
    const glm::dvec3 eye{0.37, -1.59, -2.0}, center{0.37, 0.41, 0.3F};
    const double facing = (center - eye).z / glm::length(center - eye);
    EXPECT_NEAR(seen(mesh, layer, eye, center).r, 0.3F * facing, kRounding);
}

TEST(Slab, RaysBesideItSeeNothing) {
    const data::Mesh mesh = linearCube();
    const glm::dvec3 eye{1.5, 0.4, -2.0}, center{1.5, 0.4, 0.0};
    for (const RayModel model :
         {RayModel::kSurface, RayModel::kWireframe, RayModel::kMip, RayModel::kMinip,
          RayModel::kMipColour, RayModel::kSplat, RayModel::kIsosurface, RayModel::kVolume}) {
        scene::Layer layer = layerOf(model, ramp());
        layer.levels.values = {0.5F};
        EXPECT_EQ(seen(mesh, layer, eye, center), glm::dvec4{0.0});
    }
    EXPECT_EQ(seen(mesh, layerOf(RayModel::kXray, ramp()), eye, center), glm::dvec4{1.0});
}

}  // namespace
}  // namespace volcast::reference::test
