#include "server/workers/back_off.h"

#include <vector>

#include <gtest/gtest.h>

namespace volcast::workers {
namespace {

using std::chrono::milliseconds;

TEST(BackOff, StartsAtOnceThenDoublesUpToHalfAMinute) {
    BackOff backOff;
    EXPECT_EQ(backOff.delay(), milliseconds{0});
    const std::vector<int> expected{100, 200, 400, 800, 1600, 3200, 6400, 12800, 25600, 30000};
    for (const int delay : expected) {
        backOff.failed();
        EXPECT_EQ(backOff.delay(), milliseconds{delay});
    }
    for (int i = 0; i < 100; ++i) backOff.failed();
    EXPECT_EQ(backOff.delay(), milliseconds{30'000});
}

TEST(BackOff, ForgetsOnceAWorkerIsReady) {
    BackOff backOff;
    backOff.failed();
    backOff.failed();
    EXPECT_EQ(backOff.failures(), 2);
    backOff.succeeded();
    EXPECT_EQ(backOff.delay(), milliseconds{0});
    EXPECT_EQ(backOff.failures(), 0);
}

}  // namespace
}  // namespace volcast::workers
