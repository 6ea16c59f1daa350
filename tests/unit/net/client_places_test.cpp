#include "server/net/client_places.h"

#include <gmock/gmock.h>

namespace volcast::net {
namespace {

using testing::HasSubstr;
using testing::Optional;

ClientPlaces::Address at(const char* text) {
    return boost::asio::ip::make_address(text);
}

TEST(ClientPlaces, OneAddressHasItsShareAndOthersTheirs) {
    ClientPlaces places{10, 2};
    EXPECT_FALSE(places.take(at("192.0.2.1")));
    EXPECT_FALSE(places.take(at("192.0.2.1")));
    EXPECT_THAT(places.take(at("192.0.2.1")),
                Optional(HasSubstr("your address has 2 clients here, the most that one address may "
                                   "have (--max-clients-per-address)")));
    EXPECT_FALSE(places.take(at("192.0.2.2")));
    EXPECT_EQ(places.taken(), 3U);
    places.giveBack(at("192.0.2.1"));
    EXPECT_FALSE(places.take(at("192.0.2.1")));
    EXPECT_TRUE(places.take(at("192.0.2.1")));
}

TEST(ClientPlaces, AllTogetherHaveNoMoreThanThereAre) {
    ClientPlaces places{2, 2};
    EXPECT_FALSE(places.take(at("192.0.2.1")));
    EXPECT_FALSE(places.take(at("127.0.0.1")));
    EXPECT_THAT(places.take(at("192.0.2.2")), Optional(HasSubstr("2 clients, the most that it")));
    places.giveBack(at("127.0.0.1"));
    EXPECT_FALSE(places.take(at("192.0.2.2")));
}

// A proxy of this machine brings everybody's.
TEST(ClientPlaces, ThisMachineHasAsManyAsThereAre) {
    for (const char* loopback : {"127.0.0.1", "127.1.2.3", "::1", "::ffff:127.0.0.1"}) {
        ClientPlaces places{3, 1};
        for (int i = 0; i < 3; ++i) EXPECT_FALSE(places.take(at(loopback))) << loopback;
        EXPECT_THAT(places.take(at(loopback)), Optional(HasSubstr("--max-clients)")));
    }
}

TEST(ClientPlaces, ANetworkOf64BitsIsOneAddress) {
    ClientPlaces places{10, 1};
    EXPECT_FALSE(places.take(at("2001:db8:1:2::1")));
    EXPECT_TRUE(places.take(at("2001:db8:1:2:3:4:5:6")));
    EXPECT_FALSE(places.take(at("2001:db8:1:3::1")));
    EXPECT_FALSE(places.take(at("192.0.2.1")));
    EXPECT_TRUE(places.take(at("::ffff:192.0.2.1")));
}

TEST(ClientPlaces, WithoutAShareOneMayHaveAll) {
    ClientPlaces places{2, 0};
    EXPECT_FALSE(places.take(at("192.0.2.1")));
    EXPECT_FALSE(places.take(at("192.0.2.1")));
    places.giveBack(at("192.0.2.1"));
    EXPECT_FALSE(places.take(at("192.0.2.1")));
}

}  // namespace
}  // namespace volcast::net
