#include "server/session/frame_flow.h"

#include <gtest/gtest.h>

namespace volcast::session {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

const TimePoint kStart = TimePoint{} + std::chrono::hours{1};

TEST(FrameFlow, TwoFramesMayBeUnderWayAtFirst) {
    FrameFlow flow;
    EXPECT_EQ(flow.window(kStart), 2U);
    flow.sent(1, kStart);
    flow.sent(2, kStart);
    EXPECT_EQ(flow.underWay(), 2U);
}

TEST(FrameFlow, AnAckFreesItsFrameAndAllBeforeIt) {
    FrameFlow flow;
    for (std::uint32_t sequence : {1U, 2U, 3U}) flow.sent(sequence, kStart);
    EXPECT_TRUE(flow.acked({.sequence = 2}, kStart + milliseconds{5}));
    EXPECT_EQ(flow.underWay(), 1U);
}

TEST(FrameFlow, AcksOfFramesThatWereNeverSentFreeNothingAhead) {
    FrameFlow flow;
    EXPECT_FALSE(flow.acked({.sequence = 1}, kStart));
    flow.sent(1, kStart);
    EXPECT_TRUE(flow.acked({.sequence = 1}, kStart));
    EXPECT_FALSE(flow.acked({.sequence = 1}, kStart));
    EXPECT_EQ(flow.underWay(), 0U);
}

// 30 ms after sending, of which the client held the frame for 12: the round trip is 18 ms.
TEST(FrameFlow, TheRoundTripLeavesOutWhatTheClientHeld) {
    FrameFlow flow;
    flow.sent(1, kStart);
    flow.acked({.sequence = 1, .hold = milliseconds{12}}, kStart + milliseconds{30});
    EXPECT_EQ(flow.roundTrip(), milliseconds{18});
}

TEST(FrameFlow, AQueueInTheClientCostsACreditUntilItWasCalm) {
    FrameFlow flow;
    flow.sent(1, kStart);
    flow.acked({.sequence = 1, .queued = 2}, kStart);
    EXPECT_EQ(flow.window(kStart), 1U);
    EXPECT_EQ(flow.window(kStart + FrameFlow::kCalm), 2U);
}

TEST(FrameFlow, HoldingFramesLongCostsACredit) {
    FrameFlow flow;
    flow.sent(1, kStart);
    flow.acked({.sequence = 1, .hold = milliseconds{51}}, kStart + milliseconds{60});
    EXPECT_EQ(flow.window(kStart + milliseconds{61}), 1U);
}

TEST(FrameFlow, DistanceIsNoPunishmentButQueueingIs) {
    FrameFlow flow;
    TimePoint now = kStart;
    for (std::uint32_t sequence = 1; sequence <= 5; ++sequence) {  // 300 ms away, steadily
        flow.sent(sequence, now);
        now += milliseconds{300};
        flow.acked({.sequence = sequence}, now);
        EXPECT_EQ(flow.window(now), 2U) << sequence;
    }
    flow.sent(6, now);
    now += milliseconds{351};  // 51 ms more than the smallest
    flow.acked({.sequence = 6}, now);
    EXPECT_EQ(flow.window(now), 1U);
}

TEST(FrameFlow, ASilentClientGetsOneProbeEachTwoSeconds) {
    FrameFlow flow;
    flow.sent(1, kStart);
    flow.sent(2, kStart);
    flow.forgiveSilence(kStart + FrameFlow::kProbeAfter - milliseconds{1});
    EXPECT_EQ(flow.underWay(), 2U);
    TimePoint now = kStart + FrameFlow::kProbeAfter;
    flow.forgiveSilence(now);
    EXPECT_EQ(flow.underWay(), 0U);
    EXPECT_EQ(flow.window(now), 1U);
    flow.sent(3, now);
    EXPECT_EQ(flow.probeAt(), now + FrameFlow::kProbeAfter);
    flow.acked({.sequence = 3}, now + milliseconds{1});
    EXPECT_EQ(flow.window(now + milliseconds{1}), 2U);
}

}  // namespace
}  // namespace volcast::session
