// What a plan leaves out costs nothing: not uploaded, not drawn, not compiled in.
#include <algorithm>

#include "renderer/mesh/walk.h"
#include "renderer/plan/effects.h"
#include "tests/support/layer_constants.h"
#include "tests/support/mesh_scenes.h"

namespace volcast {
namespace {

using scene::Integrator;
using scene::RayModel;

constexpr scene::PictureSize kSize{24, 16};

class EffectsCost : public support::MeshTest {
protected:
    EffectsCost() {
        auto input = support::latticeMesh({.cubes = {2, 2, 2}});
        for (const char* name : {"f", "g"}) {
            support::addField(input, name, data::Association::kVertex,
                              [](const glm::dvec3& p) { return p.x + 0.5 * p.y; });
        }
        support::addField(input, "mark", data::Association::kCell,
                          [](const glm::dvec3& p) { return p.x > 0.5 ? 1.0 : 0.0; });
        use(std::move(input));
    }

    /// The work of the first picture of a scene on a renderer that has drawn nothing.
    scene::Counters workOf(const std::function<void(scene::Layer&)>& edit) {
        renderer_ = support::must(scene::Renderer::create(device(), shading::embeddedChunks()));
        renderer_->addDataset("mesh", mesh_);
        auto scene = sceneOf(support::perspective({2, 3, 4}, glm::dvec3{0.5}), RayModel::kVolume,
                             support::ruler(0, 2), "f");
        edit(scene.layers[0]);
        return draw(scene, kSize).info.work;
    }
};

TEST_F(EffectsCost, ASurfaceInOneColourUploadsNoField) {
    const auto plain = workOf([](auto& layer) { layer.model = RayModel::kSurface; });
    const auto coloured = workOf([](auto& layer) {
        layer.model = RayModel::kSurface;
        layer.coloured = true;
    });
    // The field and the map.
    EXPECT_EQ(coloured.bufferUploads, plain.bufferUploads + 2);
    EXPECT_EQ(coloured.drawCalls, plain.drawCalls);
}

TEST_F(EffectsCost, ASecondFieldIsOneBufferAndNoDraw) {
    const auto one = workOf([](auto&) {});
    const auto two = workOf([](auto& layer) { layer.densityField = "g"; });
    EXPECT_EQ(two.bufferUploads, one.bufferUploads + 1);
    EXPECT_EQ(two.drawCalls, one.drawCalls);
    EXPECT_EQ(two.programsBuilt, one.programsBuilt);
}

TEST_F(EffectsCost, TablesGoUpOnlyForTheIntegratorsThatReadThem) {
    const auto with = [this](Integrator integrator) {
        return workOf([integrator](auto& layer) { layer.integrator = integrator; });
    };
    const auto exact = with(Integrator::kExact);
    const auto table = with(Integrator::kPsiTable);
    EXPECT_EQ(table.bufferUploads, exact.bufferUploads + 1);
    EXPECT_EQ(table.uploadedBytes, exact.uploadedBytes + 256U * 256U * 4U);
    const auto preintegrated = with(Integrator::kPreintegrated);
    EXPECT_EQ(preintegrated.bufferUploads, exact.bufferUploads);
    EXPECT_EQ(preintegrated.uploadedBytes, exact.uploadedBytes + 256U * 256U * 16U);
    EXPECT_EQ(with(Integrator::kAverage).uploadedBytes, exact.uploadedBytes);
}

TEST_F(EffectsCost, OnlyTheModelThatAsksHasTheTableOfLargestColours) {
    const auto mip = workOf([](auto& layer) { layer.model = RayModel::kMip; });
    const auto colour = workOf([](auto& layer) { layer.model = RayModel::kMipColour; });
    EXPECT_GT(colour.uploadedBytes, mip.uploadedBytes);
    const auto ends = workOf([](auto& layer) {
        layer.model = RayModel::kMipColour;
        layer.integrator = Integrator::kEnds;
    });
    EXPECT_EQ(ends.uploadedBytes, mip.uploadedBytes);
}

TEST_F(EffectsCost, CellsThatAreLeftOutAreNotUploaded) {
    const auto all = workOf([](auto&) {});
    const auto half =
        workOf([](auto& layer) { layer.markers = {.field = "mark", .values = {1.0F}}; });
    EXPECT_LT(half.uploadedBytes, all.uploadedBytes);
    EXPECT_EQ(half.drawCalls, all.drawCalls);
}

TEST_F(EffectsCost, WhatIsOffIsFalseInTheProgram) {
    const auto isOn = [](const mesh::WalkTraits& traits, const std::string& name) {
        const auto recipe = mesh::walkRecipe(traits, support::layerConstants(0));
        const auto found = std::ranges::find(recipe.constants, name, &shading::Constant::name);
        EXPECT_NE(found, recipe.constants.end()) << name;
        return std::get<bool>(found->value);
    };
    for (const char* name :
         {"kInterval", "kLit", "kClipsAtStart", "kCounts", "kResumes", "kListed", "kCountsSteps"}) {
        EXPECT_FALSE(isOn({}, name)) << name;
    }
    EXPECT_TRUE(isOn({.interval = true}, "kInterval"));
    EXPECT_TRUE(isOn({.convex = false}, "kListed"));
    EXPECT_TRUE(isOn({}, "kSplits"));
    EXPECT_FALSE(isOn({.integrator = Integrator::kAverage}, "kSplits"));
    EXPECT_EQ(mesh::walkRecipe({.oneColour = true}, {}).model, "model/opacity.glsl");
}

}  // namespace
}  // namespace volcast
