#include "server/workers/gpu_trust.h"

#include <gtest/gtest.h>

namespace volcast::workers {
namespace {

using std::chrono::minutes;
const GpuTrust::Clock::time_point kNow{};

TEST(GpuTrust, EndsWithTheThirdLossWithinTenMinutes) {
    GpuTrust trust;
    trust.lost(kNow);
    trust.lost(kNow + minutes{4});
    EXPECT_FALSE(trust.isLost(kNow + minutes{4}));
    trust.lost(kNow + minutes{11});  // The first is forgiven.
    EXPECT_FALSE(trust.isLost(kNow + minutes{11}));
    trust.lost(kNow + minutes{12});
    EXPECT_TRUE(trust.isLost(kNow + minutes{12}));
}

TEST(GpuTrust, APictureThatTakesWorkersDownCostsTheGpuNothing) {
    GpuTrust trust;
    for (std::uint64_t view = 1; view < 9; ++view) {
        trust.lostOver(view, kNow);
        trust.lostOver(view, kNow);
        trust.forget(view);  // Given up.
        trust.drew(view);    // The one before it is drawn again.
    }
    EXPECT_FALSE(trust.isLost(kNow));
}

TEST(GpuTrust, APictureThatTheNextWorkerDrawsWasNotToBlame) {
    GpuTrust trust;
    for (std::uint64_t view = 1; view < 4; ++view) {
        EXPECT_FALSE(trust.isLost(kNow));
        trust.lostOver(view, kNow);
        EXPECT_FALSE(trust.isLost(kNow));
        trust.drew(view);
    }
    EXPECT_TRUE(trust.isLost(kNow));
}

}  // namespace
}  // namespace volcast::workers
