// What takes workers down again and again: a scene, which is held, or a GPU, which is given up.
#include <gmock/gmock.h>

#include "tests/e2e/server/fault_stage.h"

namespace volcast::test {
namespace {

using testing::HasSubstr;

TEST(Quarantine, ASceneThatKillsTwiceIsRefusedByNameAndTheLastGoodOneStays) {
    const ServerProcess server{{"--frame-deadline-ms", "10000"}};  // With the demo.
    ASSERT_TRUE(server.ready()) << server.log();
    const Looker looker{server.port(), TestClient::Form::kBinary, "demo:volume", 320, 240};
    const Looker other{server.port(), TestClient::Form::kJson, "demo:mesh"};
    ASSERT_TRUE(looker.before && other.before) << server.log();

    // Some billion of the dearest samples, none of which hides another.
    v1::Scene endless = looker.scene;
    endless.mutable_layers(0)->set_sampling(v1::SAMPLING_TRICUBIC);
    endless.mutable_layers(0)->set_step_world(1e-5);
    for (auto& point : *endless.mutable_layers(0)->mutable_transfer_function()->mutable_points()) {
        point.set_extinction(1e-3F);
    }
    looker.show(endless, 3);
    looker.client->look(1, 4, 0.4);
    auto error = looker.client->waitForError();
    ASSERT_TRUE(error.has_value()) << server.log();
    EXPECT_EQ(error->code(), v1::ERROR_CODE_WORKER_LOST);
    EXPECT_EQ(error->field(), "scene");
    EXPECT_THAT(error->message(), HasSubstr("the scene of input 3 is refused"));
    EXPECT_THAT(error->message(), HasSubstr("missed its deadline of 10000 ms for a frame"));
    const auto after = looker.client->waitForLossless(1, 4);
    ASSERT_TRUE(after.has_value()) << server.log();
    EXPECT_EQ(decode(*after).pixels, decode(*looker.before).pixels);
    const std::uint32_t generation = after->header.worker_generation();
    EXPECT_EQ(generation, looker.before->header.worker_generation() + 2);

    // Once more, from elsewhere: no worker is tried any more.
    looker.client->look(1, 5, 0.9);
    ASSERT_TRUE(looker.client->waitForLossless(1, 5).has_value());
    looker.show(endless, 6);
    error = looker.client->waitForError();
    ASSERT_TRUE(error.has_value()) << server.log();
    EXPECT_THAT(error->message(), HasSubstr("the scene of input 6 is refused"));
    EXPECT_THAT(error->message(), HasSubstr("is not drawn again"));
    looker.expectSamePictureAgain(7);
    other.expectSamePictureAgain(3);
    EXPECT_THAT(http(server.port(), "/readyz").body,
                HasSubstr("\"generation\":" + std::to_string(generation)));
}

TEST(GpuFallback, AfterThreeLossesTheSoftwareDeviceDrawsAndAllSaySo) {
    const TemporaryFolder cache;
    const ServerProcess::Environment environment{"XDG_CACHE_HOME=" + cache.path().string()};
    const FaultStage stage{{"--allow-faults", "--gpu", "0", "--worker-fault", "lose-gpu:2"},
                           environment};
    ASSERT_TRUE(stage.server->ready()) << stage.server->log();
    const Looker looker{stage.server->port(), TestClient::Form::kBinary};
    ASSERT_TRUE(looker.before) << stage.server->log();
    std::uint64_t seq = 3;
    for (; stage.text("gpu_given_up").empty() && seq < 50; ++seq) {
        looker.client->look(1, seq, 0.1 * static_cast<double>(seq));
        ASSERT_TRUE(looker.client->waitForFrame(1, seq).has_value()) << stage.server->log();
    }
    EXPECT_THAT(stage.text("gpu_given_up"), HasSubstr("the GPU 0 lost 3 workers"));
    const auto losses = stage.number("losses");
    for (const std::uint64_t last = seq + 5; seq < last; ++seq) {
        looker.client->look(1, seq, 0.1 * static_cast<double>(seq));
        ASSERT_TRUE(looker.client->waitForFrame(1, seq).has_value()) << stage.server->log();
    }
    looker.expectSamePictureAgain(seq);
    // The worker that was drawing then may be lost as well; the software device is not.
    EXPECT_LE(stage.number("losses"), losses + 1);

    const auto doctor = runVolcast({"doctor"}, environment);
    ASSERT_TRUE(doctor.has_value());
    EXPECT_THAT(doctor->out, HasSubstr("the GPU 0 lost 3 workers"));
}

TEST(GpuFallback, AGpuOnWhichNoWorkerStartsIsGivenUpAtOnce) {
    const FaultStage stage{{"--allow-faults", "--gpu", "0", "--worker-fault", "lose-gpu"}};
    ASSERT_TRUE(stage.server->ready()) << stage.server->log();
    EXPECT_THAT(stage.text("gpu_given_up"), HasSubstr("the GPU 0 lost 3 workers"));
    const Looker looker{stage.server->port(), TestClient::Form::kBinary};
    ASSERT_TRUE(looker.before) << stage.server->log();
    looker.expectSamePictureAgain(3);
    EXPECT_EQ(stage.number("losses"), 0);
}

}  // namespace
}  // namespace volcast::test
