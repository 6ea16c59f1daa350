// Volumes drawn from bricks of their pyramids, against the same volumes as a whole on the GPU.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "renderer/plan/effects.h"
#include "renderer/volume/brick_pool.h"
#include "tests/support/phantoms.h"
#include "tests/support/render_test.h"

namespace volcast {
namespace {

using data::VoxelType;
using scene::RayModel;
using scene::Sampling;

// Neither is a multiple of a brick: levels end with shorter intervals.
const support::GridPlace kPlace{.size = {150, 121, 117},
                                .spacing = {0.4, 0.7, 0.5},
                                .origin = {-3.0, 900.0, 5.0},
                                .direction = support::turn({2, -1, 1}, 63.0)};
constexpr int kAllBricks = 5 * 4 * 4 + 3 * 2 * 2 + 2 + 1;
const scene::PictureSize kSize{72, 56};

template <class T>
data::Volume volumeAs(VoxelType type, const std::function<double(const glm::dvec3&)>& value) {
    data::VolumeInput input;
    input.size = kPlace.size;
    input.spacing = kPlace.spacing;
    input.origin = kPlace.origin;
    input.direction = kPlace.direction;
    input.type = type;
    std::vector<std::byte> voxels(static_cast<std::size_t>(kPlace.size.x) * kPlace.size.y *
                                  kPlace.size.z * sizeof(T));
    std::size_t i = 0;
    for (int z = 0; z < kPlace.size.z; ++z) {
        for (int y = 0; y < kPlace.size.y; ++y) {
            for (int x = 0; x < kPlace.size.x; ++x, i += sizeof(T)) {
                const auto voxel = static_cast<T>(value(glm::dvec3(x, y, z)));
                std::memcpy(&voxels[i], &voxel, sizeof(T));
            }
        }
    }
    input.channels.push_back({.name = "f", .voxels = std::move(voxels)});
    return support::must(data::buildVolume(std::move(input)));
}

/// Two blobs and a texture of a few voxels; 0 to about 200.
double blobs(const glm::dvec3& p) {
    const auto blob = [&](const glm::dvec3& c, double r) {
        const glm::dvec3 d = (p - c) / r;
        return std::exp(-glm::dot(d, d));
    };
    const double texture = std::sin(1.3 * p.x) * std::sin(0.9 * p.y) * std::cos(1.1 * p.z);
    return std::round((90.0 + 20.0 * texture) * blob({38, 30, 40}, 22.0) +
                      (110.0 + 40.0 * texture) * blob({110, 80, 70}, 30.0));
}

double linear(const glm::dvec3& p) {
    return 2.0 * p.x - 1.5 * p.y + 0.5 * p.z + 20.0;
}

data::TransferFunction map(float from, float to) {
    const auto at = [&](float share) { return from + share * (to - from); };
    return {{{.value = at(0.2F), .colour = {0.1F, 0.1F, 0.9F}, .extinction = 0.0F},
             {.value = at(0.4F), .colour = {0.2F, 0.9F, 0.1F}, .extinction = 0.06F},
             {.value = at(0.7F), .colour = {0.9F, 0.8F, 0.1F}, .extinction = 0.02F},
             {.value = at(1.0F), .colour = {1.0F, 0.1F, 0.1F}, .extinction = 0.3F}}};
}

class Bricks : public support::RenderTest {
protected:
    Bricks() {
        scene::Layer layer;
        layer.id = "layer";
        layer.dataset = "volume";
        layer.map = map(0.0F, 200.0F);
        scene_.layers.push_back(layer);
        center_ =
            kPlace.origin + kPlace.direction * (0.5 * kPlace.spacing * glm::dvec3(kPlace.size - 1));
        // A pixel is 0.1 wide and a voxel at least 0.4: level 0 everywhere.
        scene_.camera = {.eye = center_ + glm::dvec3(60, 40, 70), .center = center_};
        scene_.camera.projection = scene::Projection::kOrthographic;
        scene_.camera.orthographicHeight = 0.1 * kSize.y;
    }

    void showAll() { scene_.camera.orthographicHeight = 120.0; }

    /// With a pool of `bricks`, or of the least that there is.
    static std::unique_ptr<scene::Renderer> bricked(const data::Volume& volume, int bricks,
                                                    int bricksAPicture = 1000) {
        const std::size_t each = volume::BrickPool::brickBytes(volume.type);
        auto renderer = support::must(scene::Renderer::create(
            device(), shading::embeddedChunks(),
            {.volumeBytes = each * static_cast<std::size_t>(bricks),
             .pictureBytes = each * static_cast<std::size_t>(bricksAPicture)}));
        renderer->addDataset("volume", volume);
        return renderer;
    }

    /// Draws until it is ready.
    support::Drawn complete(scene::Renderer& renderer) {
        for (int i = 0; i < 200; ++i) {
            support::Drawn drawn = support::must(tryDraw(renderer, scene_, kSize));
            if (drawn.info.ready) return drawn;
        }
        ADD_FAILURE() << "never ready";
        return {};
    }

    static double largestDifference(const support::Drawn& a, const support::Drawn& b) {
        double worst = 0.0;
        for (std::size_t i = 0; i < a.linear.size(); ++i) {
            worst = std::max(worst, static_cast<double>(std::abs(a.linear[i] - b.linear[i])));
        }
        return worst;
    }

    /// Of all colours and opacities.
    static float largest(const support::Drawn& drawn) {
        return *std::ranges::max_element(drawn.linear);
    }

    scene::Scene scene_;
    glm::dvec3 center_{0.0};
};

// Trilinear values of the texture unit and of the shader differ by 4e-6 of the voxels' (that is
// what filtersExactly() allows), 200 at most: by 8e-4. The map's steepest piece changes extinction
// by 0.28 / 60 a unit, rays are at most 120 long and colours at most 1: 120 * 0.0047 * 8e-4
// = 4.5e-4.
constexpr double kFiltering = 4.5e-4;

TEST_F(Bricks, EveryVoxelTypeIsDrawnAsIfItWereThereAsAWhole) {
    const std::vector<data::Volume> volumes{
        volumeAs<std::uint8_t>(VoxelType::kU8, blobs),
        volumeAs<std::uint16_t>(VoxelType::kU16, blobs),
        volumeAs<std::int16_t>(VoxelType::kI16,
                               [](const glm::dvec3& p) { return blobs(p) - 100.0; }),
        volumeAs<float>(VoxelType::kF32, blobs)};
    for (const data::Volume& volume : volumes) {
        const bool isSigned = volume.type == VoxelType::kI16;
        scene_.layers[0].map = isSigned ? map(-100.0F, 100.0F) : map(0.0F, 200.0F);
        renderer_->addDataset("volume", volume);
        const auto renderer = bricked(volume, 1);
        for (const Sampling sampling :
             {Sampling::kNearest, Sampling::kTrilinear, Sampling::kTricubic}) {
            scene_.layers[0].sampling = sampling;
            const support::Drawn whole = draw(scene_, kSize);
            const support::Drawn parts = complete(*renderer);
            ASSERT_EQ(whole.info.bricks.size(), 0U);
            ASSERT_EQ(parts.info.bricks.size(), 1U);
            EXPECT_EQ(parts.info.bricks[0].report.coarsest, 0);
            EXPECT_GT(largest(whole), 0.3F);
            // Without the texture unit the same numbers are added in the same order.
            const double allowed = sampling == Sampling::kTrilinear ? kFiltering : 2e-6;
            EXPECT_LE(largestDifference(whole, parts), allowed)
                << static_cast<int>(volume.type) << " " << static_cast<int>(sampling);
        }
    }
}

TEST_F(Bricks, EveryModelIsDrawnAsIfItWereThereAsAWhole) {
    const data::Volume volume = volumeAs<std::uint8_t>(VoxelType::kU8, blobs);
    renderer_->addDataset("volume", volume);
    const auto renderer = bricked(volume, 1);
    scene::Layer& layer = scene_.layers[0];
    layer.levels.values = {40.0F, 90.0F};
    struct Row {
        RayModel model;
        Sampling sampling = Sampling::kNearest;  // Or tricubic: without the texture unit.
        bool interval = false, lit = false;
    };
    for (const Row& row :
         {Row{RayModel::kMip}, Row{RayModel::kMinip}, Row{RayModel::kMipColour},
          Row{RayModel::kXray}, Row{RayModel::kSplat}, Row{RayModel::kCrossSections},
          Row{RayModel::kMip, Sampling::kNearest, true},
          Row{RayModel::kVolume, Sampling::kNearest, true},
          Row{RayModel::kVolume, Sampling::kTricubic, false, true},
          Row{RayModel::kIsosurface, Sampling::kTricubic}}) {
        layer.model = row.model;
        layer.sampling = row.sampling;
        layer.light = row.lit ? std::optional{scene::Light{}} : std::nullopt;
        layer.interval = row.interval ? std::optional{data::Range{30.0F, 120.0F}} : std::nullopt;
        const support::Drawn whole = draw(scene_, kSize);
        const support::Drawn parts = complete(*renderer);
        ASSERT_EQ(parts.info.bricks.size(), 1U);
        EXPECT_LE(largestDifference(whole, parts), 2e-6) << static_cast<int>(row.model);
        EXPECT_GT(largest(whole), 0.0F) << static_cast<int>(row.model);
    }
}

// All levels of a linear field are the same field: whatever level is drawn, and wherever two of
// them meet, the picture is that of level 0.
TEST_F(Bricks, LevelsAreNotShifted) {
    const data::Volume volume = volumeAs<float>(VoxelType::kF32, linear);
    renderer_->addDataset("volume", volume);
    const auto renderer = bricked(volume, 1);
    scene_.layers[0].map = map(-160.0F, 380.0F);
    // Coarse voxels have longer steps: 0.08 on level 2. A sample in the middle of one is off by the
    // square of it, of which the linear pieces of the map leave only what lies at their ends.
    scene_.layers[0].stepWorld = 0.02;
    showAll();
    for (const Sampling sampling : {Sampling::kTrilinear, Sampling::kTricubic}) {
        scene_.layers[0].sampling = sampling;
        const support::Drawn whole = draw(scene_, kSize);
        const support::Drawn parts = complete(*renderer);
        const volume::BrickReport& report = parts.info.bricks.at(0).report;
        EXPECT_EQ(report.finest, 2) << "a pixel is 2.1 wide, voxels of level 1 are 1.4 long";
        EXPECT_EQ(report.coarsest, 2);
        if (sampling == Sampling::kTrilinear) {
            EXPECT_LE(largestDifference(whole, parts), kFiltering);
        }
        // A cubic through repeated faces is not linear there, and farther in the coarser it is.
        EXPECT_GT(largest(parts), 0.3F);
    }
    scene_.camera.projection = scene::Projection::kPerspective;
    scene_.camera.eye = center_ + kPlace.direction * glm::dvec3(0.0, 0.0, 45.0);
    scene_.camera.fovyDegrees = 70.0;
    scene_.layers[0].sampling = Sampling::kTrilinear;
    const support::Drawn whole = draw(scene_, kSize);
    const support::Drawn parts = complete(*renderer);
    const volume::BrickReport& report = parts.info.bricks.at(0).report;
    EXPECT_LT(report.finest, report.coarsest);
    EXPECT_LE(largestDifference(whole, parts), kFiltering);
}

// A linear field on level 2, whose samples lie 4 times as far from each other as on level 0: the
// shorter the step, the closer to what ever more samples of level 0 show.
TEST_F(Bricks, CoarseLevelsTakeLongerStepsAndConverge) {
    const data::Volume volume = volumeAs<float>(VoxelType::kF32, linear);
    renderer_->addDataset("volume", volume);
    const auto renderer = bricked(volume, 1);
    scene_.layers[0].map = map(-160.0F, 380.0F);
    showAll();
    for (const scene::Integrator integrator :
         {scene::Integrator::kAverage, scene::Integrator::kPreintegrated}) {
        scene_.layers[0].integrator = integrator;
        scene_.layers[0].stepWorld = 0.01;
        const support::Drawn best = draw(scene_, kSize);
        std::vector<double> off;
        for (const double step : {0.2, 0.1, 0.05}) {
            scene_.layers[0].stepWorld = step;
            const support::Drawn parts = complete(*renderer);
            EXPECT_EQ(parts.info.bricks.at(0).report.finest, 2);
            off.push_back(largestDifference(best, parts));
        }
        EXPECT_LT(off[1], off[0]) << scene::name(integrator);
        EXPECT_LT(off[2], off[1]) << scene::name(integrator);
        EXPECT_LT(off[2], 2e-3) << scene::name(integrator);
        RecordProperty(
            std::string{scene::name(integrator)},
            std::to_string(off[0]) + ' ' + std::to_string(off[1]) + ' ' + std::to_string(off[2]));
    }
}

// Voxels without a value: whole bricks of them, parts of bricks, single ones.
TEST_F(Bricks, WhatHasNoValueIsDrawnAsIfItWereThereAsAWhole) {
    const auto holed = [](const glm::dvec3& p) {
        const bool none = p.x > 61.0 || glm::length(p - glm::dvec3(38, 30, 40)) < 9.0 ||
                          p == glm::dvec3(20, 33, 41);
        return none ? std::nan("") : blobs(p);
    };
    const data::Volume volume = volumeAs<float>(VoxelType::kF32, holed);
    renderer_->addDataset("volume", volume);
    const auto renderer = bricked(volume, 1);
    scene_.layers[0].levels.values = {40.0F, 60.0F};
    // Within the part that has values.
    scene_.camera.center =
        kPlace.origin + kPlace.direction * (kPlace.spacing * glm::dvec3(38, 30, 40));
    scene_.camera.eye = scene_.camera.center + glm::dvec3(60, 40, 70);
    for (const RayModel model : {RayModel::kVolume, RayModel::kMip, RayModel::kMinip,
                                 RayModel::kIsosurface, RayModel::kCrossSections}) {
        for (const Sampling sampling :
             {Sampling::kNearest, Sampling::kTrilinear, Sampling::kTricubic}) {
            scene_.layers[0].model = model;
            scene_.layers[0].sampling = sampling;
            scene_.layers[0].crossSections.point = scene_.camera.center;
            const support::Drawn whole = draw(scene_, kSize);
            const support::Drawn parts = complete(*renderer);
            ASSERT_EQ(parts.info.bricks.size(), 1U);
            EXPECT_GT(parts.info.bricks[0].report.hidden, 0U);
            EXPECT_GT(largest(whole), 0.1F);
            for (const float value : parts.linear) ASSERT_TRUE(std::isfinite(value));
            const bool filtered = sampling == Sampling::kTrilinear;
            if (model == RayModel::kIsosurface && filtered)
                continue;  // A crossing moves with rounding.
            EXPECT_LE(largestDifference(whole, parts), filtered ? kFiltering : 2e-6)
                << scene::name(model) << ' ' << scene::name(sampling);
        }
    }
}

// Of two types there are two pools, which share the budget; of two layers each has its part of one.
TEST_F(Bricks, LayersShareTheBudget) {
    const data::Volume bytes = volumeAs<std::uint8_t>(VoxelType::kU8, blobs);
    const data::Volume floats = volumeAs<float>(VoxelType::kF32, linear);
    const std::size_t budget = 80 * volume::BrickPool::brickBytes(VoxelType::kF32);
    auto renderer = support::must(
        scene::Renderer::create(device(), shading::embeddedChunks(), {.volumeBytes = budget}));
    for (scene::Renderer* each : {renderer.get(), renderer_.get()}) {
        each->addDataset("volume", bytes);
        each->addDataset("other", floats);
    }
    scene_.layers[0].sampling = Sampling::kNearest;
    scene_.camera.orthographicHeight = 20.0;  // 0.36 a pixel: most bricks of level 0.
    scene_.layers.push_back(scene_.layers[0]);
    scene_.layers[1].id = "other";
    scene_.layers[1].dataset = "other";
    scene_.layers[1].map = map(-160.0F, 380.0F);
    scene_.layers.push_back(scene_.layers[1]);
    scene_.layers[2].id = "third";
    scene_.layers[2].model = RayModel::kXray;
    // What all take together decides: 2 channels of 8.5 MiB, although each alone has room.
    const std::uint64_t voxels = std::uint64_t{150} * 121 * 117 * 4;
    ASSERT_LT(voxels, budget);
    ASSERT_GT(2 * voxels, budget);
    const support::Drawn whole = draw(scene_, kSize);
    const support::Drawn parts = complete(*renderer);
    ASSERT_EQ(parts.info.bricks.size(), 3U);
    for (const auto& layer : parts.info.bricks) {
        EXPECT_TRUE(layer.report.ready());
        // Half of it for 160 bricks of bytes; 64, the least of a pool, for two layers of floats.
        const bool alone = layer.layer == "layer";
        EXPECT_LE(layer.report.needed, alone ? 160U : 32U) << layer.layer;
        EXPECT_EQ(layer.report.limited, !alone) << layer.layer;
    }
    EXPECT_GT(largest(whole), 0.3F);
    // Alone the first has room as a whole.
    scene_.layers.resize(1);
    const support::Drawn one = complete(*renderer);
    EXPECT_FALSE(one.info.plan.layers[0].has(plan::kBricks));
    EXPECT_LE(largestDifference(draw(scene_, kSize), one), 2e-6);
}

// Where a brick was left out its coarser one stands in: what is not shown must stay so.
TEST_F(Bricks, WhatCannotShowIsNotLoadedAndNotMissed) {
    const data::Volume volume = volumeAs<std::uint8_t>(VoxelType::kU8, blobs);
    renderer_->addDataset("volume", volume);
    const auto renderer = bricked(volume, 100);
    scene_.layers[0].sampling = Sampling::kTricubic;
    scene_.layers[0].map = map(50.0F, 150.0F);
    scene_.layers[0].levels.values = {100.0F};
    scene_.camera.orthographicHeight = 20.0;  // 0.36 a pixel
    for (const RayModel model : {RayModel::kVolume, RayModel::kIsosurface}) {
        scene_.layers[0].model = model;
        const support::Drawn whole = draw(scene_, kSize);
        const support::Drawn parts = complete(*renderer);
        const volume::BrickReport& report = parts.info.bricks.at(0).report;
        EXPECT_EQ(report.coarsest, 0);
        EXPECT_GT(report.hidden, 0U);
        EXPECT_LT(report.needed + report.outside, static_cast<std::size_t>(kAllBricks));
        EXPECT_LE(largestDifference(whole, parts), 2e-6) << static_cast<int>(model);
        EXPECT_GT(largest(whole), 0.3F);
    }
}

TEST_F(Bricks, PicturesGetBetterUntilTheyAreReady) {
    const data::Volume volume = volumeAs<std::uint8_t>(VoxelType::kU8, blobs);
    showAll();
    scene_.camera.orthographicHeight = 20.0;
    scene_.layers[0].map = map(-100.0F, 200.0F);  // Everything shows.
    const support::Drawn best = complete(*bricked(volume, 100));
    const auto renderer = bricked(volume, 100, 10);
    double before = 1e9;
    std::size_t resident = 0;
    int pictures = 0;
    for (bool ready = false; !ready; ++pictures) {
        ASSERT_LT(pictures, 20);
        const support::Drawn drawn = support::must(tryDraw(*renderer, scene_, kSize));
        const volume::BrickReport& report = drawn.info.bricks.at(0).report;
        EXPECT_TRUE(drawn.info.drawn);
        EXPECT_LE(report.loadedBytes, 10 * volume::BrickPool::brickBytes(volume.type));
        EXPECT_GT(report.resident, resident);
        resident = report.resident;
        ready = drawn.info.ready;
        EXPECT_EQ(ready, report.resident == report.needed);
        double sum = 0.0;
        for (std::size_t i = 0; i < drawn.linear.size(); ++i) {
            sum += std::abs(drawn.linear[i] - best.linear[i]);
        }
        EXPECT_LE(sum, before + 1e-3);
        before = sum;
    }
    EXPECT_GT(pictures, 2);
    EXPECT_EQ(before, 0.0);
    const support::Drawn again = support::must(tryDraw(*renderer, scene_, kSize));
    EXPECT_FALSE(again.info.drawn) << "a ready picture is not drawn again";
    EXPECT_TRUE(again.info.ready);
    EXPECT_EQ(again.info.bricks.at(0).report.resident, resident);
}

TEST_F(Bricks, WithoutRoomThePictureIsCoarserAndSaysSo) {
    const data::Volume volume = volumeAs<float>(VoxelType::kF32, linear);
    renderer_->addDataset("volume", volume);
    const auto renderer = bricked(volume, 1);  // The least that a pool holds.
    scene_.layers[0].map = map(-160.0F, 380.0F);
    showAll();
    scene_.camera.orthographicHeight = 35.0;
    scene_.layers[0].sampling = Sampling::kTrilinear;
    const support::Drawn parts = complete(*renderer);
    const volume::BrickReport& report = parts.info.bricks.at(0).report;
    EXPECT_TRUE(report.limited);
    EXPECT_LE(report.needed, volume::BrickPool::kLeastBricks);
    EXPECT_EQ(report.finest, 0);
    EXPECT_EQ(report.coarsest, 1);
    EXPECT_LE(largestDifference(draw(scene_, kSize), parts), kFiltering);
    const auto& effects = parts.info.plan.layers[0].effects;
    const auto effect = std::ranges::find(effects, plan::kBricks, &plan::Effect::name);
    ASSERT_NE(effect, effects.end());
    EXPECT_TRUE(effect->on);
    EXPECT_NE(effect->reason.find("level 0 to 1, no finer because there is no room"),
              std::string::npos)
        << effect->reason;
}

// Each wants most of the pool.
TEST_F(Bricks, TwoViewsTakeTurnsAndBothGetReady) {
    const data::Volume volume = volumeAs<std::uint8_t>(VoxelType::kU8, blobs);
    const auto renderer = bricked(volume, 80, 7);
    scene_.layers[0].map = map(-100.0F, 200.0F);
    showAll();
    scene_.camera.orthographicHeight = 20.0;
    scene::Scene other = scene_;
    other.camera.eye = center_ - glm::dvec3(60, 40, -70);
    bool first = false, second = false;
    int pictures = 0;
    for (; pictures < 60 && !(first && second); ++pictures) {
        if (!first) first = support::must(tryDraw(*renderer, scene_, kSize, 1)).info.ready;
        if (!second) second = support::must(tryDraw(*renderer, other, kSize, 2)).info.ready;
    }
    EXPECT_TRUE(first && second);
}

TEST_F(Bricks, AViewThatIsGoneDoesNotKeepItsTurn) {
    const data::Volume volume = volumeAs<std::uint8_t>(VoxelType::kU8, blobs);
    const auto renderer = bricked(volume, 100, 2);
    scene_.layers[0].map = map(-100.0F, 200.0F);
    EXPECT_FALSE(support::must(tryDraw(*renderer, scene_, kSize, 1)).info.ready);
    const auto loaded = [&] {
        return support::must(tryDraw(*renderer, scene_, kSize, 2))
            .info.bricks.at(0)
            .report.loadedBytes;
    };
    EXPECT_EQ(loaded(), 0U) << "it is not its turn";
    renderer->dropView(1);
    EXPECT_GT(loaded(), 0U);
}

TEST_F(Bricks, AllIsLoadedAtOnceWhereThatIsAskedFor) {
    const data::Volume volume = volumeAs<std::uint8_t>(VoxelType::kU8, blobs);
    const auto renderer = bricked(volume, 100, 2);
    const auto info = support::must(renderer->render(1, scene_, kSize, {.complete = true}));
    EXPECT_TRUE(info.ready);
}

TEST_F(Bricks, VolumesThatFitAreNotCut) {
    const data::Volume volume = volumeAs<std::uint8_t>(VoxelType::kU8, blobs);
    renderer_->addDataset("volume", volume);
    const support::Drawn whole = draw(scene_, kSize);
    EXPECT_FALSE(whole.info.plan.layers[0].has(plan::kBricks));
    EXPECT_TRUE(whole.info.ready);
}

}  // namespace
}  // namespace volcast
