// The march against the same integrals in double precision (tests/support/volume_reference.h).
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "renderer/scene/ray_models.h"
#include "tests/gl/volume/blobs_fixture.h"
#include "tests/support/volume_reference.h"

namespace volcast {
namespace {

using scene::Projection;
using scene::RayModel;
using scene::Sampling;

class MarchReference : public support::BlobsTest {
protected:
    /// Of the ray's own number of samples, as the contract of the march has it.
    [[nodiscard]] int samplesOf(const support::VolumeReference& reference,
                                const support::ReferenceRay& ray) const {
        const glm::dvec2 span = reference.span(ray);
        return std::max(
            1, static_cast<int>(std::ceil((span.y - span.x) / scene_.layers[0].stepWorld)));
    }

    /// Largest error of all pixels; rays within a hair of an edge of the box may differ.
    void expectComposite(scene::PictureSize size, double tolerance) {
        const support::VolumeReference reference{volume_, scene_.layers[0].sampling};
        const auto picture = draw(scene_, size);
        double worst = 0.0;
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const auto ray = support::referenceRay(scene_.camera, size, x, y);
                const glm::dvec4 expected =
                    reference.composite(ray, scene_.layers[0].map, samplesOf(reference, ray));
                for (int c = 0; c < 4; ++c) {
                    worst = std::max(worst, std::abs(picture.at(x, y)[c] - expected[c]));
                }
            }
        }
        EXPECT_LT(worst, tolerance);
    }

    /// C and rho of all values, added up.
    [[nodiscard]] glm::dvec4 sumOf(const std::vector<double>& values) const {
        glm::dvec4 sum{0.0};
        for (const double value : values) {
            sum += support::VolumeReference::matterOf(value, scene_.layers[0].map);
        }
        return sum;
    }

    /// `pixel` tells what a ray with samples of these values a distance of dt apart shows.
    void expectOfSamples(
        double tolerance,
        const std::function<glm::dvec4(const std::vector<double>&, double)>& pixel) {
        scene_.layers[0].stepWorld = 0.11;
        const scene::PictureSize size{45, 33};
        const support::VolumeReference reference{volume_, Sampling::kTrilinear};
        const auto picture = draw(scene_, size);
        int met = 0;
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const auto ray = support::referenceRay(scene_.camera, size, x, y);
                const glm::dvec2 span = reference.span(ray);
                const int samples = samplesOf(reference, ray);
                const std::vector<double> values = reference.valuesOn(ray, samples);
                if (values.empty()) continue;
                ++met;
                const glm::dvec4 expected = pixel(values, (span.y - span.x) / samples);
                for (int c = 0; c < 4; ++c) {
                    ASSERT_NEAR(picture.at(x, y)[c], expected[c], tolerance) << x << ' ' << y;
                }
            }
        }
        EXPECT_GT(met, 400);
    }
};

TEST_F(MarchReference, EmissionAndAbsorptionTrilinear) {
    scene_.layers[0].stepWorld = 0.11;
    for (const auto projection : {Projection::kPerspective, Projection::kOrthographic}) {
        scene_.camera.projection = projection;
        expectComposite({45, 33}, 2e-4);
    }
}

TEST_F(MarchReference, EmissionAndAbsorptionTricubic) {
    scene_.layers[0].stepWorld = 0.11;
    scene_.layers[0].sampling = Sampling::kTricubic;
    for (const auto projection : {Projection::kPerspective, Projection::kOrthographic}) {
        scene_.camera.projection = projection;
        expectComposite({45, 33}, 2e-4);
    }
}

TEST_F(MarchReference, EmissionAndAbsorptionFromWithin) {
    scene_.layers[0].stepWorld = 0.11;
    scene_.camera.eye = center_ + glm::dvec3(0.7, -0.3, 0.4);
    scene_.camera.fovyDegrees = 95.0;
    expectComposite({40, 30}, 2e-4);
}

// A sample within rounding of a voxel's face may fall on either side of it: such pixels are few.
TEST_F(MarchReference, NearestPicksTheNearestGridPoint) {
    scene_.layers[0].stepWorld = 0.11;
    scene_.layers[0].sampling = Sampling::kNearest;
    const scene::PictureSize size{45, 33};
    const support::VolumeReference reference{volume_, Sampling::kNearest};
    const auto picture = draw(scene_, size);
    int off = 0, seen = 0;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const auto ray = support::referenceRay(scene_.camera, size, x, y);
            const glm::dvec4 expected =
                reference.composite(ray, scene_.layers[0].map, samplesOf(reference, ray));
            seen += expected.a > 0.0 ? 1 : 0;
            off += glm::length(glm::dvec4(picture.at(x, y)) - expected) > 1e-4 ? 1 : 0;
        }
    }
    EXPECT_GT(seen, 200);
    EXPECT_LE(off, seen / 20);
}

TEST_F(MarchReference, MaximumOfTheSamples) {
    scene_.layers[0].stepWorld = 0.11;
    scene_.layers[0].model = RayModel::kMip;
    scene_.layers[0].map = {{{.value = -1.0F, .colour = glm::vec3(0.0F)},
                             {.value = 101.0F, .colour = glm::vec3(1.0F)}}};
    const scene::PictureSize size{45, 33};
    const support::VolumeReference reference{volume_, Sampling::kTrilinear};
    const auto picture = draw(scene_, size);
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const auto ray = support::referenceRay(scene_.camera, size, x, y);
            bool met = false;
            const double largest = reference.largest(ray, samplesOf(reference, ray), met);
            ASSERT_EQ(picture.at(x, y).a, met ? 1.0F : 0.0F) << x << ' ' << y;
            if (met) {
                ASSERT_NEAR(picture.at(x, y).r, (largest + 1.0) / 102.0, 1e-5) << x << ' ' << y;
            }
        }
    }
}

TEST_F(MarchReference, MinimumOfTheSamples) {
    scene_.layers[0].model = RayModel::kMinip;
    scene_.layers[0].map = {{{.value = -1.0F, .colour = glm::vec3(0.0F)},
                             {.value = 101.0F, .colour = glm::vec3(1.0F)}}};
    expectOfSamples(1e-5, [](const std::vector<double>& values, double /*dt*/) {
        const double smallest = *std::min_element(values.begin(), values.end());
        return glm::dvec4(glm::dvec3((smallest + 1.0) / 102.0), 1.0);
    });
}

// A continuous field has every value between its samples: control points there count.
TEST_F(MarchReference, TheLargestColourOfAllValuesBetweenTheSamples) {
    scene_.layers[0].model = RayModel::kMipColour;
    const data::TransferFunction& map = scene_.layers[0].map;
    // Values are off by 4e-4 (see the sums below), colours rise by 0.04 a unit at most.
    expectOfSamples(2e-5, [&](const std::vector<double>& values, double /*dt*/) {
        const auto [least, most] = std::minmax_element(values.begin(), values.end());
        glm::dvec3 colour = glm::max(glm::dvec3(support::VolumeReference::matterOf(*least, map)),
                                     glm::dvec3(support::VolumeReference::matterOf(*most, map)));
        for (const data::ControlPoint& point : map.points) {
            if (point.value < *least || point.value > *most) continue;
            colour = glm::max(colour, glm::dvec3(point.colour));
        }
        return glm::dvec4(colour, 1.0);
    });
}

// Positions are off by 2^-22 of the 120 grid units to the eye, the field rises by 15 a grid unit at
// most: values by 4e-4. Extinction rises by 0.063 a unit: depths, of rays of up to 17 world
// units, by 4e-4 where every sample is off to one side.
TEST_F(MarchReference, XraysOfTheSamples) {
    scene_.layers[0].model = RayModel::kXray;
    scene_.layers[0].extinctionScale = 0.3F;
    expectOfSamples(0.3 * 4e-4, [&](const std::vector<double>& values, double dt) {
        return glm::dvec4(glm::dvec3(std::exp(-0.3 * sumOf(values).a * dt)), 1.0);
    });
}

TEST_F(MarchReference, LightOfTheSamples) {
    scene_.layers[0].model = RayModel::kSplat;
    scene_.layers[0].exposure = -3.0F;
    expectOfSamples(4e-4 / 8, [&](const std::vector<double>& values, double dt) {
        return glm::dvec4(glm::dvec3(sumOf(values)) * dt / 8.0, 0.0);
    });
}

// Samples outside the interval do not count, under any model.
TEST_F(MarchReference, OnlySamplesInTheIntervalCount) {
    scene_.layers[0].interval = data::Range{.min = 20.0F, .max = 55.0F};
    scene_.layers[0].model = RayModel::kMip;
    scene_.layers[0].map = {{{.value = -1.0F, .colour = glm::vec3(0.0F)},
                             {.value = 101.0F, .colour = glm::vec3(1.0F)}}};
    int within = 0;
    expectOfSamples(1e-5, [&](std::vector<double> values, double /*dt*/) {
        std::erase_if(values, [](double value) { return value < 20.0 || value > 55.0; });
        if (values.empty()) return glm::dvec4(0.0);
        ++within;
        const double largest = *std::max_element(values.begin(), values.end());
        return glm::dvec4(glm::dvec3((largest + 1.0) / 102.0), 1.0);
    });
    EXPECT_GT(within, 100);
}

}  // namespace
}  // namespace volcast
