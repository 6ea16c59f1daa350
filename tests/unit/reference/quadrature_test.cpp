#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/support/ray_caster.h"
#include "tests/unit/reference/scenes.h"

/// Rays against sums over very many samples along them, found by clipping every cell.
namespace volcast::reference::test {
namespace {

using scene::RayModel;

constexpr int kSlices = 4000;  // A piece.

glm::dvec4 valueOf(const data::TransferFunction& map, double value) {
    const auto matter = [&](std::size_t i) {
        return glm::dvec4{map.points[i].colour, map.points[i].extinction};
    };
    if (value < map.points.front().value) return matter(0);
    for (std::size_t i = 1; i < map.points.size(); ++i) {
        const double low = map.points[i - 1].value, high = map.points[i].value;
        if (value < high) return glm::mix(matter(i - 1), matter(i), (value - low) / (high - low));
    }
    return matter(map.points.size() - 1);
}

/// What the midpoint rule finds along one ray.
struct Sampled {
    glm::dvec3 volume{0.0}, sum{0.0}, largest{-1e300};
    double depth = 0.0;
};

Sampled sample(const std::vector<support::CastPiece>& ofF,
               const std::vector<support::CastPiece>& ofG, const scene::Layer& layer) {
    Sampled result;
    for (std::size_t i = 0; i < ofF.size(); ++i) {
        const double step = (ofF[i].back - ofF[i].front) / kSlices;
        for (int k = 0; k < kSlices; ++k) {
            const double t = (k + 0.5) / kSlices;
            const glm::dvec3 colour{valueOf(layer.map, std::lerp(ofF[i].first, ofF[i].last, t))};
            const double own =
                valueOf(layer.densityMap, std::lerp(ofG[i].first, ofG[i].last, t)).a * step;
            result.volume += std::exp(-result.depth) * -std::expm1(-own) * colour;
            result.depth += own;
            result.sum += colour * step;
            result.largest = glm::max(result.largest, colour);
        }
    }
    return result;
}

data::TransferFunction randomMap(std::mt19937& random, int points, float extinction) {
    std::uniform_real_distribution<float> value{-0.5F, 1.5F}, share{0.0F, 1.0F};
    data::TransferFunction map;
    for (int i = 0; i < points; ++i) {
        map.points.push_back({.value = value(random),
                              .colour = {share(random), share(random), share(random)},
                              .extinction = extinction * share(random)});
    }
    std::ranges::sort(map.points, {}, &data::ControlPoint::value);
    return map;
}

data::Mesh twoFields(data::Association second) {
    const glm::ivec3 cubes{3};
    const glm::dvec3 low{-1.0}, high{1.0};
    data::MeshInput input =
        support::latticeMesh({.cubes = cubes,
                              .low = low,
                              .high = high,
                              .keep = [](const auto& c) { return c != glm::ivec3{1}; },
                              .move = support::jitter(cubes, low, high, 0.2)});
    support::addField(input, "f", data::Association::kVertex,
                      [](const auto& p) { return 0.5 + 0.5 * std::sin(3.0 * p.x + p.y * p.z); });
    support::addField(input, "g", second,
                      [](const auto& p) { return 0.5 + 0.5 * std::cos(2.0 * p.y - p.x + p.z); });
    return built(std::move(input));
}

/// Largest difference that the midpoint rule explains: its error is h^2 / 24 times the second
/// derivative, which is at most (slope of rho C T)^2 ~ (20 * 10)^2 but at bends, where the first
/// derivative jumps, once a bend; h = 1 / kSlices of a piece of length 1.
constexpr double kSampling = 1e-5;

void compare(data::Association second, RayModel model, unsigned seed) {
    const data::Mesh mesh = twoFields(second);
    std::mt19937 random{seed};
    std::uniform_real_distribution<double> place{-0.9, 0.9};
    for (int ray = 0; ray < 6; ++ray) {
        scene::Layer layer = layerOf(model, randomMap(random, 6, 1.0F));
        layer.densityField = "g";
        layer.densityMap = randomMap(random, 5, ray % 2 == 0 ? 2.0F : 20.0F);
        const glm::dvec3 eye{place(random), place(random), -4.0};
        const glm::dvec3 center{place(random), place(random), 0.0};
        const support::CastRay cast{.origin = eye, .direction = glm::normalize(center - eye)};
        const support::RayCaster f{mesh, mesh.fields[0]}, g{mesh, mesh.fields[1]};
        const Sampled expected = sample(f.pieces(cast), g.pieces(cast), layer);
        ASSERT_GT(expected.depth, 0.0);
        const glm::dvec4 found = seen(mesh, layer, eye, center);
        glm::dvec4 wanted{expected.volume, -std::expm1(-expected.depth)};
        if (model == RayModel::kXray) wanted = {glm::dvec3{std::exp(-expected.depth)}, 1.0};
        if (model == RayModel::kSplat) wanted = {expected.sum, 0.0};
        if (model == RayModel::kMipColour) wanted = {expected.largest, 1.0};
        for (int channel = 0; channel < 4; ++channel) {
            // A maximum may lie half a slice beside the nearest sample.
            const double error = model == RayModel::kMipColour ? 20.0 / kSlices : kSampling;
            EXPECT_NEAR(found[channel], wanted[channel], error) << "ray " << ray;
        }
    }
}

TEST(Quadrature, VolumeOfTwoFields) {
    compare(data::Association::kVertex, RayModel::kVolume, 1);
    compare(data::Association::kCell, RayModel::kVolume, 2);
    compare(data::Association::kCellVertex, RayModel::kVolume, 3);
}

TEST(Quadrature, LineIntegralsOfTwoFields) {
    compare(data::Association::kVertex, RayModel::kXray, 4);
    compare(data::Association::kCellVertex, RayModel::kSplat, 5);
}

TEST(Quadrature, LargestColours) {
    compare(data::Association::kVertex, RayModel::kMipColour, 6);
}

TEST(Quadrature, StepsAndNarrowPeaks) {
    // f = z over a length of 1. A step at 1/2 and a peak 2^-20 wide and 2^20 high, of depth 1.
    const data::Mesh mesh = boxOf({.cubes = glm::ivec3{4}}, [](const auto& p) { return p.z; });
    const float width = 0x1p-20F;
    const data::TransferFunction map{
        {{.value = 0.25F, .colour = {1, 0, 0}, .extinction = 0},
         {.value = 0.25F + width, .colour = {1, 0, 0}, .extinction = 0x1p20F},
         {.value = 0.25F + 2 * width, .colour = {1, 0, 0}, .extinction = 0},
         {.value = 0.5F, .colour = {0, 1, 0}, .extinction = 0},
         {.value = 0.5F, .colour = {0, 1, 0}, .extinction = 2},
         {.value = 2.0F, .colour = {0, 1, 0}, .extinction = 2}}};
    const glm::dvec4 found =
        seen(mesh, layerOf(RayModel::kVolume, map), {0.3, 0.4, -1.0}, {0.3, 0.4, 0.0});
    // Depth 1 of red (which turns green by 2^-20 of the way after the peak), then 1 of green.
    EXPECT_NEAR(found.r, -std::expm1(-1.0), 1e-9);
    EXPECT_NEAR(found.g, std::exp(-1.0) * -std::expm1(-1.0), 1e-9);
    EXPECT_NEAR(found.a, -std::expm1(-2.0), 1e-9);  // Shares near 1/4 are rounded: 2^-52 * 2^20.
}

TEST(Quadrature, AThousandControlPoints) {
    // Points of rho = v^2 on [0, 1]: trapezoids of width h err by h^2 / 12 * 2.
    data::TransferFunction map;
    for (int i = 0; i < 1024; ++i) {
        const float value = static_cast<float>(i) / 1023.0F;
        map.points.push_back(
            {.value = value, .colour = glm::vec3{1.0F}, .extinction = value * value});
    }
    const data::Mesh mesh = boxOf({.cubes = glm::ivec3{1}}, [](const auto& p) { return p.z; });
    const glm::dvec4 found =
        seen(mesh, layerOf(RayModel::kVolume, map), {0.3, 0.4, -1.0}, {0.3, 0.4, 0.0});
    const double error = 1.0 / 6.0 / (1023.0 * 1023.0);
    EXPECT_NEAR(-std::log1p(-found.a), 1.0 / 3.0 + error, 1e-8);  // Points are float32.
}

}  // namespace
}  // namespace volcast::reference::test
