#include "server/load/report.h"

#include <gmock/gmock.h>

namespace volcast::load {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Ten seconds of two views that move, 8 and 10 frames/s, with a watcher in one who gets 4.
Outcome twoViews() {
    Outcome outcome;
    outcome.seconds = 10;
    outcome.views = 2;
    Stats& orbit = outcome.kinds["orbit"];
    orbit.clients = 2;
    orbit.framesByClient = {80, 100};
    for (int ms = 1; ms <= 100; ++ms) orbit.inputToFrame.add(ms);
    Stats& watching = outcome.kinds["idle, watching"];
    watching.clients = 1;
    watching.framesByClient = {40};
    watching.age.add(300);
    outcome.steeredFrames = {80, 100};
    outcome.movingFrames = {80, 100, 40};
    outcome.serverMeasured = true;
    outcome.before = {.rootCpuS = 1,
                      .childrenCpuS = 2,
                      .rootBytes = 50'000'000,
                      .treeBytes = 100'000'000,
                      .processes = 3,
                      .rootThreads = 5,
                      .rootDescriptors = 20,
                      .treeThreads = 12,
                      .treeDescriptors = 40};
    outcome.after = outcome.most = outcome.before;
    return outcome;
}

TEST(Report, WithoutThresholdsAnythingGoes) {
    EXPECT_THAT(violations(twoViews(), {}), IsEmpty());
}

TEST(Report, FairnessIsTheSlowestViewOverTheFastest) {
    EXPECT_THAT(violations(twoViews(), {.minFairness = 0.8}), IsEmpty());
    EXPECT_THAT(violations(twoViews(), {.minFairness = 0.81}),
                ElementsAre("fairness of views: 0.8, less than 0.81"));
    Outcome still = twoViews();
    still.steeredFrames.clear();
    EXPECT_THAT(violations(still, {.minFairness = 0.1}),
                ElementsAre("fairness of views: 0, less than 0.1"));
}

TEST(Report, TheSlowestOfAViewThatMovesMayBeAWatcher) {
    EXPECT_THAT(violations(twoViews(), {.minFps = 4}), IsEmpty());
    EXPECT_THAT(violations(twoViews(), {.minFps = 5}),
                ElementsAre("frames/s of the slowest client: 4, less than 5"));
}

TEST(Report, AgesAreOfAllClients) {
    EXPECT_THAT(violations(twoViews(), {.maxAgeMs = 300}), IsEmpty());
    EXPECT_THAT(
        violations(twoViews(), {.maxAgeP99Ms = 200, .maxAgeMs = 200}),
        ElementsAre(HasSubstr("frame age p99 ms: 300"), HasSubstr("frame age max ms: 300")));
    Outcome none = twoViews();
    none.kinds.erase("idle, watching");
    EXPECT_THAT(violations(none, {.maxAgeMs = 1e6}),
                ElementsAre("frame age: no frame showed a new input"));
}

// As of a server that freezes 1 s into 10: what it answered says nothing of the rest.
TEST(Report, WhatIsStillOpenAtTheEndBreaksLimitsByItsTimeSoFar) {
    Outcome outcome = twoViews();
    for (int i = 0; i < 900; ++i) outcome.kinds["orbit"].unanswered.add(10 * i);
    for (int i = 0; i < 900; ++i) outcome.kinds["idle, watching"].unseen.add(10 * i);
    const Thresholds limits{
        .maxP50Ms = 1000, .maxP99Ms = 1000, .maxAgeP99Ms = 1000, .maxAgeMs = 1000};
    EXPECT_THAT(violations(outcome, limits),
                ElementsAre(HasSubstr("input to frame p50 ms: 3998"),
                            HasSubstr("input to frame p99 ms: 8"), HasSubstr("frame age p99 ms: 8"),
                            "frame age max ms: 8990, more than 1000, 900 of them still open"));
    EXPECT_THAT(reportText({}, outcome), HasSubstr("; 900 inputs unanswered, waiting 4"));
    const auto json = reportJson({}, outcome, {}).at("kinds").at("orbit");
    EXPECT_EQ(json.at("unanswered").to_number<int>(), 900);
    EXPECT_EQ(json.at("unanswered_ms").at("max").to_number<double>(), 8990);
    EXPECT_EQ(json.at("input_to_frame_ms").at("count").to_number<int>(), 100);
}

// Sent a moment before the end: no longer than the others took, and no reason to count those less.
TEST(Report, InputsOfTheLastMomentChangeNoQuantile) {
    Outcome outcome = twoViews();
    for (int i = 0; i < 100; ++i) outcome.kinds["orbit"].unanswered.add(1);
    EXPECT_THAT(violations(outcome, {.maxP50Ms = 51, .maxP95Ms = 96.5, .maxP99Ms = 100}),
                IsEmpty());
    EXPECT_THAT(violations(outcome, {.maxP50Ms = 49}),
                ElementsAre(HasSubstr("input to frame p50 ms: 50")));
}

TEST(Report, GrowthIsFromBeginToEnd) {
    Outcome outcome = twoViews();
    outcome.after.treeBytes += 3'000'000;
    outcome.after.treeThreads += 1;
    outcome.after.treeDescriptors += 2;
    outcome.after.rootCpuS += 5;
    const Thresholds kept{
        .maxServerCores = 0.5, .maxGrowthMb = 3, .maxGrowthDescriptors = 2, .maxGrowthThreads = 1};
    EXPECT_THAT(violations(outcome, kept), IsEmpty());
    const Thresholds broken{
        .maxServerCores = 0.4, .maxGrowthMb = 2, .maxGrowthDescriptors = 1, .maxGrowthThreads = 0};
    EXPECT_THAT(violations(outcome, broken),
                ElementsAre("server cores: 0.5, more than 0.4", "growth in MB: 3, more than 2",
                            "more descriptors: 2, more than 1", "more threads: 1, more than 0"));
}

TEST(Report, SaysTheSameInTextAndJson) {
    Outcome outcome = twoViews();
    outcome.after.rootCpuS += 1;
    outcome.after.childrenCpuS += 3;
    const std::string text = reportText({}, outcome);
    EXPECT_THAT(text, HasSubstr("2 views move: 8.0 to 10.0 frames/s, fairness 0.80"));
    EXPECT_THAT(text, HasSubstr("streaming is 25 % of both"));
    const auto json = reportJson({}, outcome, {});
    EXPECT_EQ(json.at("views_that_move").at("fairness").to_number<double>(), 0.8);
    EXPECT_EQ(json.at("server").at("streaming_share").to_number<double>(), 0.25);
    EXPECT_EQ(json.at("server").at("start").at("threads_with_workers").to_number<int>(), 12);
    EXPECT_EQ(json.at("kinds").at("orbit").at("input_to_frame_ms").at("count").to_number<int>(),
              100);
}

}  // namespace
}  // namespace volcast::load
