// Real signals against real workers: after each loss the next picture equals the one before, bit
// for bit, the views were told, and no process is left behind.
#include <csignal>
#include <cstring>
#include <filesystem>
#include <unistd.h>

#include "tests/e2e/workers/service_fixture.h"

namespace volcast::test {
namespace {

using std::chrono::milliseconds;
using workers::RenderedFrame;

/// True where only living workers are left: at most one that draws and one spare.
bool noneLeftBehind() {
    return eventually([] {
        const std::vector<int> children = childrenOf(::getpid());
        for (const int child : children) {
            if (stateOf(child) == "Z") return false;
        }
        return children.size() <= 2;
    });
}

void expectSamePicture(const std::optional<RenderedFrame>& before,
                       const std::optional<RenderedFrame>& after) {
    ASSERT_TRUE(before && after);
    EXPECT_EQ(after->picture->size, before->picture->size);
    EXPECT_EQ(after->picture->rgba8, before->picture->rgba8);
}

/// Waits for the picture that a later worker drew for the same request.
std::optional<RenderedFrame> redrawn(const Service& service, const RenderedFrame& before) {
    return service.events->waitForFrame(before.view, [&](const RenderedFrame& frame) {
        return frame.generation > before.generation && frame.tag == before.tag;
    });
}

class SignalToAnIdleWorker : public testing::TestWithParam<int> {};

TEST_P(SignalToAnIdleWorker, IsOnlyAPause) {
    const Service service = startService();
    ASSERT_TRUE(service.service);
    const auto volume = service.draw(service.request(1, 11, "volume"));
    const auto mesh = service.draw(service.request(2, 22, "mesh"));
    ASSERT_TRUE(volume && mesh);
    EXPECT_NE(volume->picture->rgba8, mesh->picture->rgba8);

    ASSERT_EQ(::kill(service.pid(), GetParam()), 0);
    EXPECT_TRUE(service.events->waitForRecovering(1));
    EXPECT_TRUE(service.events->waitForRecovering(2));
    expectSamePicture(volume, redrawn(service, *volume));
    expectSamePicture(mesh, redrawn(service, *mesh));
    const workers::RenderStatus status = service.service->status();
    EXPECT_EQ(status.losses, 1U);
    EXPECT_EQ(status.generation, 2U);
    EXPECT_FALSE(status.lastLoss.empty());
    EXPECT_TRUE(noneLeftBehind());
}

INSTANTIATE_TEST_SUITE_P(Signals, SignalToAnIdleWorker,
                         testing::Values(SIGKILL, SIGSEGV, SIGTERM, SIGSTOP),
                         [](const auto& tested) {
                             return std::string{::sigabbrev_np(tested.param)};
                         });

class SignalWhileDrawing : public testing::TestWithParam<int> {};

TEST_P(SignalWhileDrawing, DrawsTheRequestInFlightAgain) {
    workers::RenderSettings settings = quickSettings();
    settings.frameDeadline = milliseconds{8'000};
    const Service service = startService(settings);
    ASSERT_TRUE(service.service);
    const auto small = service.draw(service.request(1, 11));
    ASSERT_TRUE(small);

    // Long enough to be hit, short enough to be finished afterwards.
    workers::RenderRequest large = service.request(2, 22);
    large.size = {512, 512};
    large.scene.layers[0].stepWorld = 5e-3;
    const auto before = service.draw(large);
    ASSERT_TRUE(before);
    // Another view of the same scene: the worker has nothing of it and has to draw.
    large.view = 3;
    large.tag = 33;
    service.service->submit(large);
    ASSERT_TRUE(eventually([&] { return stateOf(service.pid()) == "R"; }));
    ASSERT_EQ(::kill(service.pid(), GetParam()), 0);

    EXPECT_TRUE(service.events->waitForRecovering(3));
    const auto after = service.events->waitForTag(3, 33);
    ASSERT_TRUE(after);
    EXPECT_EQ(after->picture->rgba8, before->picture->rgba8);
    expectSamePicture(small, redrawn(service, *small));
    EXPECT_TRUE(noneLeftBehind());
}

INSTANTIATE_TEST_SUITE_P(Signals, SignalWhileDrawing, testing::Values(SIGKILL, SIGSTOP),
                         [](const auto& tested) {
                             return std::string{::sigabbrev_np(tested.param)};
                         });

TEST(Recovery, AFrameThatMissesItsDeadlineTwiceFailsAndTheOthersGoOn) {
    workers::RenderSettings settings = quickSettings();
    settings.frameDeadline = milliseconds{4'000};
    const Service service = startService(settings);
    ASSERT_TRUE(service.service);
    const auto innocent = service.draw(service.request(1, 11, "mesh"));
    ASSERT_TRUE(innocent);

    service.service->submit(service.endlessRequest(2, 22));
    const auto failure = service.events->waitForFailure(2, 22);
    ASSERT_TRUE(failure);
    EXPECT_EQ(failure->code, ErrorCode::kDeviceLost);
    EXPECT_NE(failure->message.find("4000 ms"), std::string::npos) << failure->message;
    EXPECT_TRUE(service.events->waitForRecovering(2, 2));
    EXPECT_EQ(service.service->status().losses, 2U);
    expectSamePicture(innocent, redrawn(service, *innocent));

    // Its mailbox is free again, and no third worker was lost.
    const auto modest = service.draw(service.request(2, 23, "mesh"));
    ASSERT_TRUE(modest);
    EXPECT_EQ(modest->picture->rgba8, innocent->picture->rgba8);
    EXPECT_EQ(service.service->status().losses, 2U);
    EXPECT_TRUE(noneLeftBehind());
}

// Each would cost everybody two more workers and deadlines.
TEST(Recovery, AViewWithOneEndlessSceneAfterAnotherIsToldToWait) {
    workers::RenderSettings settings = quickSettings();
    settings.frameDeadline = milliseconds{4'000};
    const Service service = startService(settings);
    ASSERT_TRUE(service.service);
    const auto good = service.draw(service.request(2, 1));
    ASSERT_TRUE(good);
    const auto endless = [&](std::uint64_t tag) {
        workers::RenderRequest request = service.endlessRequest(2, tag);
        request.scene.layers[0].stepWorld *= 1.0 + 0.01 * static_cast<double>(tag);
        return request;
    };
    for (const std::uint64_t tag : {10, 11}) {
        service.service->submit(endless(tag));
        const auto failure = service.events->waitForFailure(2, tag);
        ASSERT_TRUE(failure);
        EXPECT_NE(failure->message.find("took down two GL workers in a row"), std::string::npos);
        ASSERT_TRUE(service.draw(service.request(2, tag + 10)));
    }
    EXPECT_EQ(service.service->status().losses, 4U);
    service.service->submit(endless(12));
    const auto refused = service.events->waitForFailure(2, 12);
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->code, ErrorCode::kDeviceLost);
    EXPECT_EQ(refused->field, "scene");
    EXPECT_NE(refused->message.find("2 scenes of this view took down GL workers"),
              std::string::npos);
    EXPECT_NE(refused->message.find("drawn for another "), std::string::npos) << refused->message;
    const auto again = service.draw(service.request(2, 13));
    ASSERT_TRUE(again);
    EXPECT_EQ(again->picture->rgba8, good->picture->rgba8);
    EXPECT_TRUE(service.draw(service.request(3, 30, "mesh"))) << "another view, as it likes";
    EXPECT_EQ(service.service->status().losses, 4U);
}

TEST(Recovery, DeathOfTheSpareIsNoticedAndDisturbsNobody) {
    const Service service = startService();
    ASSERT_TRUE(service.service);
    const auto before = service.draw(service.request(1, 11));
    int spare = service.sparePid();
    for (const int signal : {SIGKILL, SIGSTOP}) {
        ASSERT_GT(spare, 0) << signal;
        ASSERT_EQ(::kill(spare, signal), 0);
        ASSERT_TRUE(eventually([&] { return stateOf(spare).empty(); })) << signal;
        spare = service.sparePid(spare);
    }
    EXPECT_GT(spare, 0);
    EXPECT_EQ(service.service->status().generation, 1U);
    const auto after = service.draw(service.request(1, 12));
    expectSamePicture(before, after);
    EXPECT_TRUE(noneLeftBehind());
}

TEST(Recovery, DeathOfBothAtOnceIsALongerPause) {
    const Service service = startService();
    ASSERT_TRUE(service.service);
    const auto before = service.draw(service.request(1, 11, "mesh"));
    ASSERT_TRUE(before);
    const int spare = service.sparePid();
    ASSERT_GT(spare, 0);
    ASSERT_EQ(::kill(spare, SIGKILL), 0);
    ASSERT_EQ(::kill(service.pid(), SIGKILL), 0);
    EXPECT_TRUE(service.events->waitForRecovering(1));
    const auto after = redrawn(service, *before);
    expectSamePicture(before, after);
    EXPECT_TRUE(noneLeftBehind());
}

TEST(Recovery, ManyLossesInARowLeakNothing) {
    const Service service = startService();
    ASSERT_TRUE(service.service);
    auto frame = service.draw(service.request(1, 11));
    ASSERT_TRUE(frame);
    const auto countDescriptors = [] {
        std::size_t count = 0;
        for (const auto& entry : std::filesystem::directory_iterator{"/proc/self/fd"}) {
            count += entry.path().empty() ? 0 : 1;
        }
        return count;
    };
    ASSERT_GT(service.sparePid(), 0);
    const std::size_t descriptors = countDescriptors();
    for (int i = 0; i < 5; ++i) {
        ASSERT_GT(service.sparePid(), 0);
        ASSERT_EQ(::kill(service.pid(), SIGKILL), 0);
        const auto next = redrawn(service, *frame);
        expectSamePicture(frame, next);
        frame = next;
    }
    ASSERT_GT(service.sparePid(), 0);
    EXPECT_TRUE(eventually([&] { return countDescriptors() <= descriptors; }));
    EXPECT_TRUE(noneLeftBehind());
}

TEST(Recovery, DatasetsThatCameAndWentAreReplayedAsTheyAreNow) {
    const Service service = startService();
    ASSERT_TRUE(service.service);
    ASSERT_TRUE(service.draw(service.request(1, 1, "mesh")));
    service.service->removeDataset("mesh");
    for (std::uint64_t tag = 10; tag < 12; ++tag) {
        service.service->submit(service.request(2, tag, "mesh"));
        const auto failure = service.events->waitForFailure(2, tag);
        ASSERT_TRUE(failure);
        EXPECT_EQ(failure->code, ErrorCode::kNotFound);
        EXPECT_EQ(failure->field, "layers[0].dataset");
        ASSERT_TRUE(service.draw(service.request(3, tag, "volume")));
        ASSERT_EQ(::kill(service.pid(), SIGKILL), 0);
        ASSERT_TRUE(service.events->waitForRecovering(3, tag - 9));
    }
}

TEST(Recovery, AllProcessesGoWithTheService) {
    {
        const Service service = startService();
        ASSERT_TRUE(service.service);
        ASSERT_GT(service.sparePid(), 0);
        EXPECT_EQ(childrenOf(::getpid()).size(), 2U);
    }
    EXPECT_TRUE(childrenOf(::getpid()).empty());
}

}  // namespace
}  // namespace volcast::test
