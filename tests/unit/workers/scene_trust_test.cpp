#include "server/workers/scene_trust.h"

#include <gtest/gtest.h>

namespace volcast::workers {
namespace {

using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;
const SceneTrust::Clock::time_point kNow{std::chrono::hours{1}};

TEST(SceneTrust, PausesFromTheSecondSceneOnAndForLongerEachTime) {
    SceneTrust trust;
    EXPECT_EQ(trust.pause(kNow), seconds{0});
    trust.tookDownWorkers(kNow);
    EXPECT_EQ(trust.pause(kNow), seconds{0});
    for (const int expected : {30, 60, 120, 240, 480, 600, 600}) {
        trust.tookDownWorkers(kNow);
        EXPECT_EQ(trust.pause(kNow), seconds{expected});
    }
    for (int i = 0; i < 100; ++i) trust.tookDownWorkers(kNow);
    EXPECT_EQ(trust.pause(kNow), seconds{600});
    EXPECT_EQ(trust.pause(kNow + milliseconds{599'001}), seconds{1});
    EXPECT_EQ(trust.pause(kNow + seconds{600}), seconds{0});
}

TEST(SceneTrust, ForgivesTenMinutesAfterThePause) {
    SceneTrust trust;
    trust.tookDownWorkers(kNow);
    trust.tookDownWorkers(kNow + minutes{9});
    EXPECT_EQ(trust.pause(kNow + minutes{9}), seconds{30});
    SceneTrust patient = trust;
    patient.tookDownWorkers(kNow + minutes{19});
    EXPECT_EQ(patient.pause(kNow + minutes{19}), seconds{60});
    trust.tookDownWorkers(kNow + minutes{20});
    EXPECT_EQ(trust.pause(kNow + minutes{20}), seconds{0});
    EXPECT_EQ(trust.scenes(), 1);
}

}  // namespace
}  // namespace volcast::workers
