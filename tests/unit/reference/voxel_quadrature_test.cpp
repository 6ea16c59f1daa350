// The reference of voxels against sums over many samples of the field, written apart
// (tests/support/volume_reference.h).
#include <cmath>

#include "tests/support/volume_reference.h"
#include "tests/unit/reference/voxel_scenes.h"

namespace volcast::reference::test {
namespace {

using scene::RayModel;
using scene::Sampling;

constexpr int kSamples = 50'000;

data::Volume bumpy() {
    return gridOf(
        {.size = {9, 6, 8},
         .spacing = {0.5, 0.8, 0.3},
         .origin = {-1.0, 20.0, 4.0},
         .direction = glm::dmat3{{0.6, 0.8, 0.0}, {-0.48, 0.36, 0.8}, {0.64, -0.48, 0.6}}},
        [](const glm::dvec3& p) {
            return 0.5 + 0.3 * std::sin(1.3 * p.x + p.y) + 0.2 * std::cos(p.z * p.y);
        });
}

data::TransferFunction bent() {
    return {{{.value = 0.1F, .colour = {0.1F, 0.1F, 0.9F}, .extinction = 0.0F},
             {.value = 0.4F, .colour = {0.2F, 0.9F, 0.1F}, .extinction = 1.0F},
             {.value = 0.5F, .colour = {0.9F, 0.8F, 0.1F}, .extinction = 0.1F},
             {.value = 0.9F, .colour = {1.0F, 0.1F, 0.1F}, .extinction = 6.0F}}};
}

class VoxelQuadrature : public testing::TestWithParam<Sampling> {
protected:
    /// Calls `check(pixel, ray)` for some rays of a picture of `layer`.
    template <class Check>
    void forPixels(RayModel model, const Check& check) {
        scene::Layer layer = layerOf(model, bent());
        layer.sampling = GetParam();
        layer.exposure = -2.0F;
        const glm::dvec3 middle =
            volume_.origin +
            volume_.direction * (0.5 * volume_.spacing * glm::dvec3(volume_.size - 1));
        scene::Scene scene =
            sceneOf({.eye = middle + glm::dvec3(5, 4, 7), .center = middle}, {layer});
        const glm::ivec2 size{5, 4};
        const Picture picture = drawn(scene, volume_, size);
        int met = 0;
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const auto ray = support::referenceRay(scene.camera, size, x, y);
                const glm::dvec2 span = reference_.span(ray);
                if (!(span.x < span.y)) continue;
                ++met;
                check(picture.pixels[static_cast<std::size_t>(y * size.x + x)], ray,
                      span.y - span.x);
            }
        }
        EXPECT_GT(met, 5);
    }

    data::Volume volume_ = bumpy();
    support::VolumeReference reference_{volume_, GetParam()};
};

// The sums are off where a sample's piece holds a jump, which nearest voxels have 20 of on a ray:
// by at most 6 / world unit times half a step of 8e-5. Else by the square of a step times 6 slopes
// of 2 voxels a world unit, squared.
double toleranceOf(Sampling sampling) {
    return sampling == Sampling::kNearest ? 20 * 6 * 4e-5 : 1e-6;
}

TEST_P(VoxelQuadrature, EmissionAndAbsorption) {
    forPixels(RayModel::kVolume, [&](const glm::dvec4& pixel, const auto& ray, double) {
        const glm::dvec4 sum = reference_.composite(ray, bent(), kSamples);
        for (int c = 0; c < 4; ++c) EXPECT_NEAR(pixel[c], sum[c], toleranceOf(GetParam()));
    });
}

TEST_P(VoxelQuadrature, LineIntegrals) {
    const auto sumOf = [&](const auto& ray) {
        glm::dvec4 sum{0.0};
        for (const double value : reference_.valuesOn(ray, kSamples)) {
            sum += support::VolumeReference::matterOf(value, bent());
        }
        return sum / static_cast<double>(kSamples);
    };
    forPixels(RayModel::kXray, [&](const glm::dvec4& pixel, const auto& ray, double length) {
        EXPECT_NEAR(pixel.r, std::exp(-sumOf(ray).a * length), toleranceOf(GetParam()));
    });
    forPixels(RayModel::kSplat, [&](const glm::dvec4& pixel, const auto& ray, double length) {
        EXPECT_NEAR(pixel.g, 0.25 * sumOf(ray).g * length, toleranceOf(GetParam()));
    });
}

TEST_P(VoxelQuadrature, Extremes) {
    forPixels(RayModel::kMip, [&](const glm::dvec4& pixel, const auto& ray, double) {
        bool met = false;
        const double largest = reference_.largest(ray, kSamples, met);
        const glm::dvec4 colour = support::VolumeReference::matterOf(largest, bent());
        EXPECT_NEAR(pixel.r, colour.r,
                    1e-4);  // Slope 10 of the map times that of the field times a step.
    });
}

INSTANTIATE_TEST_SUITE_P(Samplings, VoxelQuadrature,
                         testing::Values(Sampling::kNearest, Sampling::kTrilinear,
                                         Sampling::kTricubic));

}  // namespace
}  // namespace volcast::reference::test
