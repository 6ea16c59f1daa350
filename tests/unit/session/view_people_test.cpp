#include "server/session/view_people.h"

#include <gtest/gtest.h>

namespace volcast::session {
namespace {

class ViewPeopleTest : public testing::Test {
protected:
    void SetUp() override {
        people.add(1, {.person = 11, .name = "Ann", .role = v1::ROLE_CONTROL, .number = 1});
        people.add(2, {.person = 12, .name = "Ben", .role = v1::ROLE_CONTROL, .number = 1});
        people.add(3, {.person = 13, .name = "Cy", .role = v1::ROLE_WATCH, .number = 1});
    }
    ViewPeople people;
    const TimePoint now{std::chrono::hours{1}};
};

TEST_F(ViewPeopleTest, TheFirstWhoMaySteersAloneAndTheRestIsToldWhy) {
    EXPECT_EQ(people.whyNotSteering(1), "");
    EXPECT_EQ(people.whyNotSteering(2), "Ann steers this view; take control first");
    EXPECT_EQ(people.whyNotSteering(3), "you may watch this view but not steer it");
}

TEST_F(ViewPeopleTest, ControlIsTakenByThoseWhoMay) {
    EXPECT_NE(people.take(3), "");
    EXPECT_TRUE(people.steers(1));
    EXPECT_EQ(people.take(2), "");
    EXPECT_TRUE(people.steers(2));
    EXPECT_FALSE(people.steers(1));
}

TEST_F(ViewPeopleTest, WhoHasTheViewTwiceMayDoTheSameInBothAndSteersInOne) {
    people.add(4, {.person = 12, .name = "Ben", .role = v1::ROLE_WATCH, .number = 2});
    EXPECT_EQ(people.take(4), "");
    EXPECT_TRUE(people.steers(4));
    EXPECT_FALSE(people.steers(2));
    people.add(5, {.person = 13, .name = "Cy", .role = v1::ROLE_WATCH, .number = 2});
    EXPECT_NE(people.take(5), "") << "a watcher twice is a watcher";
}

TEST_F(ViewPeopleTest, AWatcherWhoAddsALinkToControlMaySteerFromTheFirstPlaceToo) {
    EXPECT_NE(people.take(3), "");
    people.add(4, {.person = 13, .name = "Cy", .role = v1::ROLE_CONTROL, .number = 2});
    for (const ViewerId place : {3U, 4U}) EXPECT_EQ(people.at(place).role, v1::ROLE_CONTROL);
    EXPECT_EQ(people.take(3), "");
    EXPECT_TRUE(people.steers(3));
}

TEST_F(ViewPeopleTest, WhoIsHandedControlMaySteerFromEachPlaceAndAsksInNone) {
    people.add(4, {.person = 13, .name = "Cy", .role = v1::ROLE_WATCH, .number = 2});
    EXPECT_EQ(people.ask(4, false), "");
    EXPECT_EQ(people.handOver(1, 13), "");
    EXPECT_TRUE(people.steers(3));
    for (const ViewerId place : {3U, 4U}) {
        EXPECT_EQ(people.at(place).role, v1::ROLE_CONTROL) << place;
        EXPECT_FALSE(people.at(place).asks) << place;
    }
    EXPECT_NE(people.ask(4, false), "") << "steers from the other place";
    EXPECT_EQ(people.take(4), "");
}

TEST_F(ViewPeopleTest, WhoAsksFromTwoPlacesWithdrawsOrSteersForBoth) {
    people.add(4, {.person = 12, .name = "Ben", .role = v1::ROLE_CONTROL, .number = 2});
    for (const ViewerId place : {2U, 4U}) EXPECT_EQ(people.ask(place, false), "");
    EXPECT_EQ(people.ask(4, true), "");
    EXPECT_FALSE(people.at(2).asks);
    EXPECT_EQ(people.ask(2, false), "");
    EXPECT_EQ(people.take(4), "");
    EXPECT_FALSE(people.at(2).asks);
}

TEST_F(ViewPeopleTest, ControlIsHandedToThePlaceOfAPersonThatIsNotAway) {
    people.add(4, {.person = 13, .name = "Cy", .role = v1::ROLE_WATCH, .number = 2});
    people.away(3, now);
    EXPECT_EQ(people.handOver(1, 13), "");
    EXPECT_TRUE(people.steers(4));
}

TEST_F(ViewPeopleTest, OnlyWhoSteersHandsOverAndAWatcherMaySteerByIt) {
    EXPECT_NE(people.handOver(2, 12), "");
    EXPECT_NE(people.handOver(3, 13), "");
    EXPECT_NE(people.handOver(1, 99), "");
    EXPECT_TRUE(people.steers(1));
    EXPECT_EQ(people.handOver(1, 13), "");
    EXPECT_TRUE(people.steers(3));
    EXPECT_EQ(people.at(3).role, v1::ROLE_CONTROL);
    EXPECT_EQ(people.take(1), "") << "who handed over may take control back";
}

TEST_F(ViewPeopleTest, WhoAsksIsSeenUntilTheySteerOrWithdraw) {
    EXPECT_NE(people.ask(1, false), "") << "who steers need not ask";
    EXPECT_EQ(people.ask(3, false), "");
    EXPECT_TRUE(people.message(1).people(2).asks());
    EXPECT_FALSE(people.steers(3)) << "asking is not getting";
    EXPECT_EQ(people.ask(3, true), "");
    EXPECT_FALSE(people.message(1).people(2).asks());
    EXPECT_EQ(people.ask(3, false), "");
    EXPECT_EQ(people.handOver(1, 13), "");
    EXPECT_FALSE(people.message(1).people(2).asks());
}

TEST_F(ViewPeopleTest, ControlGoesOnWhenWhoSteersLeaves) {
    people.remove(1);
    EXPECT_TRUE(people.steers(2));
    people.remove(2);
    EXPECT_EQ(people.steering(), 0U) << "a watcher steers";
    people.add(4, {.person = 14, .name = "Di", .role = v1::ROLE_CONTROL});
    EXPECT_TRUE(people.steers(4));
}

TEST_F(ViewPeopleTest, WhoIsAwayKeepsControlUntilTheTimeIsOver) {
    people.away(1, now + std::chrono::seconds{60});
    EXPECT_TRUE(people.message(1).people(0).away());
    EXPECT_TRUE(people.steers(1));
    EXPECT_EQ(people.handOver(1, 11), "Ann is away");
    EXPECT_FALSE(people.expire(now + std::chrono::seconds{59}));
    EXPECT_EQ(people.firstExpiry(), now + std::chrono::seconds{60});
    EXPECT_TRUE(people.expire(now + std::chrono::seconds{60}));
    EXPECT_TRUE(people.steers(2));
    EXPECT_EQ(people.message(1).people_size(), 2);
}

TEST_F(ViewPeopleTest, WhoIsAwayMakesRoomButNotWhoSteers) {
    people.away(1, now);
    EXPECT_FALSE(people.removeOneAway());
    people.away(3, now + std::chrono::seconds{2});
    people.away(2, now + std::chrono::seconds{1});
    EXPECT_TRUE(people.removeOneAway());
    EXPECT_FALSE(people.all().contains(2));
    EXPECT_TRUE(people.all().contains(3));
}

TEST_F(ViewPeopleTest, WhoComesBackIsWhoTheyWere) {
    people.away(1, now);
    EXPECT_EQ(people.find(11, 1), ViewerId{1});
    EXPECT_FALSE(people.find(11, 2).has_value());
    people.comeBack(1, 9);
    EXPECT_TRUE(people.steers(9));
    EXPECT_FALSE(people.expire(now + std::chrono::hours{1}));
    EXPECT_EQ(people.at(9).name, "Ann");
}

}  // namespace
}  // namespace volcast::session
