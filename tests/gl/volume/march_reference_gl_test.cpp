// The march against the same integrals in double precision (tests/support/volume_reference.h).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/plan/effects.h"
#include "renderer/scene/ray_models.h"
#include "tests/support/phantoms.h"
#include "tests/support/render_test.h"
#include "tests/support/volume_reference.h"
#include "tests/support/without_skipping.h"

namespace volcast {
namespace {

using scene::Projection;
using scene::RayModel;
using scene::Sampling;

const support::GridPlace kPlace{.size = {37, 21, 50},
                                .spacing = {0.4, 0.7, 0.25},
                                .origin = {-3.0, 900.0, 5.0},
                                .direction = support::turn({2, -1, 1}, 63.0)};

/// Blobs in an empty box, so that some bricks hold nothing.
double blobs(const glm::dvec3& p) {
    const auto blob = [&](const glm::dvec3& c, double r) {
        const glm::dvec3 d = (p - c) / r;
        return std::exp(-glm::dot(d, d));
    };
    return 80.0 * blob({8, 7, 9}, 5.0) + 100.0 * blob({28, 15, 40}, 6.0) + 0.5 * std::sin(p.x);
}

data::TransferFunction map(float lowest) {
    return {{{.value = 10.0F, .colour = {0.1F, 0.1F, 0.9F}, .extinction = lowest},
             {.value = 30.0F, .colour = {0.2F, 0.9F, 0.1F}, .extinction = 0.3F},
             {.value = 60.0F, .colour = {0.9F, 0.8F, 0.1F}, .extinction = 0.1F},
             {.value = 90.0F, .colour = {1.0F, 0.1F, 0.1F}, .extinction = 2.0F}}};
}

class MarchReference : public support::RenderTest {
protected:
    MarchReference() : volume_{support::volumeOf(kPlace, blobs)} {
        renderer_->addDataset("volume", volume_);
        scene::Layer layer;
        layer.id = "layer";
        layer.dataset = "volume";
        layer.map = map(0.0F);
        scene_.layers.push_back(layer);
        center_ =
            kPlace.origin + kPlace.direction * (0.5 * kPlace.spacing * glm::dvec3(kPlace.size - 1));
        scene_.camera = {.eye = center_ + glm::dvec3(21, 14, 25), .center = center_};
        scene_.camera.orthographicHeight = 18.0;
    }

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

    data::Volume volume_;
    scene::Scene scene_;
    glm::dvec3 center_{0.0};
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

// A map that is all but transparent keeps the plan from skipping, and changes nothing visible.
TEST_F(MarchReference, SkippingEmptyBricksChangesNothing) {
    scene_.layers[0].stepWorld = 0.07;
    const auto skipped = draw(scene_, {64, 48});
    scene_.layers[0].map = map(1e-30F);
    const auto full = draw(scene_, {64, 48});
    ASSERT_TRUE(skipped.info.plan.layers[0].has(plan::kEmptyBricks));
    ASSERT_FALSE(full.info.plan.layers[0].has(plan::kEmptyBricks));
    ASSERT_NE(skipped.info.plan.id, full.info.plan.id);
    for (std::size_t i = 0; i < full.linear.size(); ++i) {
        ASSERT_NEAR(skipped.linear[i], full.linear[i], 1e-6F) << i;
    }
}

TEST_F(MarchReference, SkippingEmptyBricksChangesNoIntegrator) {
    scene_.layers[0].stepWorld = 0.07;
    for (const scene::IntegratorRow& row : scene::row(RayModel::kVolume).voxelIntegrators) {
        scene_.layers[0].integrator = row.integrator;
        scene_.layers[0].map = map(0.0F);
        const auto skipped = draw(scene_, {64, 48});
        scene_.layers[0].map = map(1e-30F);
        const auto full = draw(scene_, {64, 48});
        ASSERT_TRUE(skipped.info.plan.layers[0].has(plan::kEmptyBricks));
        ASSERT_FALSE(full.info.plan.layers[0].has(plan::kEmptyBricks));
        // Adaptive steps begin anew behind a brick: at other places, each within its error.
        const float most = row.integrator == scene::Integrator::kAdaptive ? 1.0F / 255 : 2e-6F;
        for (std::size_t i = 0; i < full.linear.size(); ++i) {
            ASSERT_NEAR(skipped.linear[i], full.linear[i], most) << row.name << ' ' << i;
        }
    }
}

TEST_F(MarchReference, SkippingBricksChangesNoModel) {
    const auto withoutSkipping = support::rendererWithoutSkipping(device());
    withoutSkipping->addDataset("volume", volume_);
    scene_.layers[0].levels.values = {20.0F, 45.0F, 70.0F};
    int skipping = 0;
    for (const scene::RayModelRow& row : scene::rayModels()) {
        if (!row.onVolumes || row.chunk.empty()) continue;
        for (int variant = 0; variant < 6; ++variant) {
            const bool interval = variant % 2 == 1;
            scene_.layers[0].model = row.model;
            scene_.layers[0].sampling = static_cast<Sampling>(variant / 2);
            scene_.layers[0].interval.reset();
            if (interval) scene_.layers[0].interval = data::Range{.min = 15.0F, .max = 60.0F};
            const auto skipped = draw(scene_, {64, 48});
            const auto full = support::must(tryDraw(*withoutSkipping, scene_, {64, 48}));
            skipping += skipped.info.plan.layers[0].has(plan::kEmptyBricks) ? 1 : 0;
            EXPECT_EQ(skipped.linear, full.linear) << row.name << ' ' << variant;
        }
    }
    EXPECT_EQ(skipping, 3 * 12) << "all but mip_colour and splat of all values";
}

// Beside a single voxel of 100 tricubic values are below 0, and between two above 100: what only
// such values show must not be passed over with their bricks, whose voxels show nothing.
TEST_F(MarchReference, SkippingBricksSeesTheOvershootOfTricubicValues) {
    const auto withoutSkipping = support::rendererWithoutSkipping(device());
    const data::Volume spikes = support::volumeOf({.size = {50, 50, 50}}, [](const glm::dvec3& p) {
        const glm::ivec3 i{p};
        const bool plate = i.x < 25 && (i.z == 24 || i.z == 25);
        const bool spike = (i.x * 7 + i.y * 11 + i.z * 13) % 53 < 2 && i.z > 15 && i.z < 34;
        return plate || spike ? 100.0 : 0.0;
    });
    renderer_->addDataset("spikes", spikes);
    withoutSkipping->addDataset("spikes", spikes);
    scene::Layer& layer = scene_.layers[0];
    layer.dataset = "spikes";
    layer.sampling = Sampling::kTricubic;
    layer.stepWorld = 0.31;
    layer.headlight = false;
    layer.levels.values = {-4.0F};
    scene_.camera.eye = {80, 60, 90};
    scene_.camera.center = {24, 24, 24};
    const data::TransferFunction below{{{.value = -3.0F, .colour = {1, 1, 1}, .extinction = 1.0F},
                                        {.value = -1.0F, .colour = {1, 1, 1}, .extinction = 0.0F}}};
    const data::TransferFunction above{
        {{.value = 101.0F, .colour = {1, 1, 1}, .extinction = 0.0F},
         {.value = 103.0F, .colour = {1, 1, 1}, .extinction = 1.0F}}};
    for (const RayModel model : {RayModel::kVolume, RayModel::kXray, RayModel::kMip,
                                 RayModel::kMinip, RayModel::kIsosurface}) {
        for (const data::TransferFunction& map : {below, above}) {
            layer.model = model;
            layer.map = map;
            const auto skipped = draw(scene_, {64, 48});
            const auto full = support::must(tryDraw(*withoutSkipping, scene_, {64, 48}));
            EXPECT_EQ(skipped.linear, full.linear) << scene::name(model);
            const bool shows = std::ranges::any_of(full.linear, [](float v) { return v > 0.01F; });
            EXPECT_TRUE(shows) << scene::name(model) << ' ' << map.points[0].value;
        }
    }
}

// Interpolating in the shader, as is done where the texture unit keeps too few bits, gives the
// same picture.
TEST_F(MarchReference, InterpolatingInTheShaderAgreesWithTheTextureUnit) {
    int replaced = 0;
    const auto byHand = support::must(scene::Renderer::create(
        device(), [&replaced](std::string_view path) -> std::optional<std::string> {
            auto text = shading::embeddedChunks()(path);
            const std::string condition = "if (kTexels == kTexture && kFilterInHardware)";
            if (const auto at = text->find(condition); at != std::string::npos) {
                ++replaced;
                text->replace(at, condition.size(), "if (false)");
            }
            return text;
        }));
    byHand->addDataset("volume", volume_);
    scene_.layers[0].stepWorld = 0.11;
    const auto expected = draw(scene_, {64, 48});
    const auto picture = support::must(tryDraw(*byHand, scene_, {64, 48}));
    EXPECT_GT(replaced, 0);
    for (std::size_t i = 0; i < picture.linear.size(); ++i) {
        ASSERT_NEAR(picture.linear[i], expected.linear[i], 2e-4F) << i;
    }
}

TEST_F(MarchReference, HardMapsAndCamerasGiveFiniteNumbers) {
    data::TransferFunction hard{{{.value = 0.0F, .colour = {1, 0, 0}, .extinction = 0.0F},
                                 {.value = 20.0F, .colour = {1, 0, 0}, .extinction = 1e30F},
                                 {.value = 20.0F, .colour = {0, 1, 0}, .extinction = 0.0F},
                                 {.value = 20.000002F, .colour = {0, 1, 0}, .extinction = 1e38F},
                                 {.value = 1e38F, .colour = {0, 0, 1e6F}, .extinction = 0.0F}}};
    scene_.layers[0].map = hard;
    scene_.camera.up = {0, 0, 1};
    for (const glm::dvec3& offset :
         {glm::dvec3(1e-6, 0, 0), glm::dvec3(40, 0, 0), glm::dvec3(1e9, 1, 1),
          kPlace.direction * glm::dvec3(0, 30, 0)}) {
        scene_.camera.eye = center_ + offset;
        for (const scene::RayModelRow& row : scene::rayModels()) {
            if (!row.onVolumes || row.chunk.empty()) continue;
            scene_.layers[0].model = row.model;
            scene_.layers[0].levels.values = {20.0F, 1e38F};
            const auto picture = draw(scene_, {24, 24});
            for (const float value : picture.linear) {
                ASSERT_TRUE(std::isfinite(value)) << offset.x;
            }
        }
    }
}

TEST_F(MarchReference, TheStepIsEnlargedAndSaidSoBeforeTheLoopLimitIsReached) {
    scene_.layers[0].stepWorld = 1e-9;
    const auto picture = draw(scene_, {4, 4});
    EXPECT_TRUE(picture.info.plan.layers[0].has(plan::kStepEnlarged));
    const double longest = glm::length(kPlace.spacing * glm::dvec3(kPlace.size - 1));
    EXPECT_NEAR(picture.info.plan.layers[0].stepWorld, longest / plan::kMaxRaySamples, 1e-12);
    scene_.layers[0].stepWorld = 0.05;
    const auto coarse = draw(scene_, {4, 4});
    EXPECT_FALSE(coarse.info.plan.layers[0].has(plan::kStepEnlarged));
    for (std::size_t i = 0; i < picture.linear.size(); ++i) {
        EXPECT_NEAR(picture.linear[i], coarse.linear[i], 5e-3F) << "cut off by the loop limit?";
    }
}

// Integers of 8 and 16 bits arrive as they are.
TEST_F(MarchReference, IntegerVoxelsKeepTheirValues) {
    const auto drawInteger = [&](data::VoxelType type, const auto& values) {
        data::VolumeInput input;
        input.size = {2, 2, 2};
        input.type = type;
        input.channels.push_back({.name = "i", .unit = "", .voxels = {}});
        const auto bytes = std::as_bytes(std::span{values});
        input.channels[0].voxels.assign(bytes.begin(), bytes.end());
        renderer_->addDataset("integers", support::must(data::buildVolume(std::move(input))));
        scene::Scene scene;
        scene.layers.push_back(scene_.layers[0]);
        scene.layers[0].dataset = "integers";
        scene.layers[0].model = RayModel::kMip;
        scene.layers[0].sampling = Sampling::kNearest;
        scene.layers[0].map = {{{.value = -65536.0F, .colour = glm::vec3(0.0F)},
                                {.value = 65536.0F, .colour = glm::vec3(1.0F)}}};
        scene.camera = {.eye = {0.4, 0.6, 9}, .center = {0.4, 0.6, 0}};
        return draw(scene, {1, 1}).at(0, 0).r * 131072.0 - 65536.0;
    };
    EXPECT_NEAR(
        drawInteger(data::VoxelType::kU8, std::array<std::uint8_t, 8>{1, 2, 251, 4, 5, 6, 9, 8}),
        251.0, 0.02);
    EXPECT_NEAR(drawInteger(data::VoxelType::kU16,
                            std::array<std::uint16_t, 8>{1, 2, 3, 4, 5, 6, 65535, 8}),
                65535.0, 0.02);
    EXPECT_NEAR(drawInteger(data::VoxelType::kI16,
                            std::array<std::int16_t, 8>{-9, -9, -30000, -9, -9, -9, -32768, -9}),
                -30000.0, 0.02);
}

}  // namespace
}  // namespace volcast
