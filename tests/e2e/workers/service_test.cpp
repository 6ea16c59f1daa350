#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <unistd.h>

#include "renderer/base/memfd.h"
#include "renderer/base/sandbox.h"
#include "renderer/worker/channel.h"
#include "server/workers/child_process.h"
#include "tests/e2e/workers/service_fixture.h"
#include "tests/support/temporary_folder.h"
#include "volcast/internal/v1/worker.pb.h"

namespace volcast::test {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using workers::RenderService;

/// A folder of this test's own.
class Folder : public support::TemporaryFolder {
public:
    /// A program that a test starts instead of the worker.
    [[nodiscard]] std::string script(const std::string& text) const {
        const fs::path file = path() / "program";
        std::ofstream{file} << "#!/bin/sh\n" << text << "\n";
        fs::permissions(file, fs::perms::owner_all);
        return file;
    }
};

Error creationError(const workers::RenderSettings& settings) {
    const auto service = RenderService::create(settings, {});
    EXPECT_FALSE(service.has_value());
    return service ? Error{} : service.error();
}

TEST(RenderService, IntegratesAConstantExtinctionInClosedForm) {
    const Service service = startService();
    ASSERT_TRUE(service.service);
    workers::RenderRequest request = service.request(1, 1);
    const float sigma = 0.7F;
    // Seen along z, the unit cube is 1 long for every ray of an orthographic camera.
    request.scene.camera = {.eye = {0.5, 0.5, 4.0},
                            .center = {0.5, 0.5, 0.5},
                            .up = {0.0, 1.0, 0.0},
                            .projection = scene::Projection::kOrthographic,
                            .fovyDegrees = 30.0,
                            .orthographicHeight = 0.5};
    request.scene.layers[0].map.points = {
        {.value = 0.0F, .colour = {1.0F, 0.5F, 0.0F}, .extinction = sigma}};
    request.size = {16, 16};
    request.wantFloat = true;
    const auto frame = service.draw(request);
    ASSERT_TRUE(frame);
    const float alpha = 1.0F - std::exp(-sigma);
    ASSERT_EQ(frame->picture->rgba32f.size(), 16U * 16U * 4U);
    for (std::size_t i = 0; i < frame->picture->rgba32f.size(); i += 4) {
        EXPECT_NEAR(frame->picture->rgba32f[i + 3], alpha, 1e-4F);
        EXPECT_NEAR(frame->picture->rgba32f[i], alpha, 1e-4F);
        EXPECT_NEAR(frame->picture->rgba32f[i + 1], 0.5F * alpha, 1e-4F);
        EXPECT_EQ(frame->picture->rgba32f[i + 2], 0.0F);
    }
}

TEST(RenderService, SaysWhatItDid) {
    const Service service = startService();
    ASSERT_TRUE(service.service);
    const auto first = service.draw(service.request(1, 1));
    ASSERT_TRUE(first);
    EXPECT_TRUE(first->drawn);
    EXPECT_EQ(first->work.framesDrawn, 1U);
    EXPECT_GT(first->work.uploadedBytes, 0U);
    EXPECT_EQ(first->plan.layers.size(), 1U);
    EXPECT_FALSE(first->plan.id.empty());
    EXPECT_EQ(first->generation, 1U);
    EXPECT_GT(first->drawMs, 0.0);
    EXPECT_GT(first->workerPeakMb, 1.0);
    const auto second = service.draw(service.request(1, 2));
    ASSERT_TRUE(second);
    EXPECT_FALSE(second->drawn);
    EXPECT_EQ(second->work.framesDrawn, 0U);
    EXPECT_EQ(second->picture->rgba8, first->picture->rgba8);
    const workers::RenderStatus status = service.service->status();
    EXPECT_TRUE(status.ready);
    EXPECT_FALSE(status.glRenderer.empty());
    EXPECT_EQ(status.losses, 0U);
}

TEST(RenderService, NewestRequestWinsAndViewsTakeTurns) {
    const Service service = startService();
    ASSERT_TRUE(service.service);
    constexpr std::uint64_t kLast = 200;
    for (std::uint64_t tag = 1; tag <= kLast; ++tag) {
        for (const std::uint64_t view : {1, 2, 3}) {
            workers::RenderRequest request = service.request(view, tag, "mesh");
            request.scene.camera = scene::orbit(request.scene.camera, static_cast<double>(tag));
            service.service->submit(std::move(request));
        }
    }
    for (const std::uint64_t view : {1, 2, 3}) {
        EXPECT_TRUE(service.events->waitForTag(view, kLast)) << view;
        EXPECT_LE(service.events->framesOf(view), kLast);
    }
}

// 2048 rows in parts of 30 ms: of many, unless a machine draws them all in one.
TEST(RenderService, APatientPictureIsTheSameAndLetsOthersDrawBetweenItsParts) {
    const Service service = startService();
    ASSERT_TRUE(service.service);
    workers::RenderRequest whole = service.request(1, 1);
    whole.size = {1024, 2048};
    whole.scene.layers[0].stepWorld = 0.002;
    const auto expected = service.draw(whole);
    ASSERT_TRUE(expected);
    workers::RenderRequest patient = whole;
    patient.view = 2;
    patient.patient = true;
    service.service->submit(patient);
    for (std::uint64_t tag = 1; tag <= 3; ++tag) {
        workers::RenderRequest quick = service.request(3, tag);
        quick.scene.camera = scene::orbit(quick.scene.camera, static_cast<double>(tag));
        ASSERT_TRUE(service.draw(quick));
    }
    const bool inOne = expected->drawMs < 120;
    EXPECT_TRUE(inOne || service.events->framesOf(2) == 0) << expected->drawMs;
    const auto drawn = service.events->waitForTag(2, 1);
    ASSERT_TRUE(drawn);
    EXPECT_EQ(drawn->picture->rgba8, expected->picture->rgba8);
    EXPECT_TRUE(drawn->drawn);
    // A newer one of its view ends it.
    patient.tag = 2;
    patient.scene.camera = scene::orbit(patient.scene.camera, 0.5);
    service.service->submit(patient);
    workers::RenderRequest newer = service.request(2, 3);
    ASSERT_TRUE(service.draw(newer));
    EXPECT_TRUE(inOne || service.events->framesOf(2) == 2);
}

TEST(RenderService, PicturesOfAllSizesComeWhole) {
    const Service service = startService();
    ASSERT_TRUE(service.service);
    std::uint64_t tag = 0;
    for (const glm::ivec2 size :
         {glm::ivec2{1, 1}, {640, 480}, {3, 700}, {64, 64}, {1500, 1400}, {8, 8}, {9, 8}}) {
        workers::RenderRequest request = service.request(1, ++tag, "mesh");
        request.size = size;
        request.wantFloat = tag % 2 == 0;
        const auto frame = service.draw(request);
        ASSERT_TRUE(frame);
        EXPECT_EQ(frame->picture->size, size);
        const std::size_t values = std::size_t{4} * size.x * size.y;
        EXPECT_EQ(frame->picture->rgba8.size(), values);
        EXPECT_EQ(frame->picture->rgba32f.size(), request.wantFloat ? values : 0U);
        // Straight down on an opaque background: alpha is full everywhere.
        for (std::size_t i = 3; i < values; i += 4) {
            ASSERT_EQ(frame->picture->rgba8[i], std::byte{255}) << i;
        }
    }
}

TEST(RenderService, RefusesWhatCannotBeDrawnAndDrawsOn) {
    const Service service = startService();
    ASSERT_TRUE(service.service);
    workers::RenderRequest bad = service.request(1, 1);
    bad.scene.layers[0].dataset = "nowhere";
    service.service->submit(bad);
    auto failure = service.events->waitForFailure(1, 1);
    ASSERT_TRUE(failure);
    EXPECT_EQ(failure->code, ErrorCode::kNotFound);

    bad = service.request(1, 2);
    bad.scene.camera.eye.x = std::nan("");
    service.service->submit(bad);
    failure = service.events->waitForFailure(1, 2);
    ASSERT_TRUE(failure);
    EXPECT_EQ(failure->code, ErrorCode::kInvalidArgument);

    std::uint64_t tag = 2;
    for (const glm::ivec2 size : {glm::ivec2{0, 0}, {-1, 5}, {100'000, 1}, {1, 8193}}) {
        bad = service.request(1, ++tag);
        bad.size = size;
        service.service->submit(bad);
        failure = service.events->waitForFailure(1, tag);
        ASSERT_TRUE(failure) << size.x << " x " << size.y;
        EXPECT_EQ(failure->code,
                  size.x < 1 ? ErrorCode::kInvalidArgument : ErrorCode::kLimitExceeded);
    }
    EXPECT_TRUE(service.draw(service.request(1, 100)));
    EXPECT_EQ(service.service->status().losses, 0U);
}

TEST(RenderService, RefusesADatasetThatIsNoneAndDrawsTheOthers) {
    const Service service = startService();
    ASSERT_TRUE(service.service);
    auto garbage = base::createMemfd("garbage", 1000).value();
    ASSERT_TRUE(base::sealReadOnly(garbage).has_value());
    service.service->addDataset("garbage", std::move(garbage));
    workers::RenderRequest request = service.request(1, 1);
    request.scene.layers[0].dataset = "garbage";
    service.service->submit(request);
    const auto failure = service.events->waitForFailure(1, 1);
    ASSERT_TRUE(failure);
    EXPECT_EQ(failure->code, ErrorCode::kNotFound);
    EXPECT_TRUE(service.draw(service.request(1, 2)));
    EXPECT_EQ(service.service->status().losses, 0U);
}

TEST(RenderService, DroppedViewIsNotDrawn) {
    const Service service = startService();
    ASSERT_TRUE(service.service);
    ASSERT_TRUE(service.draw(service.request(1, 1)));
    service.service->dropView(1);
    ASSERT_TRUE(service.draw(service.request(2, 1)));
    EXPECT_EQ(service.events->framesOf(1), 1U);
}

TEST(RenderServiceStart, NamesAWorkerThatIsNotThere) {
    workers::RenderSettings settings = quickSettings();
    settings.workerPath = "/nonexistent/volcast-worker";
    const Error error = creationError(settings);
    EXPECT_EQ(error.code, ErrorCode::kNotFound);
    EXPECT_NE(error.message.find(settings.workerPath), std::string::npos) << error.message;
}

TEST(RenderServiceStart, ReportsAWorkerThatDiesAtOnce) {
    workers::RenderSettings settings = quickSettings();
    settings.workerPath = "/bin/false";
    const Error error = creationError(settings);
    EXPECT_EQ(error.code, ErrorCode::kIo);
    EXPECT_NE(error.message.find("exited with code 1"), std::string::npos) << error.message;
    EXPECT_TRUE(childrenOf(::getpid()).empty());
}

TEST(RenderServiceStart, GivesUpOnAWorkerThatNeverBecomesReady) {
    const Folder folder;
    workers::RenderSettings settings = quickSettings();
    settings.workerPath = folder.script("exec sleep 1000");
    settings.startDeadline = milliseconds{200};
    const Error error = creationError(settings);
    EXPECT_EQ(error.code, ErrorCode::kTimeout);
    EXPECT_NE(error.message.find("200 ms"), std::string::npos) << error.message;
    EXPECT_TRUE(childrenOf(::getpid()).empty());
}

TEST(RenderServiceStart, SaysThatThereIsNoEgl) {
    ::setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent", 1);
    const Error error = creationError(quickSettings());
    ::unsetenv("__EGL_VENDOR_LIBRARY_DIRS");
    EXPECT_EQ(error.code, ErrorCode::kUnsupported);
    EXPECT_NE(error.message.find("EGL"), std::string::npos) << error.message;
}

TEST(RenderServiceStart, SaysThatThereIsNoSuchGpu) {
    workers::RenderSettings settings = quickSettings();
    settings.gpu = "99";
    const Error error = creationError(settings);
    EXPECT_EQ(error.code, ErrorCode::kNotFound);
    EXPECT_NE(error.message.find("99"), std::string::npos) << error.message;
}

TEST(RenderServiceStart, LeavesNoCacheFolderBehind) {
    const Folder folder;
    ::setenv("TMPDIR", folder.path().c_str(), 1);
    {
        const Service service = startService();
        ASSERT_TRUE(service.service);
        ASSERT_TRUE(service.draw(service.request(1, 1)));
        EXPECT_FALSE(fs::is_empty(folder.path()));
    }
    ::unsetenv("TMPDIR");
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(RenderServiceStart, NamesACacheFolderThatCannotBeMade) {
    workers::RenderSettings settings = quickSettings();
    settings.cacheFolder = "/proc/volcast-cache";
    const Error error = creationError(settings);
    EXPECT_EQ(error.code, ErrorCode::kIo);
    EXPECT_NE(error.message.find(settings.cacheFolder), std::string::npos) << error.message;
}

TEST(Worker, ThatExitsIsReplaced) {
    const Folder folder;
    workers::RenderSettings settings = quickSettings();
    // Long enough to draw once; programs with sanitizers are slower.
    const std::string lifeS = base::kLimitsAddressSpace ? "4" : "12";
    // Its parent is `timeout`, not we.
    settings.workerPath =
        folder.script("exec timeout -s KILL " + lifeS + " env -u VOLCAST_PARENT " +
                      workers::besideThisProgram("volcast-worker") + " \"$@\"");
    const Service service = startService(settings);
    ASSERT_TRUE(service.service);
    const auto before = service.draw(service.request(1, 1));
    ASSERT_TRUE(before);
    const auto after = service.events->waitForFrame(
        1, [](const workers::RenderedFrame& frame) { return frame.generation > 1; });
    ASSERT_TRUE(after);
    EXPECT_EQ(after->picture->rgba8, before->picture->rgba8);
}

TEST(Worker, ThatCannotBeReplacedFailsItsViewsUntilItCan) {
    const Folder folder;
    const std::string real = workers::besideThisProgram("volcast-worker");
    workers::RenderSettings settings = quickSettings();
    settings.workerPath = folder.script("exec " + real + " \"$@\"");
    settings.warmSpare = false;
    const Service service = startService(settings);
    ASSERT_TRUE(service.service);
    const auto before = service.draw(service.request(1, 1));
    ASSERT_TRUE(before);

    static_cast<void>(folder.script("exit 1"));
    ASSERT_EQ(::kill(service.pid(), SIGKILL), 0);
    const auto failure = service.events->waitForFailure(1, 1);
    ASSERT_TRUE(failure);
    EXPECT_EQ(failure->code, ErrorCode::kDeviceLost);
    EXPECT_FALSE(service.service->status().ready);

    static_cast<void>(folder.script("exec " + real + " \"$@\""));
    service.service->submit(service.request(1, 2));
    // May fail while the old program is still tried; what is submitted later is drawn.
    ASSERT_TRUE(eventually([&] { return service.service->status().ready; }));
    const auto after = service.draw(service.request(1, 3));
    ASSERT_TRUE(after);
    EXPECT_EQ(after->picture->rgba8, before->picture->rgba8);
}

/// A worker without a service around it.
struct BareWorker {
    worker::Channel channel;
    workers::ChildProcess child;
};

BareWorker startBareWorker() {
    auto pair = worker::Channel::createPair().value();
    workers::SpawnDesc desc;
    desc.program = workers::besideThisProgram("volcast-worker");
    desc.channel = pair.theirs.get();
    BareWorker bare{.channel = std::move(pair.ours),
                    .child = workers::ChildProcess::spawn(desc).value()};
    pair.theirs = {};
    internal::v1::FromWorker message;
    EXPECT_TRUE(bare.channel.receive(message, kPatience)->has_value());
    EXPECT_TRUE(message.has_ready()) << message.failed().message();
    return bare;
}

TEST(Worker, EndsQuietlyWhenTheServerIsGone) {
    BareWorker worker = startBareWorker();
    { const worker::Channel closed = std::move(worker.channel); }
    const workers::ExitStatus status = worker.child.reap();
    EXPECT_FALSE(status.signalled) << status.text();
    EXPECT_EQ(status.value, 0);
}

TEST(Worker, EndsWithACodeOfItsOwnOnAMessageItDoesNotKnow) {
    BareWorker worker = startBareWorker();
    internal::v1::ToWorker strange;
    strange.GetReflection()->MutableUnknownFields(&strange)->AddVarint(1000, 1);
    ASSERT_TRUE(worker.channel.send(strange).has_value());
    const workers::ExitStatus status = worker.child.reap();
    EXPECT_FALSE(status.signalled) << status.text();
    EXPECT_EQ(status.value, 6);
}

// Where memory runs out, the kernel ends a worker and not the server.
TEST(Worker, IsEndedBeforeTheServerWhereMemoryRunsOut) {
    const BareWorker worker = startBareWorker();
    const int own = std::stoi(procText(::getpid(), "oom_score_adj"));
    EXPECT_EQ(std::stoi(procText(worker.child.pid(), "oom_score_adj")), std::min(own + 500, 1000));
}

TEST(Worker, MayNotOpenTheUsersFiles) {
    const BareWorker worker = startBareWorker();
    std::ifstream file{"/proc/" + std::to_string(worker.child.pid()) + "/status"};
    std::string line;
    std::string seccomp;
    std::string privileges;
    while (std::getline(file, line)) {
        if (line.starts_with("Seccomp:")) seccomp = line;
        if (line.starts_with("NoNewPrivs:")) privileges = line;
    }
    EXPECT_EQ(seccomp, "Seccomp:\t2");
    EXPECT_EQ(privileges, "NoNewPrivs:\t1");
}

}  // namespace
}  // namespace volcast::test
