// Several people in one view: links, roles, who steers, undo.
#include "tests/unit/session/session_people_fixture.h"

namespace volcast::session {
namespace {

using test::SessionClient;
using test::SessionPeople;

TEST_F(SessionPeople, WhoOpensAViewSteersIt) {
    EXPECT_EQ(opened->view_opened().role(), v1::ROLE_CONTROL);
    EXPECT_EQ(opened->view_opened().id().size(), 22U) << "128 bits";
    EXPECT_EQ(opened->view_opened().input_seq(), 1U);
    const auto people = ann->people(1, "Ann");
    ASSERT_TRUE(people.has_value());
    EXPECT_EQ(people->people(0).id(), welcome.person());
}

TEST_F(SessionPeople, NamelessPeopleAreGuestsAndLongNamesAreRefused) {
    const auto guest = server.client();
    guest->hello();
    guest->openView(ann->share(v1::ROLE_WATCH));
    const auto people = guest->people(2, "Ann");
    ASSERT_TRUE(people.has_value());
    EXPECT_EQ(people->people(1).name(), "Guest 2");
    const auto chatty = server.client();
    chatty->hello(std::string(65, 'x'));
    EXPECT_EQ(chatty->error()->field(), "hello.person");
    EXPECT_TRUE(chatty->session->closing().has_value());
}

TEST_F(SessionPeople, AWatcherSeesTheCameraMoveButMayNotMoveIt) {
    const auto ben = join("Ben", v1::ROLE_WATCH);
    ann->look(2, 5.0);
    const auto changed = ben->sceneChanged();
    ASSERT_TRUE(changed.has_value());
    EXPECT_EQ(changed->input_seq(), 2U);
    EXPECT_EQ(changed->person(), welcome.person());
    EXPECT_EQ(changed->camera().eye().x(), 5.0);
    EXPECT_FALSE(changed->has_scene()) << "the camera alone moved";
    EXPECT_TRUE(changed->can_undo());
    EXPECT_TRUE(ann->never([](const auto& one) { return one.has_scene_changed(); }));

    ben->look(9, 7.0);
    const auto refused = ben->error();
    ASSERT_TRUE(refused.has_value());
    EXPECT_EQ(refused->code(), v1::ERROR_CODE_NOT_PERMITTED);
    EXPECT_EQ(refused->input_seq(), 9U);
    const auto asItIs = ben->sceneChanged();
    ASSERT_TRUE(asItIs.has_value()) << "who is refused hears what the view shows";
    EXPECT_EQ(asItIs->scene().camera().eye().x(), 5.0);
    EXPECT_EQ(asItIs->input_seq(), 2U);
    ben->undo();
    EXPECT_EQ(ben->error()->code(), v1::ERROR_CODE_NOT_PERMITTED);
    EXPECT_TRUE(ann->never([](const auto& one) { return one.has_scene_changed(); }));
}

// Role escalation: nothing that a watcher can send makes them steer.
TEST_F(SessionPeople, AWatcherCannotGetControlByThemselves) {
    const auto ben = join("Ben", v1::ROLE_WATCH);
    ben->takeControl();
    EXPECT_EQ(ben->error()->code(), v1::ERROR_CODE_NOT_PERMITTED);
    for (const v1::Role role : {v1::ROLE_WATCH, v1::ROLE_CONTROL}) EXPECT_EQ(ben->share(role), "");
    const auto people = ann->people(2, "Ann");
    ASSERT_TRUE(people.has_value());
    ben->handOver(people->people(1).id());
    EXPECT_EQ(ben->error()->code(), v1::ERROR_CODE_NOT_PERMITTED);
    ben->look(50, 3.0);
    EXPECT_EQ(ben->error()->code(), v1::ERROR_CODE_NOT_PERMITTED);
    EXPECT_TRUE(ann->never([](const auto& one) { return one.has_people(); })) << "nothing changed";
}

TEST_F(SessionPeople, ControlIsTakenAndTheNewInputsCount) {
    const auto ben = join("Ben", v1::ROLE_CONTROL);
    ann->look(40, 5.0);
    ben->takeControl();
    const auto changed = ben->wait(
        [](const auto& one) { return one.has_scene_changed() && one.scene_changed().has_scene(); });
    ASSERT_TRUE(changed.has_value());
    EXPECT_EQ(changed->scene_changed().input_seq(), 40U);
    EXPECT_EQ(changed->scene_changed().scene().camera().eye().x(), 5.0);
    ASSERT_TRUE(ann->people(2, "Ben").has_value());
    ann->look(41, 6.0);
    const auto refused = ann->error();
    ASSERT_TRUE(refused.has_value());
    EXPECT_EQ(refused->code(), v1::ERROR_CODE_NOT_PERMITTED);
    EXPECT_EQ(refused->message(), "Ben steers this view; take control first");
    const auto instead = ann->sceneChanged();
    ASSERT_TRUE(instead.has_value());
    EXPECT_EQ(instead->scene().camera().eye().x(), 5.0);
    ben->look(41, 7.0);
    EXPECT_EQ(ann->sceneChanged()->camera().eye().x(), 7.0);
    ann->takeControl();
    EXPECT_TRUE(ben->people(2, "Ann").has_value());
}

TEST_F(SessionPeople, AWatcherWhoIsHandedControlSteers) {
    const auto ben = join("Ben", v1::ROLE_WATCH);
    const auto people = ann->people(2, "Ann");
    ASSERT_TRUE(people.has_value());
    ann->handOver(people->people(1).id());
    ASSERT_TRUE(ben->people(2, "Ben").has_value());
    ben->look(2, 8.0);
    EXPECT_EQ(ann->sceneChanged()->camera().eye().x(), 8.0);
    ann->handOver(99);
    EXPECT_EQ(ann->error()->code(), v1::ERROR_CODE_NOT_PERMITTED);
}

TEST_F(SessionPeople, AWatcherAsksForControlAndEverybodySeesIt) {
    const auto ben = join("Ben", v1::ROLE_WATCH);
    ben->askControl();
    const auto asks = [](const auto& one) {
        return one.has_people() && one.people().people_size() == 2 && one.people().people(1).asks();
    };
    EXPECT_TRUE(ann->wait(asks).has_value());
    ben->look(9, 7.0);
    EXPECT_EQ(ben->error()->code(), v1::ERROR_CODE_NOT_PERMITTED) << "asking is not getting";
    ann->askControl();
    EXPECT_EQ(ann->error()->message(), "you steer this view already");
    ben->askControl(true);
    EXPECT_TRUE(ann->wait([&](const auto& one) { return one.has_people() && !asks(one); }));
}

TEST_F(SessionPeople, ANameIsChangedForAllAndKeptByTheToken) {
    const auto ben = join("Ben", v1::ROLE_WATCH);
    ben->setName("Benjamin\n");
    const auto named = [](const std::string& name) {
        return [name](const auto& one) {
            return one.has_people() && one.people().people_size() == 2 &&
                   one.people().people(1).name() == name;
        };
    };
    EXPECT_TRUE(ann->wait(named("Benjamin?")).has_value()) << "no control characters";
    ben->setName("");
    EXPECT_TRUE(ann->wait(named("Guest 2")).has_value());
    ben->setName(std::string(65, 'x'));
    const auto refused = ben->error();
    EXPECT_EQ(refused->code(), v1::ERROR_CODE_LIMIT_EXCEEDED);
    EXPECT_EQ(refused->field(), "person");
    EXPECT_FALSE(ben->session->closing().has_value()) << "a refused name ends nothing";
}

TEST_F(SessionPeople, EachHasAViewportOfTheirOwn) {
    const auto ben = join("Ben", v1::ROLE_WATCH, 20);
    ASSERT_TRUE(server.render.has(server.render.requests, 1));
    v1::ClientMessage message;
    message.mutable_update()->set_view(1);
    message.mutable_update()->set_input_seq(2);
    message.mutable_update()->mutable_viewport()->set_width(30);
    message.mutable_update()->mutable_viewport()->set_height(30);
    ben->send(message);
    EXPECT_TRUE(ben->never([](const auto& one) { return one.has_error(); }));
    EXPECT_TRUE(ann->never([](const auto& one) { return one.has_scene_changed(); }));
    ann->look(2, 5.0);
    EXPECT_EQ(ben->sceneChanged()->input_seq(), 2U) << "a watcher's resize is no input of the view";
}

TEST_F(SessionPeople, LinksThatAreNoneAreRefused) {
    const auto ben = server.client();
    ben->hello("Ben");
    std::string link = ann->share(v1::ROLE_WATCH);
    link[4] = link[4] == 'A' ? 'B' : 'A';
    ben->openView(link);
    auto refused = ben->error();
    ASSERT_TRUE(refused.has_value());
    EXPECT_EQ(refused->code(), v1::ERROR_CODE_NOT_PERMITTED);
    EXPECT_EQ(refused->field(), "link");
    ben->openView(*signLink({.view = opened->view_opened().id(),
                             .role = v1::ROLE_CONTROL,
                             .expires = std::chrono::system_clock::now() - std::chrono::seconds{1}},
                            key));
    EXPECT_EQ(ben->error()->message(), "the link has expired");
    ben->openView(*signLink(
        {.view = "nothing", .expires = std::chrono::system_clock::now() + std::chrono::hours{1}},
        key));
    EXPECT_EQ(ben->error()->code(), v1::ERROR_CODE_NOT_FOUND);
    EXPECT_EQ(ann->share(v1::ROLE_WATCH, 31U * 24 * 3600), "") << "for more than 30 days";
    EXPECT_EQ(ann->share(v1::ROLE_UNSPECIFIED), "");
}

TEST_F(SessionPeople, AViewTakesSoManyPeopleAndAServerSoManyViews) {
    std::vector<std::unique_ptr<SessionClient>> others;
    for (int i = 0; i < 3; ++i) others.push_back(join("more", v1::ROLE_WATCH));
    const auto last = server.client();
    last->hello("last");
    last->openView(ann->share(v1::ROLE_WATCH));
    const auto full = last->error();
    ASSERT_TRUE(full.has_value());
    EXPECT_EQ(full->code(), v1::ERROR_CODE_LIMIT_EXCEEDED);
    EXPECT_NE(full->message().find("--max-people"), std::string::npos) << full->message();
    for (std::uint32_t view = 2; view <= 4; ++view) last->openView({}, view);
    const auto noMore = last->error();
    ASSERT_TRUE(noMore.has_value());
    EXPECT_EQ(noMore->code(), v1::ERROR_CODE_LIMIT_EXCEEDED);
    EXPECT_EQ(noMore->view(), 4U);
}

TEST_F(SessionPeople, WhatIsUndoneIsToldToAllAndTheOneWhoDidItNumbersOn) {
    const auto ben = join("Ben", v1::ROLE_WATCH);
    const double before = opened->view_opened().scene().camera().eye().x();
    for (std::uint64_t seq = 2; seq < 12; ++seq) ann->look(seq, static_cast<double>(seq));
    ann->undo();
    for (SessionClient* client : {ann.get(), ben.get()}) {
        const auto changed = client->wait([](const auto& one) {
            return one.has_scene_changed() && one.scene_changed().input_seq() == 12;
        });
        ASSERT_TRUE(changed.has_value());
        EXPECT_EQ(changed->scene_changed().scene().camera().eye().x(), before) << "one step";
        EXPECT_FALSE(changed->scene_changed().can_undo());
        EXPECT_TRUE(changed->scene_changed().can_redo());
    }
    ann->undo();
    EXPECT_EQ(ann->error()->message(), "there is nothing to undo");
    ann->undo(true);
    EXPECT_EQ(ann->sceneChanged()->scene().camera().eye().x(), 11.0);
}

TEST_F(SessionPeople, ManyWhoTakeControlAtOnceLeaveOneWhoSteers) {
    std::vector<std::unique_ptr<SessionClient>> others;
    for (int i = 0; i < 3; ++i) others.push_back(join("p" + std::to_string(i), v1::ROLE_CONTROL));
    std::vector<std::thread> threads;
    for (const auto& one : others) {
        threads.emplace_back([&one] {
            for (std::uint64_t seq = 2; seq < 40; ++seq) {
                one->takeControl();
                one->look(seq, static_cast<double>(seq));
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    ann->takeControl();
    const auto people = ann->people(4, "Ann");
    ASSERT_TRUE(people.has_value());
    int steering = 0;
    for (const v1::Person& person : people->people()) steering += person.steers() ? 1 : 0;
    EXPECT_EQ(steering, 1);
}

}  // namespace
}  // namespace volcast::session
