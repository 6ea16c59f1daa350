#include "renderer/scene/scene_diff.h"

#include "gtest/gtest.h"

namespace volcast::scene {
namespace {

Scene twoLayers() {
    Scene scene;
    for (const char* id : {"a", "b"}) {
        Layer layer;
        layer.id = id;
        layer.dataset = "data";
        layer.field = "f";
        layer.map.points = {{.value = 0.0F}, {.value = 1.0F, .extinction = 2.0F}};
        scene.layers.push_back(layer);
    }
    return scene;
}

TEST(SceneDiff, OfASceneAndItselfIsEmpty) {
    EXPECT_TRUE(diff(twoLayers(), twoLayers()).empty());
    EXPECT_TRUE(diff({}, {}).empty());
}

TEST(SceneDiff, ACameraMoveIsNothingElse) {
    Scene after = twoLayers();
    after.camera.eye.x += 1e-9;
    const SceneDiff changes = diff(twoLayers(), after);
    EXPECT_TRUE(changes.camera);
    EXPECT_FALSE(changes.background || changes.order);
    EXPECT_TRUE(changes.layers.empty());
}

TEST(SceneDiff, ALightIsAnotherProgramAndItsNumbersAreUniforms) {
    Scene lit = twoLayers();
    lit.layers[1].light = Light{};
    EXPECT_TRUE(diff(twoLayers(), lit).layers.at(0).program);
    Scene brighter = lit;
    brighter.layers[1].light->diffuse = 2.0F;
    EXPECT_TRUE(diff(lit, brighter).layers.at(0).uniforms);
    EXPECT_FALSE(diff(lit, brighter).layers.at(0).program);
}

TEST(SceneDiff, EachChangeOfALayerHasItsFlagAndNoOther) {
    using Edit = void (*)(Layer&);
    using Flag = bool LayerDiff::*;
    const std::vector<std::pair<Edit, Flag>> edits{
        {[](Layer& layer) { layer.dataset = "other"; }, &LayerDiff::added},
        {[](Layer& layer) { layer.field = "g"; }, &LayerDiff::field},
        {[](Layer& layer) { layer.timeStep = 3; }, &LayerDiff::field},
        {[](Layer& layer) { layer.map.points[1].colour.g = 0.5F; }, &LayerDiff::map},
        {[](Layer& layer) { layer.model = RayModel::kMip; }, &LayerDiff::program},
        {[](Layer& layer) { layer.integrator = Integrator::kAverage; }, &LayerDiff::program},
        {[](Layer& layer) { layer.sampling = Sampling::kNearest; }, &LayerDiff::program},
        {[](Layer& layer) { layer.coloured = true; }, &LayerDiff::program},
        {[](Layer& layer) { layer.headlight = false; }, &LayerDiff::program},
        {[](Layer& layer) { layer.surfaceColour.r = 0.1F; }, &LayerDiff::uniforms},
        {[](Layer& layer) { layer.stepWorld = 0.1; }, &LayerDiff::uniforms}};
    for (const auto& [edit, flag] : edits) {
        Scene after = twoLayers();
        edit(after.layers[1]);
        const SceneDiff changes = diff(twoLayers(), after);
        EXPECT_FALSE(changes.camera || changes.background || changes.order);
        ASSERT_EQ(changes.layers.size(), 1U);
        EXPECT_EQ(changes.layers[0].id, "b");
        for (const Flag any : {&LayerDiff::added, &LayerDiff::field, &LayerDiff::map,
                               &LayerDiff::program, &LayerDiff::uniforms}) {
            EXPECT_EQ(changes.layers[0].*any, any == flag);
        }
    }
}

TEST(SceneDiff, RemovingHidingAndMovingLayersIsAChangeOfOrder) {
    Scene removed = twoLayers();
    removed.layers.pop_back();
    EXPECT_TRUE(diff(twoLayers(), removed).order);
    Scene hidden = twoLayers();
    hidden.layers[0].visible = false;
    EXPECT_TRUE(diff(twoLayers(), hidden).order);
    EXPECT_TRUE(diff(twoLayers(), hidden).layers.empty());
    Scene moved = twoLayers();
    std::swap(moved.layers[0], moved.layers[1]);
    EXPECT_TRUE(diff(twoLayers(), moved).order);
    EXPECT_TRUE(diff(twoLayers(), moved).layers.empty());
}

TEST(SceneDiff, AddingOrShowingALayerIsAnAddedLayer) {
    Scene before = twoLayers();
    before.layers.erase(before.layers.begin());
    for (Scene start : {before, twoLayers()}) {
        if (start.layers.size() == 2) start.layers[0].visible = false;
        const SceneDiff changes = diff(start, twoLayers());
        EXPECT_FALSE(changes.order);
        ASSERT_EQ(changes.layers.size(), 1U);
        EXPECT_EQ(changes.layers[0].id, "a");
        EXPECT_TRUE(changes.layers[0].added);
    }
}

TEST(SceneDiff, WhatHappensToAHiddenLayerDrawsNothing) {
    Scene before = twoLayers();
    before.layers[0].visible = false;
    Scene after = before;
    after.layers[0].map.points[1].extinction = 9.0F;
    after.layers[0].model = RayModel::kMip;
    EXPECT_TRUE(diff(before, after).empty());
}

TEST(SceneDiff, TheBackgroundIsItsOwnChange) {
    Scene after = twoLayers();
    after.background.r = 1.0F;
    const SceneDiff changes = diff(twoLayers(), after);
    EXPECT_TRUE(changes.background);
    EXPECT_TRUE(changes.layers.empty());
}

}  // namespace
}  // namespace volcast::scene
