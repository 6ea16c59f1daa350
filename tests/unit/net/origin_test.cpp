#include "server/net/origin.h"

#include <gtest/gtest.h>

namespace volcast::net {
namespace {

const OriginRule kLocal{.allowed = {}, .loopbackOnly = true};
const OriginRule kPublic{.allowed = {"https://lab.example.org"}, .loopbackOnly = false};

TEST(Origin, ScriptsWithoutAnOriginMayConnect) {
    EXPECT_TRUE(originAllowed("", "127.0.0.1:8080", kLocal));
}

TEST(Origin, TheServersOwnPagesMayConnect) {
    EXPECT_TRUE(originAllowed("http://127.0.0.1:8080", "127.0.0.1:8080", kLocal));
    EXPECT_TRUE(originAllowed("http://localhost:8080", "LOCALHOST:8080", kLocal));
    EXPECT_TRUE(originAllowed("http://[::1]:8080", "[::1]:8080", kLocal));
    EXPECT_TRUE(originAllowed("https://volcast.example.org", "volcast.example.org", kPublic));
}

TEST(Origin, OtherPagesMayNot) {
    EXPECT_FALSE(originAllowed("http://evil.example", "127.0.0.1:8080", kLocal));
    EXPECT_FALSE(originAllowed("http://127.0.0.1:9", "127.0.0.1:8080", kLocal));
    EXPECT_FALSE(originAllowed("http://127.0.0.1:8080.evil.example", "127.0.0.1:8080", kLocal));
    EXPECT_FALSE(originAllowed("null", "127.0.0.1:8080", kLocal));
    EXPECT_FALSE(originAllowed("null", "null", kPublic));
}

TEST(Origin, ListedPagesMay) {
    EXPECT_TRUE(originAllowed("https://lab.example.org", "10.0.0.1:8080", kPublic));
    EXPECT_FALSE(originAllowed("https://lab.example.org.evil.example", "10.0.0.1", kPublic));
    EXPECT_TRUE(originAllowed("http://a.example", "x", {.allowed = {"*"}, .loopbackOnly = true}));
}

// A hostile name that resolves to 127.0.0.1 has equal Origin and Host.
TEST(Origin, ANameReboundToTheLoopbackIsNotTheSameOrigin) {
    EXPECT_FALSE(originAllowed("http://evil.example:8080", "evil.example:8080", kLocal));
    EXPECT_FALSE(originAllowed("http://127.evil.example", "127.evil.example", kLocal));
}

}  // namespace
}  // namespace volcast::net
