#include "server/session/person_book.h"

#include <gtest/gtest.h>

namespace volcast::session {
namespace {

using std::chrono::seconds;

class PersonBookTest : public testing::Test {
protected:
    PersonBook::Arrival arrive(const std::string& name) {
        return *book.arrive(name, [this] { ++replaced; });
    }
    std::optional<PersonBook::Arrival> resume(const std::string& token) {
        const auto back = book.resume(
            token, [this] { ++replaced; }, now);
        return back ? std::optional{*back} : std::nullopt;
    }
    /// Was here, and lost the connection `ago`.
    PersonBook::Arrival away(const std::string& name, seconds ago, const std::string& view = {}) {
        auto one = arrive(name);
        if (!view.empty()) book.opened(one.person, 1, view);
        book.lost(one.person, one.visit, now + seconds{60} - ago);
        return one;
    }
    PersonBook book{*LinkKey::random(), 3};
    const TimePoint now{std::chrono::hours{1}};
    int replaced = 0;
};

TEST_F(PersonBookTest, ATokenIsGoodUntilTheConnectionItMadeHasTheNext) {
    const auto first = arrive("Ann");
    const auto second = resume(first.token);
    ASSERT_TRUE(second.has_value());
    const auto third = resume(first.token);
    ASSERT_TRUE(third.has_value());
    EXPECT_EQ(third->person, first.person);
    EXPECT_EQ(replaced, 2) << "each ends the one before it";
    EXPECT_FALSE(resume(second->token).has_value()) << "its welcome was lost";
    book.welcomed(third->person, second->visit);  // Of a connection that was replaced.
    const auto fourth = resume(first.token);
    ASSERT_TRUE(fourth.has_value());
    book.welcomed(fourth->person, fourth->visit);
    EXPECT_FALSE(resume(first.token).has_value());
    EXPECT_TRUE(resume(fourth->token).has_value());
}

TEST_F(PersonBookTest, TheNextTokenEndsTheOneBefore) {
    const auto first = arrive("Ann");
    const auto second = resume(first.token);
    ASSERT_TRUE(resume(second->token).has_value());
    EXPECT_FALSE(resume(first.token).has_value());
    EXPECT_TRUE(resume(second->token).has_value()) << "its connection said nothing yet";
}

TEST_F(PersonBookTest, HasALimitThatThoseWithoutAViewMakeRoomForFirst) {
    const auto views = away("views", seconds{30}, "v");
    const auto lately = away("lately", seconds{1});
    const auto before = away("before", seconds{20});
    arrive("one");
    EXPECT_EQ(book.size(), 3U);
    EXPECT_FALSE(resume(before.token).has_value());
    arrive("two");
    EXPECT_FALSE(resume(lately.token).has_value());
    EXPECT_TRUE(resume(views.token).has_value());
    arrive("three");
    EXPECT_EQ(book.size(), 4U) << "who is connected is never forgotten";
}

TEST_F(PersonBookTest, WhoOnlyConnectsAndLeavesDoesNotFillIt) {
    for (int i = 0; i < 1000; ++i) away("x", seconds{0});
    EXPECT_EQ(book.size(), 3U);
    const auto last = away("last", seconds{0});
    EXPECT_TRUE(resume(last.token).has_value());
    book.expire(now + seconds{60});
    EXPECT_EQ(book.size(), 1U);
}

TEST_F(PersonBookTest, WhoWasRestoredComesBackWithTheTokenThatWasSaved) {
    const LinkKey key = *LinkKey::random();
    PersonBook before{key}, after{key};
    const auto ann = *before.arrive("Ann", {});
    for (const std::uint32_t number : {1U, 2U}) {
        after.restore(ann.person, "Ann", before.tokenHash(ann.person), number, "v",
                      now + seconds{60});
    }
    const auto back = after.resume(ann.token, {}, now);
    ASSERT_TRUE(back.has_value());
    EXPECT_EQ(back->views.size(), 2U);
}

}  // namespace
}  // namespace volcast::session
