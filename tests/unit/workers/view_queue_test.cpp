#include "server/workers/view_queue.h"

#include <gtest/gtest.h>

namespace volcast::workers {
namespace {

const ViewQueue::Clock::time_point kNow{};

RenderRequest request(std::uint64_t view, std::uint64_t tag) {
    RenderRequest result;
    result.view = view;
    result.tag = tag;
    return result;
}

/// View and tag of the request whose turn it is; {0, 0}: none.
std::pair<std::uint64_t, std::uint64_t> take(ViewQueue& queue) {
    const auto next = queue.next();
    return next ? std::pair{next->request.view, next->request.tag}
                : std::pair{std::uint64_t{0}, std::uint64_t{0}};
}

using Taken = std::pair<std::uint64_t, std::uint64_t>;

TEST(ViewQueue, NewerRequestReplacesTheOneThatWaits) {
    ViewQueue queue;
    queue.submit(request(1, 10), kNow);
    queue.submit(request(1, 11), kNow);
    EXPECT_EQ(take(queue), Taken(1, 11));
    EXPECT_EQ(take(queue), Taken(0, 0));
}

TEST(ViewQueue, ViewsTakeTurnsHoweverOftenOneSubmits) {
    ViewQueue queue;
    queue.submit(request(1, 1), kNow);
    queue.submit(request(2, 1), kNow);
    queue.submit(request(3, 1), kNow);
    for (std::uint64_t tag = 2; tag < 20; ++tag) queue.submit(request(1, tag), kNow);
    EXPECT_EQ(queue.waiting(), 3U);
    EXPECT_EQ(take(queue), Taken(1, 19));
    EXPECT_EQ(queue.waiting(), 2U);
    queue.submit(request(1, 20), kNow);
    EXPECT_EQ(take(queue), Taken(2, 1));
    EXPECT_EQ(take(queue), Taken(3, 1));
    EXPECT_EQ(take(queue), Taken(1, 20));
}

TEST(ViewQueue, WhatIsInTheBackgroundComesWhenNothingElseWaits) {
    ViewQueue queue;
    RenderRequest small = request(1, 1);
    small.background = true;
    queue.submit(small, kNow);
    queue.submit(request(2, 1), kNow);
    queue.submit(request(3, 1), kNow);
    EXPECT_EQ(take(queue), Taken(2, 1));
    queue.submit(request(2, 2), kNow);
    EXPECT_EQ(take(queue), Taken(3, 1));
    EXPECT_EQ(take(queue), Taken(2, 2));
    EXPECT_EQ(take(queue), Taken(1, 1));
    EXPECT_EQ(take(queue), Taken(0, 0));
}

TEST(ViewQueue, WhatIsDrawnInPartWaitsForItsNextTurnUnlessItsViewHasNews) {
    ViewQueue queue;
    queue.submit(request(1, 1), kNow);
    queue.submit(request(2, 1), kNow);
    auto part = queue.next();
    ASSERT_TRUE(part.has_value());
    part->waitedMs = 7.0;
    queue.drawnInPart(*part);
    EXPECT_EQ(take(queue), Taken(2, 1)) << "the others first";
    auto again = queue.next();
    ASSERT_TRUE(again.has_value());
    EXPECT_EQ(again->request.tag, 1U);
    EXPECT_EQ(again->waitedMs, 7.0);
    queue.submit(request(1, 2), kNow);
    queue.drawnInPart(*again);
    EXPECT_EQ(take(queue), Taken(1, 2));
    EXPECT_EQ(take(queue), Taken(0, 0));
    queue.drop(1);
    queue.drawnInPart(*again);
    EXPECT_EQ(take(queue), Taken(0, 0));
}

TEST(ViewQueue, DroppedViewIsForgotten) {
    ViewQueue queue;
    queue.submit(request(1, 1), kNow);
    queue.submit(request(2, 1), kNow);
    queue.drop(1);
    EXPECT_FALSE(queue.knows(1));
    EXPECT_EQ(take(queue), Taken(2, 1));
    EXPECT_EQ(take(queue), Taken(0, 0));
    queue.succeeded(request(1, 1));  // Was in flight while it was dropped.
    EXPECT_FALSE(queue.knows(1));
}

TEST(ViewQueue, LossDrawsEveryViewAgainAndTheOneInFlightLast) {
    ViewQueue queue;
    for (const std::uint64_t view : {1, 2, 3}) {
        queue.submit(request(view, 5), kNow);
        queue.succeeded(queue.next()->request);
    }
    queue.submit(request(2, 6), kNow);
    queue.submit(request(1, 7), kNow);
    ASSERT_EQ(take(queue), Taken(2, 6));  // In flight when the worker goes.
    const auto loss = queue.lost(request(2, 6), kNow);
    EXPECT_EQ(loss.views, (std::vector<std::uint64_t>{1, 2, 3}));
    EXPECT_TRUE(loss.givenUp.empty());
    EXPECT_EQ(take(queue), Taken(1, 7));  // What waited is newer than what was drawn.
    EXPECT_EQ(take(queue), Taken(3, 5));
    EXPECT_EQ(take(queue), Taken(2, 6));
    EXPECT_EQ(take(queue), Taken(0, 0));
}

TEST(ViewQueue, RequestThatLosesTwoWorkersIsGivenUpAndTheViewGoesOn) {
    ViewQueue queue;
    queue.submit(request(1, 1), kNow);
    EXPECT_TRUE(queue.lost(queue.next()->request, kNow).givenUp.empty());
    const auto second = queue.lost(queue.next()->request, kNow);
    ASSERT_EQ(second.givenUp.size(), 1U);
    EXPECT_EQ(second.givenUp[0].tag, 1U);
    EXPECT_EQ(take(queue), Taken(0, 0));
    queue.submit(request(1, 2), kNow);
    EXPECT_EQ(take(queue), Taken(1, 2));
}

TEST(ViewQueue, NewerRequestOfTheSameViewDoesNotBuyAThirdWorker) {
    ViewQueue queue;
    queue.submit(request(1, 1), kNow);
    queue.lost(queue.next()->request, kNow);
    const auto inFlight = queue.next()->request;
    queue.submit(request(1, 2), kNow);
    const auto second = queue.lost(inFlight, kNow);
    ASSERT_EQ(second.givenUp.size(), 2U);
    EXPECT_EQ(second.givenUp[0].tag, 1U);
    EXPECT_EQ(second.givenUp[1].tag, 2U);
    EXPECT_EQ(take(queue), Taken(0, 0));
}

TEST(ViewQueue, GivenUpViewHasOneTryUntilItSucceeds) {
    ViewQueue queue;
    queue.submit(request(1, 1), kNow);
    queue.lost(queue.next()->request, kNow);
    queue.lost(queue.next()->request, kNow);
    queue.submit(request(1, 2), kNow);
    EXPECT_EQ(queue.lost(queue.next()->request, kNow).givenUp.size(), 1U);
    queue.submit(request(1, 3), kNow);
    queue.succeeded(queue.next()->request);
    queue.submit(request(1, 4), kNow);
    EXPECT_TRUE(queue.lost(queue.next()->request, kNow).givenUp.empty());
}

TEST(ViewQueue, WhatWasGivenUpIsHeldWhereverItIsSeenFrom) {
    ViewQueue queue;
    RenderRequest bad = request(1, 1);
    bad.scene.layers.emplace_back();
    queue.submit(bad, kNow);
    queue.lost(queue.next()->request, kNow);
    EXPECT_FALSE(queue.holds(bad)) << "it has another try";
    queue.lost(queue.next()->request, kNow);
    EXPECT_TRUE(queue.holds(bad));
    bad.scene.camera.eye.x += 1.0;
    EXPECT_TRUE(queue.holds(bad));
    EXPECT_FALSE(queue.holds(request(1, 2))) << "another scene";
    RenderRequest other = bad;
    other.view = 2;
    EXPECT_FALSE(queue.holds(other)) << "another view";
    other = bad;
    other.scene.accuracy = {.kind = scene::Accuracy::Kind::kFastest};
    EXPECT_FALSE(queue.holds(other)) << "another accuracy, of the user's choice";
    other = bad;
    other.size = {7, 7};
    EXPECT_TRUE(queue.holds(other)) << "pacing has made it smaller";
    other.hurried = true;
    EXPECT_TRUE(queue.holds(other)) << "and less accurate";
    queue.forgive();
    EXPECT_FALSE(queue.holds(bad));
}

/// A scene that differs from others a little.
RenderRequest endless(std::uint64_t view, std::uint64_t tag) {
    RenderRequest result = request(view, tag);
    result.scene.layers.emplace_back().stepWorld = 1e-5 * static_cast<double>(tag);
    return result;
}

/// Two workers are lost over what is drawn next.
void giveUpNext(ViewQueue& queue) {
    queue.lost(queue.next()->request, kNow);
    ASSERT_EQ(queue.lost(queue.next()->request, kNow).givenUp.size(), 1U);
}

TEST(ViewQueue, AfterTwoScenesThatWereGivenUpTheViewKeepsToItsGoodOneForAWhile) {
    ViewQueue queue;
    for (const std::uint64_t tag : {10, 11}) {
        EXPECT_FALSE(queue.pause(endless(1, tag), kNow)) << tag;
        queue.submit(request(1, 1), kNow);
        queue.succeeded(queue.next()->request);  // The good scene in between pardons nothing.
        queue.submit(endless(1, tag), kNow);
        giveUpNext(queue);
        queue.submit(request(1, 1), kNow);
        queue.succeeded(queue.next()->request);
    }
    const auto pause = queue.pause(endless(1, 12), kNow);
    ASSERT_TRUE(pause);
    EXPECT_EQ(pause->left, std::chrono::seconds{30});
    EXPECT_EQ(pause->scenes, 2);
    RenderRequest good = request(1, 2);
    good.scene.camera.eye.x += 1.0;
    good.size = {7, 7};
    EXPECT_FALSE(queue.pause(good, kNow));
    EXPECT_FALSE(queue.pause(endless(2, 12), kNow)) << "another view";
    queue.forgive();
    EXPECT_TRUE(queue.pause(endless(1, 12), kNow)) << "whatever became of the data";
    EXPECT_FALSE(queue.pause(endless(1, 12), kNow + std::chrono::seconds{30}));
}

TEST(ViewQueue, WhereCamerasTookWorkersDownTheViewKeepsToThatOfItsGoodPicture) {
    ViewQueue queue;
    for (const double shift : {1.0, 2.0}) {
        queue.submit(request(1, 1), kNow);
        queue.succeeded(queue.next()->request);
        RenderRequest bad = request(1, 2);
        bad.scene.camera.eye.x += shift;
        queue.submit(bad, kNow);
        giveUpNext(queue);
    }
    RenderRequest moved = request(1, 3);
    moved.scene.camera.eye.x += 3.0;
    EXPECT_TRUE(queue.pause(moved, kNow));
    moved = request(1, 4);
    moved.size = {7, 7};
    EXPECT_FALSE(queue.pause(moved, kNow));
}

TEST(ViewQueue, OfASceneThatWasDrawnFromElsewhereTheCameraIsHeld) {
    ViewQueue queue;
    queue.submit(request(1, 1), kNow);
    queue.succeeded(queue.next()->request);
    RenderRequest bad = request(1, 2);
    bad.scene.camera.eye.x += 1.0;
    queue.submit(bad, kNow);
    const auto first = queue.lost(queue.next()->request, kNow);
    EXPECT_FALSE(first.proven);
    queue.lost(queue.next()->request, kNow);
    EXPECT_TRUE(queue.holds(bad));
    EXPECT_FALSE(queue.holds(request(1, 3)));
}

TEST(ViewQueue, OfASceneThatWasDrawnSmallerOrInAHurryTheRestIsHeld) {
    for (const bool hurried : {false, true}) {
        ViewQueue queue;
        RenderRequest good = request(1, 1);
        good.hurried = hurried;
        if (!hurried) good.size = {7, 7};
        queue.submit(good, kNow);
        queue.succeeded(queue.next()->request);
        queue.submit(request(1, 2), kNow);
        EXPECT_FALSE(queue.lost(queue.next()->request, kNow).proven);
        queue.lost(queue.next()->request, kNow);
        EXPECT_TRUE(queue.holds(request(1, 3)));
        EXPECT_FALSE(queue.holds(good));
    }
}

TEST(ViewQueue, WhatWasDrawnBeforeIsNotHeldForALaterLoss) {
    ViewQueue queue;
    queue.submit(request(1, 1), kNow);
    queue.succeeded(queue.next()->request);
    for (int i = 0; i < 2; ++i) {
        queue.submit(request(1, 1), kNow);
        EXPECT_TRUE(queue.lost(queue.next()->request, kNow).proven);
    }
    EXPECT_FALSE(queue.holds(request(1, 1)));
}

TEST(ViewQueue, ANewerSceneThatWaitsIsTriedAfterTheOldOneWasGivenUp) {
    ViewQueue queue;
    RenderRequest bad = request(1, 1);
    bad.scene.layers.emplace_back();
    queue.submit(bad, kNow);
    queue.lost(queue.next()->request, kNow);
    const auto inFlight = queue.next()->request;
    queue.submit(request(1, 2), kNow);
    EXPECT_EQ(queue.lost(inFlight, kNow).givenUp.size(), 1U);
    EXPECT_EQ(take(queue), Taken(1, 2));
}

TEST(ViewQueue, LossWhileIdleBlamesNobody) {
    ViewQueue queue;
    queue.submit(request(1, 1), kNow);
    queue.succeeded(queue.next()->request);
    for (int i = 0; i < 5; ++i) {
        EXPECT_TRUE(queue.lost(std::nullopt, kNow).givenUp.empty());
        EXPECT_EQ(take(queue), Taken(1, 1));
        queue.succeeded(request(1, 1));
    }
}

TEST(ViewQueue, RefusedRequestDoesNotBecomeTheLastGoodOne) {
    ViewQueue queue;
    queue.submit(request(1, 1), kNow);
    queue.succeeded(queue.next()->request);
    queue.submit(request(1, 2), kNow);
    queue.next();
    queue.refused(1);
    queue.lost(std::nullopt, kNow);
    EXPECT_EQ(take(queue), Taken(1, 1));
}

TEST(ViewQueue, PicturesInTheBackgroundAreNotWhatWasDrawnLast) {
    ViewQueue queue;
    EXPECT_EQ(queue.lastDrawn(), nullptr);
    for (const bool background : {false, true}) {
        RenderRequest drawn = request(background ? 2 : 1, 7);
        drawn.background = background;
        queue.submit(drawn, kNow);
        take(queue);
        queue.succeeded(drawn);
    }
    ASSERT_NE(queue.lastDrawn(), nullptr);
    EXPECT_EQ(queue.lastDrawn()->view, 1U);
    queue.drop(1);
    EXPECT_EQ(queue.lastDrawn(), nullptr);
}

TEST(ViewQueue, TakeAllEmptiesEveryMailbox) {
    ViewQueue queue;
    queue.submit(request(1, 1), kNow);
    queue.submit(request(2, 1), kNow);
    EXPECT_EQ(queue.takeAll().size(), 2U);
    EXPECT_EQ(take(queue), Taken(0, 0));
    EXPECT_TRUE(queue.knows(1));
}

}  // namespace
}  // namespace volcast::workers
