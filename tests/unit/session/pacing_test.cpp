#include "server/session/pacing.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/link_model.h"

namespace volcast::session {
namespace {

using std::chrono::milliseconds;
using test::Control;
using test::Link;
using test::LinkRun;
using test::runLink;

const TimePoint kStart = TimePoint{} + std::chrono::hours{1};

/// Frames one after the other, each acked before the next.
struct Conversation {
    Pacing pacing;
    TimePoint now = kStart;
    std::uint32_t sequence = 0;
    void frame(milliseconds roundTrip, std::uint32_t queued = 0) {
        pacing.sent(++sequence, 20'000, now);
        now += roundTrip;
        pacing.acked({.sequence = sequence, .queued = queued}, now);
    }
    void frames(int count, milliseconds roundTrip) {
        for (int i = 0; i < count; ++i) frame(roundTrip);
    }
};

TEST(Pacing, BeginsWithEverythingAndStaysThereOnACalmWay) {
    Conversation talk;
    talk.frames(300, milliseconds{20});
    const PaceReport report = talk.pacing.report(talk.now);
    EXPECT_EQ(report.level, PaceLevel{});
    EXPECT_EQ(report.reason, "");
    EXPECT_EQ(report.roundTrip, milliseconds{20});
    EXPECT_EQ(report.shortestRoundTrip, milliseconds{20});
    EXPECT_EQ(report.queueDelay, milliseconds{0});
    EXPECT_EQ(talk.pacing.nextStart(), TimePoint{});
}

TEST(Pacing, AQueueOnTheWayCostsOneStepASecondAndSaysWhy) {
    Conversation talk;
    talk.frames(5, milliseconds{20});
    talk.frames(4, milliseconds{120});
    EXPECT_EQ(talk.pacing.level().quality, 75);
    const std::string reason = talk.pacing.report(talk.now).reason;
    EXPECT_EQ(reason.find("quality 90 to 75: queueing delay "), 0U) << reason;
    EXPECT_NE(reason.find(" is over 50 ms"), std::string::npos) << reason;
    talk.frames(7, milliseconds{120});  // 840 ms
    EXPECT_EQ(talk.pacing.level().quality, 75);
    talk.frames(3, milliseconds{120});
    EXPECT_EQ(talk.pacing.level().quality, 60);
}

TEST(Pacing, DistanceCostsNothing) {
    Conversation talk;
    talk.frames(100, milliseconds{400});
    EXPECT_EQ(talk.pacing.level(), PaceLevel{});
}

TEST(Pacing, FramesThatWaitInTheClientCostAStep) {
    Conversation talk;
    talk.frame(milliseconds{20}, 2);
    EXPECT_EQ(talk.pacing.level().quality, 90);
    talk.frame(milliseconds{20}, 3);
    EXPECT_EQ(talk.pacing.level().quality, 75);
    EXPECT_EQ(talk.pacing.report(talk.now).reason, "quality 90 to 75: 3 frames wait in the client");
}

TEST(Pacing, ASecondOfCalmGivesAStepBack) {
    Conversation talk;
    talk.frame(milliseconds{20}, 3);
    talk.frames(52, milliseconds{20});
    EXPECT_EQ(talk.pacing.level().quality, 90);
    EXPECT_EQ(talk.pacing.report(talk.now).reason,
              "quality 75 to 90: queueing delay under 15 ms for 1000 ms");
}

TEST(Pacing, BetweenTheTwoDelaysNothingChanges) {
    Conversation talk;
    talk.frame(milliseconds{20}, 3);
    for (int i = 0; i < 100; ++i) talk.frame(milliseconds{20 + 30});
    EXPECT_EQ(talk.pacing.level().quality, 75);
}

// After a step that did not hold the next one waits for 2 s of calm, then 4, at most 32.
TEST(Pacing, AStepUpThatDoesNotHoldIsTriedMoreRarely) {
    Conversation talk;
    talk.frames(3, milliseconds{20});
    std::vector<double> tries;
    int last = 90;
    for (int i = 0; i < 40'000 && tries.size() < 8; ++i) {
        const int quality = talk.pacing.level().quality;
        if (quality == 90 && last == 75) {
            tries.push_back(std::chrono::duration<double>(talk.now - kStart).count());
        }
        last = quality;
        talk.frame(milliseconds{quality == 90 ? 100 : 20});  // 90 is too much for the way.
    }
    ASSERT_EQ(tries.size(), 8U);
    for (std::size_t i = 2; i < 6; ++i) {
        EXPECT_GT(tries[i] - tries[i - 1], 1.5 * (tries[i - 1] - tries[i - 2])) << i;
    }
    EXPECT_LT(tries[7] - tries[6], 36.0);
}

TEST(Pacing, WhatWasSentBeforeAStepDoesNotCauseTheNext) {
    Pacing pacing;
    pacing.sent(1, 20'000, kStart);
    pacing.acked({.sequence = 1}, kStart + milliseconds{20});
    for (std::uint32_t sequence = 2; sequence <= 9; ++sequence) {
        pacing.sent(sequence, 20'000, kStart + milliseconds{20});
    }
    // Eight frames of one burst come back late, over several seconds.
    for (std::uint32_t sequence = 2; sequence <= 9; ++sequence) {
        pacing.acked({.sequence = sequence}, kStart + milliseconds{500 * sequence});
    }
    EXPECT_EQ(pacing.level().quality, 45) << "three steps at once, 245 ms, and no more";
    EXPECT_EQ(pacing.level().scale, 1.0);
}

// 300 ms for a frame where a ping takes 200: the way is thin, though nothing waits on it.
TEST(Pacing, AFrameThatTakesLongOnItsWayCostsSteps) {
    Pacing pacing;
    pacing.sent(1, 40'000, kStart);
    pacing.acked({.sequence = 1, .path = milliseconds{200}}, kStart + milliseconds{300});
    EXPECT_EQ(pacing.level().quality, 75);
    pacing.sent(2, 40'000, kStart + milliseconds{1000});
    pacing.acked({.sequence = 2, .path = milliseconds{200}}, kStart + milliseconds{1301});
    EXPECT_EQ(pacing.level().scale, 1.0);
    EXPECT_EQ(pacing.level().quality, 45);
    EXPECT_EQ(
        pacing.report(kStart).reason,
        "quality 75 to 60, quality 60 to 45: transfer and queueing delay 101 ms is over 50 ms");
}

// Fewer frames of the same bytes would each take as long.
TEST(Pacing, TransferAloneCostsNoAccuracyAndNoRate) {
    Pacing pacing;
    TimePoint now = kStart;
    for (std::uint32_t sequence = 1; sequence <= 40; ++sequence) {
        pacing.sent(sequence, 40'000, now);
        now += milliseconds{600};
        pacing.acked({.sequence = sequence, .path = milliseconds{200}}, now);
    }
    EXPECT_EQ(pacing.level().scale, 0.5);
    EXPECT_TRUE(pacing.level().fullAccuracy);
    EXPECT_EQ(pacing.level().framesPerS, 0.0);
}

// A rate that a queue cost comes back once the queue has gone, however thin the way.
TEST(Pacing, TransferDoesNotKeepTheRateDown) {
    Pacing pacing;
    TimePoint now = kStart;
    std::uint32_t sequence = 0;
    const auto frames = [&](int count, milliseconds roundTrip) {
        for (int i = 0; i < count; ++i) {
            pacing.sent(++sequence, 5'000, now);
            now += roundTrip;
            pacing.acked({.sequence = sequence, .path = milliseconds{200}}, now);
        }
    };
    frames(1, milliseconds{240});
    frames(30, milliseconds{400});
    ASSERT_GT(pacing.level().framesPerS, 0.0);
    frames(400, milliseconds{240});
    EXPECT_EQ(pacing.level().framesPerS, 0.0);
    EXPECT_EQ(pacing.level().scale, 0.5) << "40 ms of transfer leave no room for larger pictures";
}

TEST(Pacing, TheLowestRateKeepsStartsApart) {
    Conversation talk;
    talk.pacing.setPins({.framesPerS = 4.0});
    talk.pacing.started(talk.now);
    EXPECT_EQ(talk.pacing.nextStart(), talk.now + milliseconds{250});
}

TEST(Pacing, PinsHoldOnTheWorstOfWays) {
    Conversation talk;
    talk.pacing.setPins({.quality = 95, .scale = 1.0});
    talk.frames(3, milliseconds{20});
    talk.frames(40, milliseconds{300});  // 12 s: the short round trip is still remembered.
    EXPECT_EQ(talk.pacing.level().quality, 95);
    EXPECT_EQ(talk.pacing.level().scale, 1.0);
    EXPECT_FALSE(talk.pacing.level().fullAccuracy);
    EXPECT_GT(talk.pacing.level().framesPerS, 0.0);
}

// ---- over simulated links: all times are computed ----

constexpr double kSeconds = 60, kSettledS = 20;

struct LinkCase {
    double megabits, roundTripMs, jitterMs;
    bool video;
};

class PacingOverALink : public testing::TestWithParam<LinkCase> {
protected:
    [[nodiscard]] Link link() const {
        return {.bytesPerS = GetParam().megabits * 125e3,
                .roundTripS = GetParam().roundTripMs / 1e3,
                .jitterS = GetParam().jitterMs / 1e3};
    }
    [[nodiscard]] LinkRun run(Control control) const {
        return runLink(link(), control, kSeconds, 1.0 / 30, 0.004, GetParam().video);
    }
};

std::vector<LinkCase> linkCases() {
    std::vector<LinkCase> cases;
    for (const double megabits : {1.0, 10.0, 100.0}) {
        for (const double roundTrip : {5.0, 50.0, 200.0}) {
            for (const double jitter : {0.0, 20.0}) {
                for (const bool video : {false, true}) {
                    cases.push_back({megabits, roundTrip, jitter, video});
                }
            }
        }
    }
    return cases;
}

INSTANTIATE_TEST_SUITE_P(Links, PacingOverALink, testing::ValuesIn(linkCases()),
                         [](const auto& row) {
                             const LinkCase& c = row.param;
                             const auto text = [](double v) {
                                 return std::to_string(static_cast<int>(v));
                             };
                             return text(c.megabits) + "Mbit" + text(c.roundTripMs) + "ms" +
                                    (c.jitterMs > 0 ? "Jitter" : "") + (c.video ? "Video" : "");
                         });

// Drawing (33 ms), half a round trip, showing (4 ms), jitter, the wire for the frame itself and for
// the one before it (two may be under way), and the queueing delay that is not yet acted on: 50 ms.
TEST_P(PacingOverALink, KeepsFramesYoung) {
    const LinkRun full = run(Control::kFull);
    ASSERT_FALSE(full.shown.empty());
    const double wireMs =
        static_cast<double>(test::frameBytes(full.shown.back().level)) / link().bytesPerS * 1e3;
    const double bound =
        33 + GetParam().roundTripMs / 2 + 4 + GetParam().jitterMs + 2 * wireMs + 50;
    EXPECT_LT(test::ageMs(full, 0.95, kSettledS), bound);
    EXPECT_LE(full.mostUnderWay, FrameFlow::kMostFrames);
}

TEST_P(PacingOverALink, IsNoSlowerThanOneCreditAndFarYoungerThanNoControl) {
    const LinkRun full = run(Control::kFull), credit = run(Control::kOneCredit),
                  none = run(Control::kNone);
    EXPECT_GE(test::framesPerS(full, kSettledS, kSeconds),
              test::framesPerS(credit, kSettledS, kSeconds));
    const bool overloaded = 30.0 * static_cast<double>(test::frameBytes({})) > link().bytesPerS;
    if (overloaded) {
        EXPECT_LT(test::ageMs(full, 0.5, kSettledS), test::ageMs(none, 0.5, kSettledS) / 5);
    }
}

// Tries of what does not hold become rare: in the last 20 s there are at most two, each two steps.
TEST_P(PacingOverALink, DoesNotOscillate) {
    const LinkRun full = run(Control::kFull);
    std::size_t late = 0;
    for (const auto& [at, reason] : full.steps) late += at >= kSeconds - 20 ? 1 : 0;
    EXPECT_LE(late, 4U) << full.steps.size() << " steps";
}

TEST(PacingOverLinks, AWayThatIsWideEnoughKeepsEverything) {
    for (const double roundTrip : {0.005, 0.05, 0.2}) {
        const Link link{.bytesPerS = 12.5e6, .roundTripS = roundTrip};
        const LinkRun full = runLink(link, Control::kFull, kSeconds);
        EXPECT_TRUE(full.steps.empty()) << full.steps.front().second;
        EXPECT_GT(test::framesPerS(full, kSettledS, kSeconds), 28.0) << roundTrip;
    }
}

// 10 Mbit/s falls to a twentieth for 20 s and comes back.
TEST(PacingOverLinks, RecoversFromABadTime) {
    Link link{.bytesPerS = 1.25e6, .roundTripS = 0.05};
    link.share = [](double s) { return s >= 20 && s < 40 ? 0.05 : 1.0; };
    const LinkRun run = runLink(link, Control::kFull, 120);
    const auto levelAt = [&run](double at) {
        PaceLevel level;
        for (const test::ShownFrame& frame : run.shown) {
            if (frame.shownAt < at) level = frame.level;
        }
        return level;
    };
    EXPECT_EQ(levelAt(20), PaceLevel{});
    EXPECT_LT(levelAt(39).quality, 60);
    EXPECT_EQ(levelAt(120), PaceLevel{}) << "quality " << levelAt(120).quality;
}

// The client takes 200 KB/s: after the first second (the first two frames of 50 KB leave before an
// ack tells anything) no picture is older than half a second.
TEST(PacingOverLinks, ASlowReaderSeesNothingOlderThanHalfASecond) {
    const LinkRun run = runLink({.bytesPerS = 200e3, .roundTripS = 0.001}, Control::kFull, 60);
    EXPECT_LT(test::ageMs(run, 1.0, 1.0), 500.0);
}

}  // namespace
}  // namespace volcast::session
