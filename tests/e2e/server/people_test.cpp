// Several clients in one view, over real sockets.
#include <cmath>

#include "tests/e2e/server/shared_server.h"

namespace volcast::test {
namespace {

v1::Hello named(const std::string& person, const std::string& resume = {}) {
    v1::Hello hello;
    hello.set_person(person);
    hello.set_resume(resume);
    return hello;
}

std::unique_ptr<TestClient> clientOf(std::uint16_t port, const v1::Hello& hello) {
    return std::make_unique<TestClient>(port, TestClient::Form::kBinary, WsOptions{}, hello);
}

class People : public SharedServer {
protected:
    /// Ann's view of good.node, drawn once.
    void SetUp() override {
        SharedServer::SetUp();
        ann = clientOf(port(), named("Ann"));
        ASSERT_TRUE(ann->ok());
        ann->openView(1, "good.node");
        ASSERT_TRUE(ann->waitForFrame(1, 1).has_value()) << server().log();
    }
    std::unique_ptr<TestClient> join(const std::string& name, v1::Role role) {
        auto client = clientOf(port(), named(name));
        client->join(ann->share(1, role));
        return client;
    }
    std::unique_ptr<TestClient> ann;
};

TEST_F(People, TwoClientsSeeTheSamePicturesOfOneView) {
    const auto ben = join("Ben", v1::ROLE_WATCH);
    ASSERT_TRUE(ben->waitForOpened().has_value()) << server().log();
    for (const std::uint64_t seq : {5U, 6U}) {
        ann->look(1, seq, 0.3 * static_cast<double>(seq));
        const auto mine = ann->waitForLossless(1, seq), theirs = ben->waitForLossless(1, seq);
        ASSERT_TRUE(mine && theirs) << server().log();
        EXPECT_EQ(theirs->header.input_seq(), seq);
        EXPECT_EQ(mine->payload, theirs->payload);
        const auto changed = ben->waitFor([seq](const auto& one) {
            return one.has_scene_changed() && one.scene_changed().input_seq() == seq;
        });
        ASSERT_TRUE(changed.has_value());
        EXPECT_NEAR(changed->scene_changed().camera().eye().x(),
                    3 * std::cos(0.3 * static_cast<double>(seq)), 1e-12);
    }
}

TEST_F(People, AWatcherWhoNeverAcksLeavesTheOthersTheirFrames) {
    const auto slow = join("slow", v1::ROLE_WATCH), quick = join("quick", v1::ROLE_WATCH);
    slow->ackFrames(false);
    ASSERT_TRUE(slow->waitForFrame(1, 1) && quick->waitForFrame(1, 1)) << server().log();
    for (std::uint64_t seq = 2; seq <= 20; ++seq) {
        ann->look(1, seq, 0.1 * static_cast<double>(seq));
        ASSERT_TRUE(ann->waitForFrame(1, seq).has_value()) << seq;
        ASSERT_TRUE(quick->waitForFrame(1, seq).has_value()) << seq;
    }
    while (slow->read(std::chrono::milliseconds{50})) {
    }
    EXPECT_LE(slow->frames.size() + 1, 4U) << "more than its credits and probes allow";
    v1::ClientMessage ack;
    ack.mutable_ack()->set_view(1);
    ack.mutable_ack()->set_sequence(slow->frames.empty() ? 1 : slow->frames.back().prefix.sequence);
    slow->send(ack);
    slow->ackFrames(true);
    EXPECT_TRUE(slow->waitForLossless(1, 20).has_value()) << "it ends at the newest picture";
}

TEST_F(People, ManyWatchersGetTheVeryBytesOfOnePicture) {
    std::vector<std::unique_ptr<TestClient>> watchers;
    for (int i = 0; i < 20; ++i) watchers.push_back(join("w", v1::ROLE_WATCH));
    for (const auto& one : watchers) ASSERT_TRUE(one->waitForOpened().has_value());
    ann->look(1, 2, 1.0);
    const auto mine = ann->waitForLossless(1, 2);
    ASSERT_TRUE(mine.has_value());
    for (const auto& one : watchers) {
        const auto theirs = one->waitForLossless(1, 2);
        ASSERT_TRUE(theirs.has_value());
        EXPECT_EQ(theirs->payload, mine->payload);
    }
}

TEST_F(People, WhoSteersChangesAndOnlyTheirInputsCount) {
    const auto ben = join("Ben", v1::ROLE_CONTROL);
    ASSERT_TRUE(ben->waitForOpened().has_value());
    ann->look(1, 10, 0.2);
    v1::ClientMessage take;
    take.mutable_take_control()->set_view(1);
    ben->send(take);
    const auto told = ben->waitFor(
        [](const auto& one) { return one.has_scene_changed() && one.scene_changed().has_scene(); });
    ASSERT_TRUE(told.has_value());
    const std::uint64_t next = told->scene_changed().input_seq() + 1;
    ann->waitFor(
        [](const auto& one) { return one.has_people() && one.people().people(1).steers(); });
    ann->look(1, next + 5, 2.0);
    const auto refused = ann->waitForError();
    ASSERT_TRUE(refused.has_value());
    EXPECT_EQ(refused->code(), v1::ERROR_CODE_NOT_PERMITTED);
    ben->look(1, next, 1.2);
    const auto frame = ann->waitForLossless(1, next);
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(frame->header.input_seq(), next);
}

TEST_F(People, ALostConnectionGoesOnWhereItWas) {
    const auto token = [&] {
        const auto other = clientOf(port(), named("Cy"));
        other->openView(3, "good.node", 80, 60, 4);
        EXPECT_TRUE(other->waitForFrame(3, 4).has_value());
        other->look(3, 9, 0.7);
        EXPECT_TRUE(other->waitForFrame(3, 9).has_value());
        return other->waitForWelcome()->resume();
    }();  // The socket is closed without a word.
    const auto back = clientOf(port(), named("", token));
    const auto welcome = back->waitForWelcome();
    ASSERT_TRUE(welcome.has_value());
    EXPECT_TRUE(welcome->resumed());
    const auto opened = back->waitForOpened(3);
    ASSERT_TRUE(opened.has_value());
    EXPECT_EQ(opened->input_seq(), 9U);
    const auto frame = back->waitForFrame(3, 9);
    ASSERT_TRUE(frame.has_value()) << server().log();
    EXPECT_EQ(frame->header.width(), 80U);
    EXPECT_EQ(frame->prefix.sequence, 1U);
    v1::ClientMessage ping;
    ping.mutable_ping()->set_token(1);
    back->send(ping);  // Shows that the welcome came.
    ASSERT_TRUE(back->waitFor([](const auto& one) { return one.has_pong(); }).has_value());
    const auto replay = clientOf(port(), named("", token));
    const auto refused = replay->waitForError();
    ASSERT_TRUE(refused.has_value());
    EXPECT_EQ(refused->field(), "hello.resume");
}

TEST_F(People, ALinkOfAnotherServerIsRefused) {
    const ServerProcess other;
    ASSERT_TRUE(other.ready()) << other.log();
    TestClient client{other.port()};
    client.join(ann->share(1, v1::ROLE_CONTROL));
    const auto refused = client.waitForError();
    ASSERT_TRUE(refused.has_value());
    EXPECT_EQ(refused->code(), v1::ERROR_CODE_NOT_PERMITTED);
}

}  // namespace
}  // namespace volcast::test
