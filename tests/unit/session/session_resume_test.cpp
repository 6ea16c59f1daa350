// Coming back after a lost connection, or to another server.
#include "tests/support/temporary_folder.h"
#include "tests/unit/session/session_people_fixture.h"

namespace volcast::session {
namespace {

using test::SessionClient;
using test::SessionPeople;
using test::TestServer;

TEST_F(SessionPeople, WhoLosesTheConnectionComesBackToEverything) {
    const auto ben = join("Ben", v1::ROLE_WATCH);
    ann->look(7, 5.0);
    ann.reset();
    const auto away = ben->wait(
        [](const auto& one) { return one.has_people() && one.people().people(0).away(); });
    ASSERT_TRUE(away.has_value());
    EXPECT_TRUE(away->people().people(0).steers()) << "control is kept";
    ann = server.client();
    ann->hello({}, welcome.resume());
    const auto again = ann->wait(hasWelcome);
    ASSERT_TRUE(again.has_value());
    EXPECT_TRUE(again->welcome().resumed());
    EXPECT_EQ(again->welcome().person(), welcome.person());
    EXPECT_NE(again->welcome().resume(), welcome.resume());
    const auto back = ann->wait(hasOpened);
    ASSERT_TRUE(back.has_value());
    EXPECT_EQ(back->view_opened().view(), 1U);
    EXPECT_EQ(back->view_opened().id(), opened->view_opened().id());
    EXPECT_EQ(back->view_opened().input_seq(), 7U);
    EXPECT_EQ(back->view_opened().role(), v1::ROLE_CONTROL);
    EXPECT_EQ(back->view_opened().scene().camera().eye().x(), 5.0);
    EXPECT_TRUE(back->view_opened().can_undo());
    ann->look(8, 6.0);
    EXPECT_EQ(ben->sceneChanged()->camera().eye().x(), 6.0);
}

TEST_F(SessionPeople, AResumeTokenIsGoodOnce) {
    ann.reset();
    const auto back = server.client();
    back->hello({}, welcome.resume());
    ASSERT_TRUE(back->wait(hasWelcome)->welcome().resumed());
    back->setName("Ann");  // Any message shows that the welcome with the next token came.
    const auto thief = server.client();
    thief->hello("Thief", welcome.resume());
    const auto refused = thief->error();
    ASSERT_TRUE(refused.has_value());
    EXPECT_EQ(refused->code(), v1::ERROR_CODE_NOT_PERMITTED);
    EXPECT_EQ(refused->field(), "hello.resume");
    EXPECT_FALSE(thief->wait(hasWelcome)->welcome().resumed());
    EXPECT_FALSE(back->session->closing().has_value()) << "a replay ends nobody's connection";
}

TEST_F(SessionPeople, WhoseWelcomeWasLostComesBackWithTheSameToken) {
    ann.reset();
    const auto lost = server.client();
    lost->hello({}, welcome.resume());  // Its welcome is never read.
    const auto back = server.client();
    back->hello({}, welcome.resume());
    const auto again = back->wait(hasWelcome);
    ASSERT_TRUE(again->welcome().resumed());
    EXPECT_EQ(again->welcome().person(), welcome.person());
    ASSERT_TRUE(back->wait(hasOpened).has_value());
    for (int i = 0; i < 100 && !lost->session->closing(); ++i) lost->run();
    ASSERT_TRUE(lost->session->closing().has_value()) << "two connections hold one person";
    EXPECT_EQ(lost->session->closing()->code, 4001);
    back->look(2, 3.0);
    back->undo();
    EXPECT_TRUE(back->sceneChanged().has_value()) << "it does not steer";
    const auto thief = server.client();
    thief->hello("Thief", welcome.resume());
    EXPECT_FALSE(thief->wait(hasWelcome)->welcome().resumed());
}

TEST_F(SessionPeople, WhosePlaceWasTakenOrWhoseViewEndedIsToldWhich) {
    const auto hello = [&](const std::string& name, const std::string& resume = {}) {
        auto client = server.client();
        client->hello(name, resume);
        return client;
    };
    auto ben = hello("Ben");
    const std::string token = ben->wait(hasWelcome)->welcome().resume();
    ben->openView(ann->share(v1::ROLE_WATCH));
    ASSERT_TRUE(ben->wait(hasOpened).has_value());
    ben->openView({}, 2);
    ASSERT_TRUE(ben->wait(hasOpened).has_value());
    ben.reset();
    const auto cy = join("Cy", v1::ROLE_WATCH), di = join("Di", v1::ROLE_WATCH),
               ed = join("Ed", v1::ROLE_WATCH);        // Four may be in it.
    for (std::uint32_t view = 2; view <= 3; ++view) {  // Three may be open.
        ann->openView({}, view);
        ASSERT_TRUE(ann->wait(hasOpened).has_value());
    }
    ben = hello({}, token);
    ASSERT_TRUE(ben->wait(hasWelcome)->welcome().resumed());
    const auto full = ben->error(), ended = ben->error();
    ASSERT_TRUE(full && ended);
    EXPECT_EQ(full->view(), 1U);
    EXPECT_NE(full->message().find("full (--max-people)"), std::string::npos) << full->message();
    EXPECT_EQ(ended->view(), 2U);
    EXPECT_EQ(ended->message(), "view 2 has ended meanwhile");
}

// A network that went away without a word: the server still holds the old connection.
TEST_F(SessionPeople, ResumingEndsTheConnectionThatWasThoughtAlive) {
    const auto back = server.client();
    back->hello({}, welcome.resume());
    ASSERT_TRUE(back->wait(hasOpened).has_value());
    ann->look(2, 9.0);  // Of the old connection: too late.
    EXPECT_TRUE(back->never([](const auto& one) { return one.has_scene_changed(); }));
    for (int i = 0; i < 100 && !ann->session->closing(); ++i) ann->run();
    ASSERT_TRUE(ann->session->closing().has_value());
    EXPECT_EQ(ann->session->closing()->code, 4001);
    ann.reset();
    back->look(2, 3.0);
    back->undo();
    EXPECT_TRUE(back->sceneChanged().has_value()) << "it does not steer";
}

TEST_F(SessionPeople, ATokenOfAConnectionThatEndedLongAgoIsRefused) {
    TestServer brief{key, std::chrono::seconds{0}};
    auto client = brief.client();
    client->hello("Brief");
    const auto token = client->wait(hasWelcome)->welcome().resume();
    client->openView();
    ASSERT_TRUE(client->wait(hasOpened).has_value());
    client.reset();
    const auto back = brief.client();
    back->hello({}, token);
    EXPECT_EQ(back->error()->code(), v1::ERROR_CODE_NOT_PERMITTED);
}

TEST(SavedViews, ComeBackInAnotherServerWithLinksAndTokens) {
    const support::TemporaryFolder folder;
    const LinkKey key = *LinkKey::random();
    std::string token, link, id;
    {
        TestServer server{key, std::chrono::seconds{60},
                          *StateFolder::create(folder.path().string())};
        auto ann = server.client();
        ann->hello("Ann");
        token = ann->wait([](const auto& one) { return one.has_welcome(); })->welcome().resume();
        ann->openView({}, 1, 33);
        id = ann->wait([](const auto& one) { return one.has_view_opened(); })->view_opened().id();
        ann->look(9, 4.5);
        link = ann->share(v1::ROLE_WATCH);
        ann.reset();
    }
    TestServer server{key, std::chrono::seconds{60}, *StateFolder::create(folder.path().string())};
    const auto ben = server.client();
    ben->hello("Ben");
    ben->openView(link);
    const auto joined = ben->wait([](const auto& one) { return one.has_view_opened(); });
    ASSERT_TRUE(joined.has_value());
    EXPECT_EQ(joined->view_opened().role(), v1::ROLE_WATCH);
    EXPECT_EQ(joined->view_opened().scene().camera().eye().x(), 4.5);
    const auto ann = server.client();
    ann->hello({}, token);
    const auto welcome = ann->wait([](const auto& one) { return one.has_welcome(); });
    EXPECT_TRUE(welcome->welcome().resumed());
    const auto back = ann->wait([](const auto& one) { return one.has_view_opened(); });
    ASSERT_TRUE(back.has_value());
    EXPECT_EQ(back->view_opened().id(), id);
    EXPECT_EQ(back->view_opened().input_seq(), 9U);
    EXPECT_EQ(back->view_opened().role(), v1::ROLE_CONTROL);
    EXPECT_TRUE(ann->people(2, "Ann").has_value());
    const auto other = server.client();
    other->hello("Other");
    EXPECT_NE(other->wait([](const auto& one) { return one.has_welcome(); })->welcome().person(),
              welcome->welcome().person());
}

}  // namespace
}  // namespace volcast::session
