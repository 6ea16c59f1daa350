#include "server/session/draw_pace.h"

#include <gtest/gtest.h>

namespace volcast::session {
namespace {

constexpr scene::PictureSize kSize{1024, 1024};

scene::PictureSize at(double scale) {
    return {static_cast<int>(kSize.x * scale), static_cast<int>(kSize.y * scale)};
}

/// Draws moving pictures as the pace asks, which cost what `msOf` says of a whole one.
DrawLevel settle(DrawPace& pace, double fullMs, double fastMs, int pictures = 12) {
    for (int i = 0; i < pictures; ++i) {
        const DrawLevel level = pace.level(kSize);
        const double ms = (level.fullAccuracy ? fullMs : fastMs) * level.scale * level.scale;
        pace.drawn(at(level.scale), level.fullAccuracy, ms);
    }
    return pace.level(kSize);
}

TEST(DrawPace, NothingIsGivenUpWherePicturesAreQuick) {
    DrawPace pace;
    EXPECT_EQ(settle(pace, 40.0, 20.0), DrawLevel{});
    EXPECT_EQ(pace.reason(kSize), "");
}

TEST(DrawPace, AccuracyGoesFirstAndSidesOnlyWhereThatIsNotEnough) {
    DrawPace enough, notEnough;
    EXPECT_EQ(settle(enough, 120.0, 45.0), (DrawLevel{.fullAccuracy = false, .scale = 1.0}));
    EXPECT_EQ(settle(notEnough, 400.0, 150.0), (DrawLevel{.fullAccuracy = false, .scale = 0.5}));
    EXPECT_EQ(notEnough.reason(kSize), "a whole picture takes 400 ms to draw");
}

TEST(DrawPace, AccuracyIsKeptWhereGivingItUpSavesNothing) {
    DrawPace pace;
    EXPECT_EQ(settle(pace, 150.0, 145.0), (DrawLevel{.fullAccuracy = true, .scale = 0.5}));
}

TEST(DrawPace, OneSlowPictureChangesNothing) {
    DrawPace pace;
    settle(pace, 30.0, 20.0);
    EXPECT_FALSE(pace.drawn(kSize, true, 900.0)) << "programs are built once";
    EXPECT_EQ(pace.level(kSize), DrawLevel{});
    EXPECT_TRUE(pace.drawn(kSize, true, 900.0));
    EXPECT_NE(pace.level(kSize), DrawLevel{});
}

TEST(DrawPace, NoiseOfAThirdDoesNotChangeTheLevel) {
    DrawPace pace;
    const DrawLevel level = settle(pace, 400.0, 150.0);
    for (int i = 0; i < 40; ++i) {
        const double noise = i % 4 < 2 ? 0.8 : 1.3;
        EXPECT_FALSE(pace.drawn(at(level.scale), false, noise * 150.0 * level.scale * level.scale))
            << i;
    }
}

TEST(DrawPace, RisesAgainWhenPicturesBecomeCheap) {
    DrawPace pace;
    ASSERT_NE(settle(pace, 400.0, 150.0), DrawLevel{});
    pace.drawn(kSize, true, 20.0);  // At rest, in full.
    pace.drawn(kSize, true, 20.0);
    EXPECT_EQ(pace.level(kSize), DrawLevel{});
}

TEST(DrawPace, NoSideFallsUnderTheSmallest) {
    DrawPace pace;
    constexpr scene::PictureSize kSmall{300, 200};
    pace.drawn(kSmall, true, 5000.0);
    pace.drawn(kSmall, true, 5000.0);
    pace.drawn(kSmall, false, 4000.0);
    pace.drawn(kSmall, false, 4000.0);
    EXPECT_EQ(pace.level(kSmall).scale, 1.0) << "225 is less than 256";
    EXPECT_EQ(pace.level(kSize).scale, 0.25) << "however slow";
}

}  // namespace
}  // namespace volcast::session
