#include "server/session/message_rate.h"

#include <gtest/gtest.h>

namespace volcast::session {
namespace {

using std::chrono::milliseconds;

TEST(MessageRate, TakesASecondsWorthAtOnceAndThenAsMuchAsTimeGives) {
    MessageRate rate{10};
    const MessageRate::TimePoint start = std::chrono::steady_clock::now();
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(rate.take(start)) << i;
    EXPECT_FALSE(rate.take(start));
    EXPECT_FALSE(rate.take(start + milliseconds{99}));
    EXPECT_TRUE(rate.take(start + milliseconds{201}));
    EXPECT_TRUE(rate.take(start + milliseconds{202}));
    EXPECT_FALSE(rate.take(start + milliseconds{203}));
}

TEST(MessageRate, DoesNotSaveUpMoreThanASecond) {
    MessageRate rate{3};
    const MessageRate::TimePoint later = std::chrono::steady_clock::now() + std::chrono::hours{1};
    int taken = 0;
    while (rate.take(later)) ++taken;
    EXPECT_EQ(taken, 3);
}

}  // namespace
}  // namespace volcast::session
