// Each fault in a real worker or import of a real server: clients stay connected, no state is
// lost, the next picture is the one before bit for bit, and others see a pause at most.
#include <chrono>
#include <iostream>

#include <gmock/gmock.h>

#include "tests/e2e/server/fault_stage.h"

namespace volcast::test {
namespace {

using testing::HasSubstr;
using Clock = std::chrono::steady_clock;

const std::vector<std::string> kFaulty{"--allow-faults", "--frame-deadline-ms", "10000"};

struct Loss {
    const char* fault;
    const char* said;  ///< In the server's account of it.
};

class WorkerFault : public testing::TestWithParam<Loss> {};

TEST_P(WorkerFault, IsAPauseForAllAndNothingIsLost) {
    const FaultStage stage{kFaulty};
    ASSERT_TRUE(stage.server->ready()) << stage.server->log();
    const Looker looker{stage.server->port(), TestClient::Form::kBinary};
    const Looker other{stage.server->port(), TestClient::Form::kJson};
    ASSERT_TRUE(looker.before && other.before) << stage.server->log();
    ASSERT_TRUE(stage.waitForSpare());
    // A very busy machine may have cost workers their first frames.
    const int losses = stage.number("losses");
    const auto generation = static_cast<std::uint32_t>(stage.number("generation"));

    inject(*looker.client, GetParam().fault);
    const auto start = Clock::now();
    looker.show(looker.otherScene(), 3);
    ASSERT_TRUE(looker.client->waitForState(1, v1::VIEW_STATE_RECOVERING)) << stage.server->log();
    const auto next = looker.client->waitForFrame(1, 3);
    ASSERT_TRUE(next.has_value()) << stage.server->log();
    const std::chrono::duration<double, std::milli> took = Clock::now() - start;
    std::cout << "[   TIME   ] " << GetParam().fault << ": input to the next correct picture "
              << took.count() << " ms\n";
    EXPECT_EQ(next->header.worker_generation(), generation + 1);
    EXPECT_EQ(stage.number("losses"), losses + 1);
    EXPECT_THAT(std::string{stage.readiness().at("last_loss").as_string()},
                HasSubstr(GetParam().said));
    looker.expectSamePictureAgain(4);

    ASSERT_TRUE(other.client->waitForState(1, v1::VIEW_STATE_RECOVERING));
    const auto theirs = other.client->waitForFrame([&](const TestFrame& frame) {
        return frame.header.worker_generation() == generation + 1 && frame.header.lossless();
    });
    ASSERT_TRUE(theirs.has_value()) << stage.server->log();
    EXPECT_EQ(theirs->header.input_seq(), 2U);
    EXPECT_EQ(decode(*theirs).pixels, decode(*other.before).pixels);
    EXPECT_EQ(other.client->socket().closeCode(), 0);
    EXPECT_EQ(stage.number("losses"), losses + 1) << stage.server->log();
}

INSTANTIATE_TEST_SUITE_P(
    All, WorkerFault,
    testing::Values(Loss{"crash", "signal 11"}, Loss{"hang-in-draw", "10000 ms for a frame"},
                    Loss{"hang-in-compile", "10000 ms for a frame"},
                    Loss{"gpu-reset", "lost its GL device"}, Loss{"lose-gpu", "lost its GL device"},
                    Loss{"unwritten-slot", "announced a picture and wrote none"},
                    Loss{"wrong-size", "drew a picture nobody asked for"},
                    Loss{"garbage", "does not parse"},
                    Loss{"exit-in-upload", "exited with code 1"}),
    [](const auto& tested) {
        std::string name = tested.param.fault;
        std::erase(name, '-');
        return name;
    });

TEST(Faults, WithoutGpuMemoryAViewIsToldAndLivesOn) {
    const FaultStage stage{kFaulty};
    ASSERT_TRUE(stage.server->ready()) << stage.server->log();
    const Looker looker{stage.server->port(), TestClient::Form::kBinary};
    ASSERT_TRUE(looker.before) << stage.server->log();
    const int losses = stage.number("losses");
    inject(*looker.client, "out-of-gpu-memory");
    looker.show(looker.otherScene(), 3);
    const auto error = looker.client->waitForError();
    ASSERT_TRUE(error.has_value()) << stage.server->log();
    EXPECT_EQ(error->code(), v1::ERROR_CODE_OUT_OF_GPU_MEMORY) << error->message();
    EXPECT_EQ(error->view(), 1U);
    EXPECT_EQ(error->input_seq(), 3U);
    looker.expectSamePictureAgain(4);
    // There is memory again.
    looker.show(looker.otherScene(), 6);
    EXPECT_TRUE(looker.client->waitForFrame(1, 6).has_value()) << stage.server->log();
    EXPECT_EQ(stage.number("losses"), losses);
}

TEST(Faults, TheSpareDiesAndNobodyNotices) {
    const FaultStage stage{kFaulty};
    ASSERT_TRUE(stage.server->ready()) << stage.server->log();
    const Looker looker{stage.server->port(), TestClient::Form::kBinary};
    ASSERT_TRUE(looker.before) << stage.server->log();
    ASSERT_TRUE(stage.waitForSpare());
    const int spare = stage.number("spare_pid");
    const int generation = stage.number("generation");
    inject(*looker.client, "spare-exit");
    ASSERT_TRUE(eventually([&] {
        const auto now = stage.readiness();
        return now.at("spare_ready").as_bool() && now.at("spare_pid").to_number<int>() != spare;
    })) << stage.server->log();
    looker.expectSamePictureAgain(3);
    EXPECT_EQ(stage.number("generation"), generation);
    for (const v1::ServerMessage& message : looker.client->messages) {  // Since the first picture.
        EXPECT_FALSE(message.has_view_status() &&
                     message.view_status().state() == v1::VIEW_STATE_RECOVERING);
    }
}

class ImportFault : public testing::TestWithParam<Loss> {};

TEST_P(ImportFault, CostsOneImportAndNoView) {
    std::vector<std::string> options = kFaulty;
    options.insert(options.end(), {"--import-deadline-ms", "4000"});
    const FaultStage stage{options};
    ASSERT_TRUE(stage.server->ready()) << stage.server->log();
    const Looker looker{stage.server->port(), TestClient::Form::kBinary};
    ASSERT_TRUE(looker.before) << stage.server->log();
    const int losses = stage.number("losses");

    inject(*looker.client, GetParam().fault);
    v1::ClientMessage open;
    open.mutable_open_dataset()->set_dataset("again.node");
    looker.client->send(open);
    const auto failed = looker.client->waitForDataset("again.node", v1::DATASET_STATE_FAILED);
    ASSERT_TRUE(failed.has_value()) << stage.server->log();
    EXPECT_THAT(failed->error(), HasSubstr(GetParam().said));
    looker.expectSamePictureAgain(3);
    looker.client->send(open);
    EXPECT_TRUE(looker.client->waitForDataset("again.node", v1::DATASET_STATE_READY).has_value())
        << stage.server->log();
    EXPECT_EQ(stage.number("losses"), losses);
}

INSTANTIATE_TEST_SUITE_P(All, ImportFault,
                         testing::Values(Loss{"import-crash", "signal 11"},
                                         Loss{"import-hang", "longer than 4000 ms"}),
                         [](const auto& tested) {
                             return std::string{tested.param.fault} == "import-crash" ? "crash"
                                                                                      : "hang";
                         });

TEST(Faults, AreRefusedByAServerThatWasNotToldToAllowThem) {
    const FaultStage stage{{}};
    ASSERT_TRUE(stage.server->ready()) << stage.server->log();
    const Looker looker{stage.server->port(), TestClient::Form::kJson};
    ASSERT_TRUE(looker.before) << stage.server->log();
    const int losses = stage.number("losses");
    inject(*looker.client, "crash");
    const auto error = looker.client->waitForError();
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->code(), v1::ERROR_CODE_NOT_PERMITTED);
    EXPECT_THAT(error->message(), HasSubstr("--allow-faults"));
    looker.expectSamePictureAgain(3);
    EXPECT_EQ(stage.number("losses"), losses);
}

TEST(Faults, WithAnUnknownNameOrViewAreRefusedByName) {
    const FaultStage stage{kFaulty};
    ASSERT_TRUE(stage.server->ready()) << stage.server->log();
    EXPECT_THAT(stage.server->log(),
                HasSubstr("who may steer a view may let workers and imports fail"));
    const Looker looker{stage.server->port(), TestClient::Form::kJson};
    ASSERT_TRUE(looker.before) << stage.server->log();
    inject(*looker.client, "earthquake");
    auto error = looker.client->waitForError();
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->code(), v1::ERROR_CODE_INVALID_ARGUMENT);
    EXPECT_EQ(error->field(), "fault");
    EXPECT_THAT(error->message(), HasSubstr("\"earthquake\" is no fault; there are crash, "));
    looker.client->sendJson(R"({"injectFault":{"view":7,"fault":"crash"}})");
    error = looker.client->waitForError();
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->code(), v1::ERROR_CODE_NOT_FOUND);
}

TEST(Faults, OfTheCommandLineNeedTheLeaveOfTheServer) {
    const auto refused = runVolcast({"serve", "--port", "0", "--worker-fault", "crash"});
    ASSERT_TRUE(refused.has_value());
    EXPECT_EQ(refused->exitCode, 2);
    EXPECT_THAT(refused->err, HasSubstr("--allow-faults"));
    const auto unknown =
        runVolcast({"serve", "--port", "0", "--allow-faults", "--worker-fault", "flood"});
    ASSERT_TRUE(unknown.has_value());
    EXPECT_EQ(unknown->exitCode, 2);
    EXPECT_THAT(unknown->err, HasSubstr("\"flood\" is no fault; there are crash, "));
}

}  // namespace
}  // namespace volcast::test
