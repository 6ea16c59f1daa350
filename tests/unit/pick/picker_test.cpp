#include "renderer/pick/picker.h"

#include <cmath>
#include <cstring>
#include <functional>

#include <gtest/gtest.h>

#include "renderer/data/volume_builder.h"
#include "tests/unit/reference/scenes.h"

namespace volcast::pick {
namespace {

using reference::test::along;
using reference::test::boxOf;
using reference::test::constant;
using reference::test::layerOf;
using reference::test::ramp;
using reference::test::sceneOf;
using scene::RayModel;

const glm::dvec3 kEye{0.31, 0.42, -2.0}, kCentre{0.31, 0.42, 0.0};  // Along z.

double alongZ(const glm::dvec3& p) {
    return p.z;
}

/// A unit cube of 8 x 8 x 8 cubes of cells.
data::Mesh cube(const support::PointFunction& f = alongZ) {
    return boxOf({.cubes = glm::ivec3{8}}, f);
}

/// A unit cube of 17^3 grid points whose channels are functions of the position in it.
data::Volume voxels(const std::vector<std::function<double(glm::dvec3)>>& channels) {
    data::VolumeInput input;
    input.size = glm::ivec3{17};
    input.spacing = glm::dvec3{1.0 / 16.0};
    for (std::size_t c = 0; c < channels.size(); ++c) {
        std::vector<float> values;
        for (int i = 0; i < 17 * 17 * 17; ++i) {
            const glm::dvec3 point{i % 17, i / 17 % 17, i / 289};
            values.push_back(static_cast<float>(channels[c](point / 16.0)));
        }
        data::ChannelInput channel{.name = "c" + std::to_string(c), .unit = "", .voxels = {}};
        channel.voxels.resize(values.size() * sizeof(float));
        std::memcpy(channel.voxels.data(), values.data(), channel.voxels.size());
        input.channels.push_back(std::move(channel));
    }
    auto volume = data::buildVolume(std::move(input));
    EXPECT_TRUE(volume.has_value()) << volume.error().message;
    return *std::move(volume);
}

class Pick : public testing::Test {
protected:
    void add(const std::string& id, data::Dataset dataset) { data_[id] = std::move(dataset); }

    Result<std::optional<scene::Picked>> pick(const scene::Scene& scene,
                                              scene::PictureSize size = {1, 1},
                                              glm::ivec2 pixel = {0, 0}) {
        return picker_.pick(scene, size, pixel, [this](const std::string& id) {
            const auto found = data_.find(id);
            return found == data_.end() ? nullptr : &found->second;
        });
    }
    /// What the ray along z shows of one layer.
    scene::Picked shown(const scene::Layer& layer, const glm::dvec3& eye = kEye) {
        const auto found = pick(sceneOf(along(eye, {eye.x, eye.y, 0.0}), {layer}));
        EXPECT_TRUE(found.has_value()) << found.error().message;
        if (!found || !*found) return {.layer = "nothing", .values = {}};
        return **found;
    }

    std::map<std::string, data::Dataset> data_;
    Picker picker_;
};

scene::Layer ofVoxels(RayModel model, data::TransferFunction map) {
    scene::Layer layer = layerOf(model, std::move(map));
    layer.field = "c0";
    layer.stepWorld = 0.0101;  // Divides no length of these.
    return layer;
}

TEST_F(Pick, ExtremesAreWhereTheyAre) {
    add("mesh", cube());
    const scene::Picked most = shown(layerOf(RayModel::kMip, ramp()));
    EXPECT_EQ(most.layer, "0");
    ASSERT_EQ(most.values.size(), 1U);
    EXPECT_EQ(most.values[0].field, "f");
    EXPECT_NEAR(most.values[0].value, 1.0, 1e-6);
    EXPECT_NEAR(glm::distance(most.position, {0.31, 0.42, 1.0}), 0.0, 1e-6);
    EXPECT_NEAR(most.distance, 3.0, 1e-6);
    EXPECT_NEAR(most.colour.g, 1.0, 1e-6);
    const scene::Picked least = shown(layerOf(RayModel::kMinip, ramp()));
    EXPECT_NEAR(least.values[0].value, 0.0, 1e-6);
    EXPECT_NEAR(least.position.z, 0.0, 1e-6);
}

TEST_F(Pick, TheCellIsTheOneThatHoldsThePlace) {
    add("mesh", cube());
    scene::Layer layer = layerOf(RayModel::kIsosurface, ramp());
    layer.levels.values = {0.37F};
    const scene::Picked hit = shown(layer);
    EXPECT_NEAR(hit.values[0].value, 0.37, 1e-6);
    EXPECT_NEAR(hit.position.z, 0.37, 1e-6);
    ASSERT_TRUE(hit.cell);
    const auto& mesh = std::get<data::Mesh>(data_["mesh"]);
    glm::dvec3 low{9.0}, high{-9.0};
    for (int i = 0; i < 4; ++i) {
        const glm::dvec3 corner = mesh.origin + glm::dvec3{mesh.vertices[mesh.cells[*hit.cell][i]]};
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    EXPECT_TRUE(glm::all(glm::lessThanEqual(low, hit.position)) &&
                glm::all(glm::lessThanEqual(hit.position, high)));
}

// With extinction s z behind z = 0, what is seen of it is s z exp(-s z^2 / 2): most at 1 / sqrt(s).
TEST_F(Pick, AVolumeShowsMostWhereExtinctionIsStillSeen) {
    add("mesh", cube());
    add("voxels", voxels({[](glm::dvec3 p) { return p.z; }}));
    for (const float s : {4.0F, 30.0F}) {
        const double expected = 1.0 / std::sqrt(s);
        EXPECT_NEAR(shown(layerOf(RayModel::kVolume, ramp(s))).position.z, expected, 1.0 / 64.0);
        scene::Layer layer = ofVoxels(RayModel::kVolume, ramp(s));
        layer.dataset = "voxels";
        const scene::Picked picked = shown(layer);
        EXPECT_NEAR(picked.position.z, expected, 0.0102);
        EXPECT_NEAR(picked.values[0].value, picked.position.z, 1e-6);
    }
}

TEST_F(Pick, VoxelsAreSampledAsTheyAreMarched) {
    add("mesh", voxels({[](glm::dvec3 p) { return p.x * p.y + p.z; }}));
    const scene::Picked most = shown(ofVoxels(RayModel::kMip, ramp()));
    // The last of 100 samples lies half a step before the back; the field is trilinear.
    EXPECT_NEAR(most.position.z, 1.0 - 0.5 / 100.0, 1e-9);
    EXPECT_NEAR(most.values[0].value, 0.31 * 0.42 + most.position.z, 1e-6);
    EXPECT_EQ(most.voxel, (glm::ivec3{5, 7, 16}));
    EXPECT_FALSE(most.cell);
    scene::Layer layer = ofVoxels(RayModel::kIsosurface, ramp());
    layer.levels.values = {0.9F, 0.5F};
    const scene::Picked hit = shown(layer);
    EXPECT_EQ(hit.values[0].value, 0.5);
    EXPECT_NEAR(hit.position.z, 0.5 - 0.31 * 0.42, 1e-6);
    layer = ofVoxels(RayModel::kMip, ramp());
    layer.sampling = scene::Sampling::kNearest;
    EXPECT_NEAR(shown(layer).values[0].value, 5.0 / 16.0 * 7.0 / 16.0 + 1.0, 1e-6);
    layer.sampling = scene::Sampling::kTricubic;
    // 0.92 of the last cell, beyond whose face the value stays: a sixteenth is missing there.
    const double bend = 0.5 * 0.08 * 0.92 * 0.92 / 16.0;
    EXPECT_NEAR(shown(layer).values[0].value, 0.31 * 0.42 + 0.995 + bend, 1e-6);
}

TEST_F(Pick, VoxelsWithoutAValueShowNothing) {
    const double nan = std::nan("");
    add("mesh", voxels({[=](glm::dvec3 p) { return p.z > 0.5 ? nan : p.z; },
                        [=](glm::dvec3 p) { return p.z < 0.3 ? 1.0 : nan; }}));
    scene::Layer layer = ofVoxels(RayModel::kMip, ramp());
    EXPECT_NEAR(shown(layer).values[0].value, 0.5, 0.0101);
    layer.model = RayModel::kIsosurface;
    layer.levels.values = {0.8F};
    EXPECT_EQ(shown(layer).layer, "nothing");
    layer.levels.values = {0.4F};
    EXPECT_NEAR(shown(layer).position.z, 0.4, 1e-6);
    layer.model = RayModel::kVolume;
    layer.channels = {{.field = "c0", .map = ramp(9.0F)}, {.field = "c1", .map = ramp(0.0F)}};
    EXPECT_EQ(shown(layer).values.size(), 1U) << "the other channel has no value there";
}

TEST_F(Pick, SamplesOverTheDepthFollowTheCamera) {
    add("mesh", voxels({alongZ}));
    scene::Layer layer = ofVoxels(RayModel::kMip, ramp());
    layer.stepWorld = 0.0;
    layer.depthSamples = 7;
    // Straight on the box is 1 deep; the last of 7 samples lies half a step before its back.
    EXPECT_NEAR(shown(layer).values[0].value, 1.0 - 0.5 / 7.0, 1e-6);
    // Over a corner it is sqrt(3) deep, the same as this ray through its middle.
    const auto found = pick(sceneOf(along(glm::dvec3{-3.0}, glm::dvec3{0.5}), {layer}));
    ASSERT_TRUE(found && *found);
    EXPECT_NEAR((*found)->values[0].value, 1.0 - 0.5 / 7.0, 1e-6);
}

TEST_F(Pick, IntervalsAndClipPlanesLeaveOutWhatIsNotShown) {
    add("mesh", cube());
    scene::Layer layer = layerOf(RayModel::kMip, ramp());
    layer.interval = data::Range{.min = 0.2F, .max = 0.6F};
    EXPECT_NEAR(shown(layer).values[0].value, 0.6, 1e-6);
    layer.interval.reset();
    scene::Scene scene = sceneOf(along(kEye, kCentre), {layer});
    scene.clipPlanes = {{.normal = {0.0, 0.0, -1.0}, .offset = -0.25}};
    const auto clipped = pick(scene);
    ASSERT_TRUE(clipped && *clipped);
    EXPECT_NEAR((*clipped)->values[0].value, 0.25, 1e-6);
}

TEST_F(Pick, ASurfaceWithoutColoursHasItsValueAllTheSame) {
    add("mesh", cube([](const glm::dvec3& p) { return p.x + 10.0 * p.y; }));
    scene::Layer layer = layerOf(RayModel::kSurface, ramp());
    layer.surfaceColour = {0.1F, 0.2F, 0.3F};
    const scene::Picked hit = shown(layer);
    EXPECT_NEAR(hit.position.z, 0.0, 1e-9);
    ASSERT_EQ(hit.values.size(), 1U);
    EXPECT_NEAR(hit.values[0].value, 0.31 + 4.2, 1e-5);
    EXPECT_EQ(hit.colour, glm::vec3(0.1F, 0.2F, 0.3F));
}

TEST_F(Pick, ValuesAreInTheFieldsUnitWhateverTheScale) {
    add("mesh", cube([](const glm::dvec3& p) { return std::exp(3.0 * p.z); }));
    scene::Layer layer = layerOf(RayModel::kMip, ramp());
    layer.map.points[0].value = 1.0F;
    layer.map.points[1].value = 20.0F;
    layer.scale.kind = scene::Scale::Kind::kLog;
    EXPECT_NEAR(shown(layer).values[0].value, std::exp(3.0), 1e-4);
    layer.scale.kind = scene::Scale::Kind::kPower;
    layer.scale.exponent = 0.5F;
    EXPECT_NEAR(shown(layer).values[0].value, std::exp(3.0), 1e-4);
    layer.model = RayModel::kMinip;
    EXPECT_NEAR(shown(layer).values[0].value, 1.0, 1e-4);
}

TEST_F(Pick, TheLayerThatIsSeenMostAnswers) {
    add("mesh", cube());
    const scene::Layer surface = layerOf(RayModel::kSurface, ramp());
    scene::Layer level = layerOf(RayModel::kIsosurface, ramp());
    level.levels.values = {0.5F};
    const auto layerPicked = [&](const std::vector<scene::Layer>& layers) {
        const auto found = pick(sceneOf(along(kEye, kCentre), layers));
        return found && *found ? (*found)->layer : "nothing";
    };
    EXPECT_EQ(layerPicked({level, surface}), "1") << "the surface is in front";
    EXPECT_EQ(layerPicked({level, layerOf(RayModel::kVolume, constant({1, 1, 1}, 0.2F))}), "0")
        << "thin matter in front of the level";
    EXPECT_EQ(layerPicked({level, layerOf(RayModel::kVolume, constant({1, 1, 1}, 20.0F))}), "1");
    EXPECT_EQ(layerPicked({layerOf(RayModel::kVolume, constant({1, 1, 1}, 0.0F))}), "nothing");
    scene::Layer hidden = surface;
    hidden.visible = false;
    EXPECT_EQ(layerPicked({level, hidden}), "0");
    EXPECT_EQ(layerPicked({surface, surface}), "0") << "the first of two at the same depth";
}

TEST_F(Pick, OfSeveralChannelsTheBrightestWins) {
    add("mesh", voxels({[](glm::dvec3 p) { return p.z; }, [](glm::dvec3 p) { return 1.0 - p.z; }}));
    scene::Layer layer = ofVoxels(RayModel::kMip, ramp());
    layer.channels = {
        {.field = "c0", .map = {{{.value = 0.0F}, {.value = 1.0F, .colour = {0.3F, 0, 0}}}}},
        {.field = "c1", .map = {{{.value = 0.0F}, {.value = 1.0F, .colour = {0, 0, 0.9F}}}}}};
    const scene::Picked picked = shown(layer);
    ASSERT_EQ(picked.values.size(), 2U);
    EXPECT_EQ(picked.values[0].field, "c1");
    EXPECT_NEAR(picked.values[0].value, 0.995, 1e-6);
    EXPECT_NEAR(picked.values[1].value, 0.005, 1e-6);
    layer.channels[1].visible = false;
    EXPECT_EQ(shown(layer).values[0].field, "c0");
}

TEST_F(Pick, BesideTheDataThereIsNothing) {
    add("mesh", cube());
    add("voxels", voxels({alongZ}));
    for (const char* dataset : {"mesh", "voxels"}) {
        for (const RayModel model : {RayModel::kMip, RayModel::kVolume, RayModel::kIsosurface}) {
            scene::Layer layer = layerOf(model, ramp(5.0F));
            layer.dataset = dataset;
            layer.field = "";
            layer.levels.values = {0.5F};
            EXPECT_EQ(shown(layer, {1.5, 0.5, -2.0}).layer, "nothing") << dataset;
        }
    }
}

TEST_F(Pick, PixelsAreCountedFromTheUpperLeft) {
    add("mesh", cube([](const glm::dvec3& p) { return p.x; }));
    scene::Scene scene =
        sceneOf(along({0.5, 0.5, -2.0}, {0.5, 0.5, 0.0}), {layerOf(RayModel::kIsosurface, ramp())});
    scene.layers[0].model = RayModel::kSurface;
    scene.camera.orthographicHeight = 1.0;
    // The camera looks along +z with y up: -x is to its right.
    const auto found = pick(scene, {10, 10}, {2, 1});
    ASSERT_TRUE(found && *found);
    EXPECT_NEAR((*found)->position.x, 0.75, 1e-9);
    EXPECT_NEAR((*found)->position.y, 0.85, 1e-9);
}

TEST_F(Pick, WhatCannotBePickedIsRefused) {
    add("mesh", cube());
    const scene::Scene scene = sceneOf(along(kEye, kCentre), {layerOf(RayModel::kMip, ramp())});
    EXPECT_EQ(pick(scene, {4, 4}, {4, 0}).error().field, "pixel");
    EXPECT_EQ(pick(scene, {4, 4}, {0, -1}).error().field, "pixel");
    EXPECT_EQ(pick(scene, {0, 4}).error().code, ErrorCode::kInvalidArgument);
    scene::Scene other = scene;
    other.layers[0].dataset = "gone";
    EXPECT_EQ(pick(other).error().code, ErrorCode::kNotFound);
}

TEST_F(Pick, ADatasetThatWasReplacedIsLookedAtAnew) {
    add("mesh", cube());
    EXPECT_NEAR(shown(layerOf(RayModel::kMip, ramp())).values[0].value, 1.0, 1e-6);
    picker_.forget("mesh");
    add("mesh", cube([](const glm::dvec3& p) { return 5.0 * p.z; }));
    EXPECT_NEAR(shown(layerOf(RayModel::kMip, ramp())).values[0].value, 5.0, 1e-6);
}

}  // namespace
}  // namespace volcast::pick
