#include "server/session/frame_flow.h"

#include <gtest/gtest.h>

namespace volcast::session {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr std::size_t kBytes = 50'000;
const TimePoint kStart = TimePoint{} + std::chrono::hours{1};

TEST(FrameFlow, TwoFramesMayBeUnderWayAtFirst) {
    FrameFlow flow;
    EXPECT_EQ(flow.window(kStart), 2U);
    flow.sent(1, kBytes, kStart);
    flow.sent(2, kBytes, kStart);
    EXPECT_EQ(flow.underWay(), 2U);
}

TEST(FrameFlow, AnAckFreesItsFrameAndAllBeforeIt) {
    FrameFlow flow;
    for (std::uint32_t sequence : {1U, 2U, 3U}) flow.sent(sequence, kBytes, kStart);
    EXPECT_TRUE(flow.acked({.sequence = 2}, kStart + milliseconds{5}));
    EXPECT_EQ(flow.underWay(), 1U);
}

TEST(FrameFlow, AcksOfFramesThatWereNeverSentFreeNothingAhead) {
    FrameFlow flow;
    EXPECT_FALSE(flow.acked({.sequence = 1}, kStart));
    flow.sent(1, kBytes, kStart);
    EXPECT_TRUE(flow.acked({.sequence = 1}, kStart));
    EXPECT_FALSE(flow.acked({.sequence = 1}, kStart));
    EXPECT_EQ(flow.underWay(), 0U);
}

// 30 ms after sending, of which the client held the frame for 12: the round trip is 18 ms.
TEST(FrameFlow, TheRoundTripLeavesOutWhatTheClientHeld) {
    FrameFlow flow;
    flow.sent(1, kBytes, kStart);
    flow.acked({.sequence = 1, .hold = milliseconds{12}}, kStart + milliseconds{30});
    EXPECT_EQ(flow.roundTrip(), milliseconds{18});
}

TEST(FrameFlow, AQueueInTheClientCostsACreditUntilItWasCalm) {
    FrameFlow flow;
    flow.sent(1, kBytes, kStart);
    flow.acked({.sequence = 1, .queued = 2}, kStart);
    EXPECT_EQ(flow.window(kStart), 1U);
    EXPECT_EQ(flow.window(kStart + FrameFlow::kCalm), 2U);
}

TEST(FrameFlow, HoldingFramesLongCostsACredit) {
    FrameFlow flow;
    flow.sent(1, kBytes, kStart);
    flow.acked({.sequence = 1, .hold = milliseconds{51}}, kStart + milliseconds{60});
    EXPECT_EQ(flow.window(kStart + milliseconds{61}), 1U);
}

// Of one frame at a time, 300 ms away, ceil(1 / 0.3 s * 0.3 s) + 1 = 2 fill the way.
TEST(FrameFlow, DistanceIsNoPunishmentButQueueingIs) {
    FrameFlow flow;
    TimePoint now = kStart;
    std::uint32_t sequence = 0;
    for (int i = 0; i < 5; ++i) {
        flow.sent(++sequence, kBytes, now);
        now += milliseconds{300};
        flow.acked({.sequence = sequence}, now);
        EXPECT_EQ(flow.window(now), 2U) << sequence;
        EXPECT_EQ(flow.queueDelay(), microseconds{0});
    }
    for (int i = 0; i < 8; ++i) {  // One late frame is not a queue; a row of them is.
        flow.sent(++sequence, kBytes, now);
        now += milliseconds{300 + 60};
        flow.acked({.sequence = sequence}, now);
        if (i == 0) {
            EXPECT_EQ(flow.queueDelay(), milliseconds{15});
        }
    }
    EXPECT_GT(flow.queueDelay(), FrameFlow::kSlowDelay);
    EXPECT_EQ(flow.window(now), 1U);
}

// Frames each 20 ms, acked 200 ms later: ceil(50 / s * 0.2 s) + 1 = 11 would fit, 8 are the most.
TEST(FrameFlow, AsManyFramesAreUnderWayAsTheWayHolds) {
    FrameFlow flow;
    EXPECT_TRUE(flow.credit(1, kStart));
    EXPECT_FALSE(flow.credit(2, kStart));
    for (int ms = 0; ms <= 2000; ms += 20) {
        const auto sequence = static_cast<std::uint32_t>(ms / 20 + 1);
        flow.sent(sequence, kBytes, kStart + milliseconds{ms});
        if (ms >= 200) flow.acked({.sequence = sequence - 10}, kStart + milliseconds{ms});
    }
    const TimePoint now = kStart + milliseconds{2000};
    EXPECT_EQ(flow.window(now), FrameFlow::kMostFrames);
    EXPECT_NEAR(flow.framesPerS(), 50.0, 5.0);
    EXPECT_NEAR(flow.bytesPerS(), 50.0 * kBytes, 5.0 * kBytes);
    EXPECT_NEAR(static_cast<double>(flow.byteCap().value()), 2.0 * 50 * kBytes * 0.2, 1e5);
}

// 10 frames/s of 10 KB, 40 ms away: 2 * 100 KB/s * 40 ms = 8 KB may be under way.
TEST(FrameFlow, OneLargePictureUnderWayIsEnoughWhereLittleFits) {
    FrameFlow flow;
    TimePoint now = kStart;
    for (std::uint32_t sequence = 1; sequence <= 30; ++sequence) {
        flow.sent(sequence, 4'000, now);
        flow.acked({.sequence = sequence}, now + milliseconds{40});
        now += milliseconds{100};
    }
    EXPECT_TRUE(flow.credit(0, now));
    flow.sent(31, 4'000, now);
    EXPECT_TRUE(flow.credit(0, now)) << "4 KB of 8";
    FrameFlow large = flow;
    large.sent(32, 600'000, now);
    EXPECT_FALSE(large.credit(0, now)) << "604 KB of 8";
}

TEST(FrameFlow, ASilentClientGetsOneProbeAfterTwoSecondsAndNothingAfterTwoMore) {
    FrameFlow flow;
    flow.sent(1, kBytes, kStart);
    flow.sent(2, kBytes, kStart);
    flow.forgiveSilence(kStart + FrameFlow::kProbeAfter - milliseconds{1});
    EXPECT_EQ(flow.underWay(), 2U);
    TimePoint now = kStart + FrameFlow::kProbeAfter;
    flow.forgiveSilence(now);
    EXPECT_EQ(flow.underWay(), 0U);
    EXPECT_EQ(flow.window(now), 1U);
    flow.sent(3, kBytes, now);
    EXPECT_FALSE(flow.credit(0, now));
    EXPECT_EQ(flow.probeAt(), now + FrameFlow::kProbeAfter);
    now += FrameFlow::kProbeAfter;
    flow.forgiveSilence(now);
    EXPECT_TRUE(flow.stopped());
    EXPECT_FALSE(flow.credit(0, now + std::chrono::hours{1}));
    EXPECT_FALSE(flow.probeAt().has_value());
    flow.acked({.sequence = 99}, now);
    EXPECT_TRUE(flow.stopped()) << "that frame was never sent";
    flow.acked({.sequence = 2}, now);  // Of a frame that was given up.
    EXPECT_FALSE(flow.stopped());
    EXPECT_TRUE(flow.credit(0, now));
}

// 100 KB/s: 300 KB need 3 s, so silence begins to count after that.
TEST(FrameFlow, WhatIsLongUnderWayIsNotSilence) {
    FrameFlow flow;
    flow.sent(1, 100'000, kStart);
    TimePoint now = kStart + milliseconds{1000};
    flow.acked({.sequence = 1}, now);
    flow.sent(2, 300'000, now);
    EXPECT_EQ(flow.probeAt(), now + FrameFlow::kProbeAfter + milliseconds{3000});
}

// The shortest round trip is remembered for 15 to 30 s.
TEST(FrameFlow, AWayThatBecameLongerIsTakenAsItIsAfterAWhile) {
    FrameFlow flow;
    TimePoint now = kStart;
    std::uint32_t sequence = 0;
    const auto run = [&](milliseconds roundTrip, int frames) {
        for (int i = 0; i < frames; ++i) {
            flow.sent(++sequence, kBytes, now);
            now += roundTrip;
            flow.acked({.sequence = sequence}, now);
        }
    };
    run(milliseconds{20}, 100);
    run(milliseconds{120}, 50);  // 6 s
    EXPECT_EQ(flow.shortestRoundTrip(), milliseconds{20});
    EXPECT_EQ(flow.window(now), 1U);
    run(milliseconds{120}, 250);  // 30 s
    EXPECT_EQ(flow.shortestRoundTrip(), milliseconds{120});
    EXPECT_EQ(flow.window(now), 2U);
}

}  // namespace
}  // namespace volcast::session
