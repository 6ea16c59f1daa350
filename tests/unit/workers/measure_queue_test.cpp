#include "server/workers/measure_queue.h"

#include <gtest/gtest.h>

namespace volcast::workers {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kPartLimit{70};
constexpr milliseconds kLimit{100};
const MeasureQueue::Clock::time_point kNow{};

MeasureRequest request(std::uint64_t view, std::uint64_t tag = 1) {
    MeasureRequest result;
    result.view = view;
    result.tag = tag;
    return result;
}

/// The view whose part is next; 0: none.
std::uint64_t take(MeasureQueue& queue, MeasureQueue::Clock::time_point now = kNow) {
    const MeasureRequest* next = queue.next(now);
    return next == nullptr ? 0 : next->view;
}

TEST(MeasureQueue, WhatHasBegunComesFirst) {
    MeasureQueue queue{kPartLimit, kLimit};
    queue.submit(request(2));
    EXPECT_EQ(take(queue), 2U);
    queue.submit(request(1));
    EXPECT_FALSE(queue.goOn(kNow));
    EXPECT_EQ(take(queue), 2U);
    EXPECT_EQ(queue.finish().view, 2U);
    EXPECT_FALSE(queue.inHand());
    EXPECT_EQ(take(queue), 1U);
    EXPECT_EQ(queue.finish().view, 1U);
    EXPECT_EQ(take(queue), 0U);
}

TEST(MeasureQueue, WhatIsStoppedOrReplacedDoesNotGoOn) {
    MeasureQueue queue{kPartLimit, kLimit};
    queue.submit(request(1));
    EXPECT_FALSE(queue.stop(1)) << "no worker knows of it";
    EXPECT_EQ(take(queue), 0U);
    queue.submit(request(1));
    EXPECT_EQ(take(queue), 1U);
    EXPECT_TRUE(queue.stop(1));
    EXPECT_FALSE(queue.goOn(kNow));
    EXPECT_EQ(take(queue), 0U);
    queue.submit(request(1, 2));
    EXPECT_EQ(take(queue), 1U);
    queue.submit(request(1, 3));
    EXPECT_FALSE(queue.goOn(kNow));
    EXPECT_EQ(queue.next(kNow)->tag, 3U);
    EXPECT_FALSE(queue.goOn(kNow));
    EXPECT_TRUE(queue.stop(1)) << "begun, though it waits";
    EXPECT_EQ(take(queue), 0U);
}

TEST(MeasureQueue, PartsTogetherHaveTheLimit) {
    MeasureQueue queue{kPartLimit, kLimit};
    queue.submit(request(1));
    for (int part = 0; part < 3; ++part) {
        // A second between parts does not count.
        const auto now = kNow + part * milliseconds{1000};
        ASSERT_EQ(take(queue, now), 1U);
        const auto late = queue.goOn(now + milliseconds{40});
        EXPECT_EQ(late.has_value(), part == 2);
    }
    EXPECT_EQ(take(queue), 0U);
}

TEST(MeasureQueue, BeginsAnewAfterOneLossAndEndsWithTheSecond) {
    MeasureQueue queue{kPartLimit, kLimit};
    queue.submit(request(1));
    queue.submit(request(2));
    EXPECT_EQ(take(queue), 1U);
    EXPECT_TRUE(queue.lost(kNow).empty());
    EXPECT_FALSE(queue.inHand());
    EXPECT_EQ(take(queue), 1U);
    EXPECT_FALSE(queue.goOn(kNow + milliseconds{60}));
    // Between parts it is the worker's, too. View 2 has not begun and loses nothing.
    const auto givenUp = queue.lost(kNow);
    ASSERT_EQ(givenUp.size(), 1U);
    EXPECT_EQ(givenUp[0].view, 1U);
    EXPECT_EQ(take(queue), 2U);
    EXPECT_TRUE(queue.lost(kNow).empty());
    EXPECT_EQ(take(queue), 2U);
}

TEST(MeasureQueue, TheSecondWorkerHasTheWholeLimit) {
    MeasureQueue queue{kPartLimit, kLimit};
    queue.submit(request(1));
    EXPECT_EQ(take(queue), 1U);
    EXPECT_FALSE(queue.goOn(kNow + milliseconds{60}));
    EXPECT_TRUE(queue.lost(kNow).empty());
    EXPECT_EQ(take(queue), 1U);
    EXPECT_FALSE(queue.goOn(kNow + milliseconds{60})) << "60 of 100 ms";
    EXPECT_EQ(take(queue), 1U);
    EXPECT_TRUE(queue.goOn(kNow + milliseconds{60}));
}

TEST(MeasureQueue, APartPastTheLimitCostsNoSecondWorker) {
    MeasureQueue queue{kPartLimit, kLimit};
    queue.submit(request(1));
    EXPECT_EQ(take(queue), 1U);
    EXPECT_EQ(queue.lost(kNow + kPartLimit).size(), 1U);
    EXPECT_EQ(take(queue), 0U);
}

TEST(MeasureQueue, WhatIsStoppedIsNotToldOfALoss) {
    MeasureQueue queue{kPartLimit, kLimit};
    queue.submit(request(1));
    EXPECT_EQ(take(queue), 1U);
    queue.stop(1);
    EXPECT_TRUE(queue.lost(kNow + kPartLimit).empty());
    EXPECT_EQ(take(queue), 0U);
    queue.submit(request(3));
    EXPECT_EQ(queue.takeAll().size(), 1U);
    EXPECT_EQ(take(queue), 0U);
}

}  // namespace
}  // namespace volcast::workers
