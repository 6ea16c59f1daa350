#include "server/workers/rehearsal.h"

#include <gtest/gtest.h>

namespace volcast::workers {
namespace {

constexpr int kMain = 99, kSpare = 100, kNext = 101;

RenderRequest picture(scene::RayModel model, const char* dataset = "demo") {
    RenderRequest request{.view = 1, .tag = 1, .scene = {}, .size = {64, 64}};
    scene::Layer& layer = request.scene.layers.emplace_back();
    layer.dataset = dataset;
    layer.model = model;
    return request;
}

TEST(Rehearsal, OfPicturesAlikeOneIsEnough) {
    Rehearsal rehearsal;
    const RenderRequest volume = picture(scene::RayModel::kVolume);
    ASSERT_TRUE(rehearsal.wants(kSpare, volume));
    rehearsal.began(kSpare, 7, volume);
    EXPECT_TRUE(rehearsal.underWay());
    EXPECT_FALSE(rehearsal.wants(kSpare, picture(scene::RayModel::kMip))) << "one at a time";
    EXPECT_FALSE(rehearsal.ended(8)) << "not its number";
    EXPECT_TRUE(rehearsal.ended(7));
    RenderRequest moved = volume;
    moved.scene.camera.eye += 1.0;
    moved.size = {32, 32};
    EXPECT_FALSE(rehearsal.wants(kSpare, moved));
    EXPECT_TRUE(rehearsal.wants(kSpare, picture(scene::RayModel::kMip)));
    EXPECT_TRUE(rehearsal.wants(kSpare, picture(scene::RayModel::kVolume, "other")));
}

TEST(Rehearsal, TheNextSpareBeginsAnew) {
    Rehearsal rehearsal;
    const RenderRequest volume = picture(scene::RayModel::kVolume);
    rehearsal.began(kSpare, 7, volume);
    rehearsal.ended(7);
    rehearsal.workerLost(kMain);
    EXPECT_TRUE(rehearsal.wants(kNext, volume)) << "the one that knows it draws now";
}

TEST(Rehearsal, WhatASpareDiedOfIsNotAskedAgain) {
    Rehearsal rehearsal;
    const RenderRequest volume = picture(scene::RayModel::kVolume);
    rehearsal.began(kSpare, 7, volume);
    rehearsal.workerLost(kSpare);
    EXPECT_FALSE(rehearsal.underWay());
    EXPECT_FALSE(rehearsal.wants(kNext, volume));
    EXPECT_TRUE(rehearsal.wants(kNext, picture(scene::RayModel::kMip)));
}

}  // namespace
}  // namespace volcast::workers
