// Rays that pass over empty space draw what rays draw that do not.
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "renderer/plan/effects.h"
#include "renderer/scene/cover.h"
#include "renderer/scene/shown_values.h"
#include "tests/support/edited_renderers.h"
#include "tests/support/phantoms.h"
#include "tests/support/render_test.h"
#include "tests/support/volume_reference.h"

namespace volcast {
namespace {

using scene::Projection;
using scene::RayModel;
using scene::Sampling;

/// A volume of bytes that is 0 but for some small boxes and balls.
data::Volume specks(glm::ivec3 size, std::mt19937& random) {
    std::vector<std::uint8_t> voxels(static_cast<std::size_t>(size.x) * size.y * size.z);
    const auto upTo = [&random](int last) {
        return std::uniform_int_distribution{0, last}(random);
    };
    for (int speck = 0; speck < 7; ++speck) {
        const glm::ivec3 at{upTo(size.x - 1), upTo(size.y - 1), upTo(size.z - 1)};
        const int radius = upTo(5), value = 40 + upTo(200);
        for (int z = std::max(at.z - radius, 0); z <= std::min(at.z + radius, size.z - 1); ++z) {
            for (int y = std::max(at.y - radius, 0); y <= std::min(at.y + radius, size.y - 1);
                 ++y) {
                for (int x = std::max(at.x - radius, 0); x <= std::min(at.x + radius, size.x - 1);
                     ++x) {
                    const glm::ivec3 off = glm::ivec3{x, y, z} - at;
                    const int far = std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)});
                    voxels[(static_cast<std::size_t>(z) * size.y + y) * size.x + x] =
                        static_cast<std::uint8_t>(value - far * value / (radius + 2));
                }
            }
        }
    }
    data::ChannelInput channel{.name = "f", .unit = "", .voxels = {}};
    for (const std::uint8_t voxel : voxels) channel.voxels.push_back(std::byte{voxel});
    data::VolumeInput input;
    input.size = size;
    input.type = data::VoxelType::kU8;
    input.spacing = {0.5, 0.4, 0.7};
    input.direction = support::turn({1, 2, -1}, 40.0);
    input.channels.push_back(std::move(channel));
    return support::must(data::buildVolume(std::move(input)));
}

/// Extinction in one to three bands of values, none between them.
data::TransferFunction bands(std::mt19937& random) {
    std::uniform_real_distribution<float> width{2.0F, 25.0F}, apart{15.0F, 70.0F},
        colour{0.0F, 1.0F};
    data::TransferFunction map;
    float value = apart(random);
    for (int band = std::uniform_int_distribution{1, 3}(random); band > 0; --band) {
        const auto add = [&](float extinction) {
            map.points.push_back({.value = value,
                                  .colour = {colour(random), colour(random), colour(random)},
                                  .extinction = extinction});
        };
        add(0.0F);
        value += width(random);
        add(0.2F);  // No ray gets opaque: where it stops would differ by some samples.
        value += width(random);
        add(0.0F);
        value += apart(random);
    }
    return map;
}

class EmptySpaceTest : public support::RenderTest {
protected:
    EmptySpaceTest() {
        scene::Layer layer;
        layer.id = "layer";
        layer.dataset = "volume";
        scene_.layers.push_back(layer);
    }

    /// From outside, from within, parallel, along an axis; then between clip planes.
    void view(const data::Volume& volume, int variant) {
        const glm::dvec3 extent = volume.spacing * glm::dvec3(volume.size - 1);
        const glm::dvec3 middle = volume.direction * (0.5 * extent);
        const double far = glm::length(extent);
        scene_.camera = {.eye = middle + 1.3 * far * glm::normalize(glm::dvec3(0.8, 0.4, 1.0)),
                         .center = middle};
        scene_.camera.fovyDegrees = 40.0;
        scene_.camera.orthographicHeight = 0.8 * far;
        scene_.clipPlanes.clear();
        if (variant == 1) scene_.camera.eye = middle + 0.1 * far * volume.direction[0];
        if (variant == 2) scene_.camera.projection = Projection::kOrthographic;
        if (variant == 3) scene_.camera.eye = middle + far * volume.direction[2];
        if (variant == 3) scene_.camera.projection = Projection::kOrthographic;
        if (variant == 4) {
            scene_.clipPlanes = {
                {.normal = {1.0, 0.3, 0.2}, .offset = glm::dot(middle, {1.0, 0.3, 0.2})},
                {.normal = {-0.2, -1.0, 0.1}, .offset = glm::dot(middle, {-0.2, -1.0, 0.1}) - 3.0}};
        }
    }

    scene::Scene scene_;
};

TEST_F(EmptySpaceTest, RaysThatPassOverItDrawTheSamePicture) {
    const auto passingOverNothing = support::rendererWithoutSkipping(device());
    std::mt19937 random{20};
    const std::vector<glm::ivec3> sizes{{50, 40, 60}, {1, 60, 50}, {70, 2, 33}, {65, 1, 1}};
    int drawn = 0, seen = 0;
    for (const glm::ivec3 size : sizes) {
        const data::Volume volume = specks(size, random);
        renderer_->addDataset("volume", volume);
        passingOverNothing->addDataset("volume", volume);
        for (int variant = 0; variant < 5; ++variant) {
            view(volume, variant);
            for (int kind = 0; kind < 6; ++kind) {
                scene::Layer& layer = scene_.layers[0];
                layer.map = bands(random);
                layer.stepWorld = kind % 2 == 0 ? 0.21 : 0.93;
                layer.sampling = kind == 4 ? Sampling::kTricubic : Sampling::kTrilinear;
                layer.integrator =
                    kind == 3 ? scene::Integrator::kExact : scene::Integrator::kAverage;
                layer.model = kind == 1   ? RayModel::kIsosurface
                              : kind == 5 ? RayModel::kXray
                                          : RayModel::kVolume;
                if (kind == 5) layer.integrator = scene::Integrator::kAuto;
                if (kind == 1) layer.integrator = scene::Integrator::kAuto;
                layer.levels.values = {30.0F, 100.0F};
                layer.light.reset();
                if (kind == 2) layer.light = scene::Light{};
                const auto passed = draw(scene_, {64, 48});
                const auto all = support::must(tryDraw(*passingOverNothing, scene_, {64, 48}));
                ASSERT_TRUE(passed.info.plan.layers[0].has(plan::kEmptyBricks));
                EXPECT_EQ(passed.linear, all.linear) << size.x << ' ' << size.y << ' ' << size.z
                                                     << ", view " << variant << ", kind " << kind;
                ++drawn;
                const auto [least, most] =
                    std::minmax_element(passed.linear.begin(), passed.linear.end());
                if (*least < *most) ++seen;
            }
        }
    }
    EXPECT_GT(seen, drawn / 3) << "of " << drawn << " pictures many show something";
}

// Adaptive steps begin anew where empty space ends: both are as near to the truth, where none of
// the field is too thin to be seen by either.
TEST_F(EmptySpaceTest, AdaptiveStepsKeepTheirError) {
    const auto passingOverNothing = support::rendererWithoutSkipping(device());
    std::mt19937 random{4};
    const data::Volume volume = specks({50, 40, 60}, random);
    renderer_->addDataset("volume", volume);
    passingOverNothing->addDataset("volume", volume);
    view(volume, 0);
    scene_.layers[0].map = {{{.value = 20.0F, .colour = {0.2F, 0.5F, 0.9F}, .extinction = 0.0F},
                             {.value = 255.0F, .colour = {0.9F, 0.5F, 0.2F}, .extinction = 0.3F}}};
    scene_.layers[0].integrator = scene::Integrator::kAdaptive;
    const auto passed = draw(scene_, {64, 48});
    const auto all = support::must(tryDraw(*passingOverNothing, scene_, {64, 48}));
    for (std::size_t i = 0; i < passed.linear.size(); ++i) {
        ASSERT_NEAR(passed.linear[i], all.linear[i], 1.0F / 255.0F) << i;  // kAdaptiveError
    }
}

// A picture after a change of the map is that of a renderer which has seen no other.
TEST_F(EmptySpaceTest, FollowsTheMap) {
    std::mt19937 random{9};
    const data::Volume volume = specks({40, 40, 40}, random);
    renderer_->addDataset("volume", volume);
    view(volume, 0);
    for (int change = 0; change < 4; ++change) {
        scene_.layers[0].map = bands(random);
        scene_.layers[0].sampling = change == 2 ? Sampling::kTricubic : Sampling::kTrilinear;
        const auto fresh =
            support::must(scene::Renderer::create(device(), shading::embeddedChunks()));
        fresh->addDataset("volume", volume);
        EXPECT_EQ(draw(scene_, {64, 48}).linear,
                  support::must(tryDraw(*fresh, scene_, {64, 48})).linear);
    }
}

TEST(ShownValues, AreThoseWithExtinction) {
    const auto point = [](float value, float extinction) {
        return data::ControlPoint{.value = value, .colour = {}, .extinction = extinction};
    };
    const data::TransferFunction map{{point(1, 0), point(2, 3), point(3, 0), point(4, 0),
                                      point(5, 0), point(5, 2), point(6, 2)}};
    const volume::ShownValues shown = scene::absorbingValues(map);
    ASSERT_EQ(shown.size(), 2U);
    EXPECT_EQ(shown[0], glm::vec2(std::nextafter(1.0F, 2.0F), std::nextafter(3.0F, 2.0F)));
    EXPECT_EQ(shown[1].x, 5.0F);
    EXPECT_TRUE(std::isinf(shown[1].y));
    // Against the map itself, between and at its points.
    for (float value = 0.0F; value < 8.0F; value += 0.125F) {
        const bool inside = std::ranges::any_of(
            shown, [value](glm::vec2 part) { return value >= part.x && value <= part.y; });
        EXPECT_EQ(inside, data::evaluate(map, value).a > 0.0F) << value;
    }
}

TEST(Cover, HoldsEveryPixelWhoseRayMeetsTheBox) {
    std::mt19937 random{11};
    std::uniform_real_distribution<double> unit{-1.0, 1.0};
    const auto vector = [&] { return glm::dvec3{unit(random), unit(random), unit(random)}; };
    const data::Volume volume = support::volumeOf(
        {.size = {9, 12, 5}, .spacing = {1.0, 0.5, 2.0}, .direction = support::turn({1, 1, 3}, 70)},
        [](const glm::dvec3&) { return 0.0; });
    const support::VolumeReference reference{volume, Sampling::kTrilinear};
    const scene::PictureSize size{40, 30};
    int empty = 0, whole = 0, met = 0;
    for (int i = 0; i < 300; ++i) {
        scene::Camera camera{.eye = 12.0 * vector(), .center = 9.0 * vector()};
        camera.projection = i % 2 == 0 ? Projection::kPerspective : Projection::kOrthographic;
        camera.orthographicHeight = 6.0;
        const std::array all{glm::vec3{0.0F}, glm::vec3{volume.size - 1}};
        const scene::PixelBox cover = scene::coverOf(camera, size, volume, all);
        empty += cover.size.x * cover.size.y == 0 ? 1 : 0;
        whole += cover.size == glm::ivec2{size} ? 1 : 0;
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const glm::dvec2 span = reference.span(support::referenceRay(camera, size, x, y));
                if (!(span.x < span.y)) continue;
                ++met;
                const glm::ivec2 off = glm::ivec2{x, y} - cover.low;
                ASSERT_TRUE(off.x >= 0 && off.y >= 0 && off.x < cover.size.x &&
                            off.y < cover.size.y)
                    << i << ": " << x << ' ' << y;
            }
        }
    }
    EXPECT_GT(empty, 20);
    EXPECT_GT(whole, 20);
    EXPECT_GT(met, 10000);
    const std::array none{glm::vec3{1.0F}, glm::vec3{0.0F}};
    EXPECT_EQ(scene::coverOf({}, size, volume, none), scene::PixelBox{});
}

}  // namespace
}  // namespace volcast
