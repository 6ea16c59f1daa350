// A killed GL worker is only a pause.
#include <csignal>

#include "tests/e2e/server/shared_server.h"

namespace volcast::test {
namespace {

class Recovery : public SharedServer {};

TEST_F(Recovery, ClientsAreToldAndThenGetTheSamePictureFromANewWorker) {
    const auto client = clientWithView();
    const auto other = clientWithView(TestClient::Form::kJson);
    ASSERT_TRUE(client && other);
    client->look(1, 2, 0.4);
    const auto before = client->waitForLossless(1, 2);
    ASSERT_TRUE(before.has_value());
    const auto pid = static_cast<pid_t>(readiness().at("worker_pid").to_number<double>());
    ASSERT_GT(pid, 1);
    ASSERT_EQ(::kill(pid, SIGKILL), 0);
    ASSERT_TRUE(client->waitForState(1, v1::VIEW_STATE_RECOVERING).has_value()) << server().log();
    ASSERT_TRUE(client->waitForState(1, v1::VIEW_STATE_ACTIVE).has_value()) << server().log();
    const auto after = client->waitForFrame([&](const TestFrame& frame) {
        return frame.header.worker_generation() > before->header.worker_generation() &&
               frame.header.lossless();
    });
    ASSERT_TRUE(after.has_value()) << server().log();
    EXPECT_EQ(after->header.input_seq(), 2U);
    EXPECT_EQ(decode(*before).pixels, decode(*after).pixels);
    EXPECT_TRUE(other->waitForState(1, v1::VIEW_STATE_RECOVERING).has_value());
    other->look(1, 2, 0.1);
    EXPECT_TRUE(other->waitForFrame(1, 2).has_value());
    EXPECT_TRUE(eventually([] { return readiness().at("losses").to_number<double>() >= 1; }));
}

TEST_F(Recovery, AWorkerThatDiesInTheMiddleOfADragIsReplacedOnTheWay) {
    const auto client = clientWithView();
    ASSERT_TRUE(client);
    ASSERT_TRUE(eventually([] { return readiness().at("ready").as_bool(); }));
    const auto pid = static_cast<pid_t>(readiness().at("worker_pid").to_number<double>());
    for (std::uint64_t seq = 2; seq <= 30; ++seq) {
        client->look(1, seq, 0.1 * static_cast<double>(seq));
        if (seq == 15) {
            ASSERT_EQ(::kill(pid, SIGKILL), 0);
        }
        client->read(std::chrono::milliseconds{10});
    }
    const auto last = client->waitForLossless(1, 30);
    ASSERT_TRUE(last.has_value()) << server().log();
    EXPECT_EQ(client->socket().closeCode(), 0);
}

}  // namespace
}  // namespace volcast::test
