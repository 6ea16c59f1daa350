#include "server/session/pace_ladder.h"

#include <gtest/gtest.h>

namespace volcast::session {
namespace {

std::vector<std::string> allDown(PaceLadder& ladder) {
    std::vector<std::string> changes;
    for (std::string change = ladder.down(); !change.empty(); change = ladder.down()) {
        changes.push_back(change);
    }
    return changes;
}

TEST(PaceLadder, GivesUpQualityThenScaleThenAccuracyThenRate) {
    PaceLadder ladder;
    EXPECT_EQ(ladder.level(), PaceLevel{});
    EXPECT_EQ(allDown(ladder),
              (std::vector<std::string>{
                  "quality 90 to 75", "quality 75 to 60", "quality 60 to 45", "scale 1 to 0.75",
                  "scale 0.75 to 0.5", "full accuracy to fast", "rate as drawn to 15 frames/s",
                  "rate 15 frames/s to 8 frames/s", "rate 8 frames/s to 4 frames/s",
                  "rate 4 frames/s to 2 frames/s"}));
    EXPECT_EQ(ladder.level(),
              (PaceLevel{.quality = 45, .scale = 0.5, .fullAccuracy = false, .framesPerS = 2.0}));
    EXPECT_EQ(ladder.up(), "rate 2 frames/s to 4 frames/s");
    while (!ladder.up().empty()) {
    }
    EXPECT_EQ(ladder.level(), PaceLevel{});
}

TEST(PaceLadder, VideoComesBeforeAnyLossOfQualityWhereTheClientHasIt) {
    PaceLadder ladder{true};
    EXPECT_FALSE(ladder.level().video);
    EXPECT_EQ(ladder.down(), "JPEG to video");
    EXPECT_TRUE(ladder.level().video);
    EXPECT_EQ(ladder.level().quality, 90);
    EXPECT_EQ(ladder.up(), "video to JPEG");
}

TEST(PaceLadder, WhatIsPinnedIsNeverChanged) {
    PaceLadder ladder{true};
    ladder.setPins({.quality = 80, .fullAccuracy = true, .video = false});
    for (const std::string& change : allDown(ladder)) {
        EXPECT_EQ(change.find("quality"), std::string::npos) << change;
        EXPECT_EQ(change.find("accuracy"), std::string::npos) << change;
        EXPECT_EQ(change.find("video"), std::string::npos) << change;
    }
    EXPECT_EQ(ladder.level(), (PaceLevel{.quality = 80, .scale = 0.5, .framesPerS = 2.0}));
    PaceLadder other{true};
    other.setPins({.quality = 100, .scale = 0.9, .framesPerS = 30, .fullAccuracy = false});
    EXPECT_EQ(allDown(other), std::vector<std::string>{"JPEG to video"});
    EXPECT_EQ(
        other.level(),
        (PaceLevel{
            .video = true, .quality = 100, .scale = 0.9, .fullAccuracy = false, .framesPerS = 30}));
}

TEST(PaceLadder, StepsThatWereTakenOutliveAChangeOfPins) {
    PaceLadder ladder;
    for (int i = 0; i < 5; ++i) ladder.down();  // Quality 45, scale 0.5.
    ladder.setPins({.quality = 70});
    EXPECT_EQ(ladder.level(), (PaceLevel{.quality = 70, .scale = 0.5}));
    ladder.setPins({});
    EXPECT_EQ(ladder.level(), (PaceLevel{.quality = 45, .scale = 0.5}));
    ladder.allowVideo(true);
    EXPECT_EQ(ladder.level(), (PaceLevel{.video = true, .quality = 45, .scale = 0.5}));
    ladder.allowVideo(false);
    EXPECT_EQ(ladder.level(), (PaceLevel{.quality = 45, .scale = 0.5}));
}

TEST(PaceLadder, WhoPinsEverythingHasNoSteps) {
    PaceLadder ladder{true};
    ladder.setPins(
        {.quality = 90, .scale = 1.0, .framesPerS = 60, .fullAccuracy = true, .video = false});
    EXPECT_EQ(ladder.steps(), 0U);
    EXPECT_EQ(ladder.down(), "");
    EXPECT_EQ(ladder.up(), "");
}

}  // namespace
}  // namespace volcast::session
