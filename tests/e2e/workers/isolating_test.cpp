// Views that run code of users: processes of their own, whose losses are nobody else's.
#include <csignal>
#include <unistd.h>

#include <gmock/gmock.h>

#include "tests/e2e/workers/service_fixture.h"

namespace volcast::test {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

constexpr const char* kQuick = "void main() { emitRGB(vec3(1.0, 0.0, 0.0)); }";

// Passes all checks, and takes far longer than any deadline here: some ten thousand operations for
// each of thousands of samples of a million rays.
constexpr const char* kSlow =
    "void main() { float x = 0.5; for (int i = 0; i < 200; ++i) { x = sin(x + getDataValue());\n"
    "x = cos(x * 1.1); x = exp(-x * x); x = sin(x + 2.0); x = cos(x * 1.3); x = exp(-x); }\n"
    "emitRGBA(vec4(x, x, x, 1e-6)); }";

constexpr const char* kSlider =
    "#uicontrol int rounds slider(min=0, max=200, default=0)\n"
    "void main() { float x = 0.5; for (int i = 0; i < 200; ++i) { if (i >= rounds) break;\n"
    "x = sin(x + getDataValue()); x = cos(x * 1.1); x = exp(-x * x); x = sin(x + 2.0);\n"
    "x = cos(x * 1.3); x = exp(-x); x = sin(x + 1.0); x = cos(x * 1.7); }\n"
    "emitRGBA(vec4(x, x, x, 1e-6)); }";

workers::RenderRequest byCode(const Service& service, std::uint64_t view, std::uint64_t tag,
                              const std::string& code) {
    workers::RenderRequest request = service.request(view, tag);
    request.scene.layers[0].shader.code = code;
    return request;
}

workers::RenderRequest slow(const Service& service, std::uint64_t view, std::uint64_t tag) {
    workers::RenderRequest request = byCode(service, view, tag, kSlow);
    request.scene.layers[0].stepWorld = 1e-3;
    request.size = {1024, 1024};
    return request;
}

TEST(IsolatingService, GivesAViewWithCodeAWorkerOfItsOwnWhileItHasCode) {
    workers::RenderSettings settings = quickSettings();
    settings.warmSpare = false;
    const Service service = startIsolatingService(settings);
    ASSERT_TRUE(service.service);
    const auto shared = service.draw(service.request(1, 1));
    ASSERT_TRUE(shared);
    EXPECT_EQ(childrenOf(::getpid()).size(), 1U);
    const auto own = service.draw(byCode(service, 2, 2, kQuick));
    ASSERT_TRUE(own);
    EXPECT_NE(own->picture->rgba8, shared->picture->rgba8);
    EXPECT_EQ(childrenOf(::getpid()).size(), 2U);
    ASSERT_TRUE(service.draw(byCode(service, 2, 3, kQuick)));
    EXPECT_EQ(childrenOf(::getpid()).size(), 2U) << "the same worker draws on";
    const auto back = service.draw(service.request(2, 4));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->picture->rgba8, shared->picture->rgba8);
    EXPECT_TRUE(eventually([] { return childrenOf(::getpid()).size() == 1; }));
    ASSERT_TRUE(service.draw(byCode(service, 3, 5, kQuick)));
    service.service->dropView(3);
    EXPECT_TRUE(eventually([] { return childrenOf(::getpid()).size() == 1; }));
}

TEST(IsolatingService, CodeThatDoesNotCompileIsAnErrorByLine) {
    const Service service = startIsolatingService();
    ASSERT_TRUE(service.service);
    service.service->submit(byCode(service, 1, 1, "void main() {\n emitRGB(1.0);\n}"));
    const auto error = service.events->waitForFailure(1, 1);
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code, ErrorCode::kInvalidArgument);
    EXPECT_EQ(error->field, "layers[0].shader.code");
    EXPECT_THAT(error->message, HasSubstr("line 2: 'emitRGB' : no matching overloaded function"));
    EXPECT_TRUE(service.draw(byCode(service, 1, 2, kQuick))) << "the worker lives on";
}

TEST(IsolatingService, AHangStallsNoOtherViewAndEndsInQuarantine) {
    workers::RenderSettings settings = quickSettings();
    settings.frameDeadline = milliseconds{3'000};
    const Service service = startIsolatingService(settings);
    ASSERT_TRUE(service.service);
    ASSERT_TRUE(service.draw(service.request(1, 1)));
    const int shared = service.pid();

    service.service->submit(slow(service, 2, 10));
    std::uint64_t tag = 2;
    // The others draw on while that hangs, two workers long.
    while (!service.events->hasFailure(2, 10)) {
        const auto begin = std::chrono::steady_clock::now();
        workers::RenderRequest moved = service.request(1, tag);
        moved.scene.camera.eye.x += 0.1 * static_cast<double>(tag);
        ASSERT_TRUE(service.draw(moved));
        EXPECT_LT(std::chrono::steady_clock::now() - begin, settings.frameDeadline);
        ++tag;
    }
    EXPECT_GT(tag, 4U);
    EXPECT_EQ(service.pid(), shared) << "the shared worker was never lost";
    EXPECT_EQ(service.service->status().losses, 2U) << "of workers for code of users";
    const auto error = service.events->waitForFailure(2, 10);
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code, ErrorCode::kDeviceLost);
    EXPECT_THAT(error->message, HasSubstr("missed its deadline of 3000 ms"));
    EXPECT_TRUE(service.events->waitForRecovering(2));

    service.service->submit(slow(service, 3, 11));
    const auto refused = service.events->waitForFailure(3, 11);
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->field, "layers[0].shader.code");
    EXPECT_THAT(refused->message, HasSubstr("which begins with \"void main() { float x = 0.5;"));
    EXPECT_THAT(refused->message, HasSubstr("took down two GL workers and is not run again"));
    EXPECT_TRUE(service.draw(byCode(service, 2, 12, kQuick))) << "other code of the view";
    const workers::RenderStatus before = service.service->status();
    EXPECT_EQ(before.losses, 2U);
    EXPECT_GE(before.starts, 4U) << "the shared one, two that were lost, and their successor";
    EXPECT_THAT(before.lastLoss, HasSubstr("missed its deadline of 3000 ms"));
    service.service->dropView(2);
    const workers::RenderStatus after = service.service->status();
    EXPECT_EQ(after.losses, 2U) << "counts stay when their service ends";
    EXPECT_GE(after.starts, before.starts);
}

TEST(IsolatingService, TellsOfAGpuThatAWorkerOfAViewGaveUp) {
    workers::RenderSettings settings = quickSettings();
    settings.gpu = "0";
    settings.warmSpare = false;
    settings.fault = worker::FaultSpec{.fault = worker::Fault::kLoseGpu, .after = 2};
    const Service service = startIsolatingService(settings);
    ASSERT_TRUE(service.service);
    EXPECT_EQ(service.service->status().gpuGivenUp, "");
    std::uint64_t tag = 1;
    while (service.service->status().gpuGivenUp.empty() && tag < 50) {
        workers::RenderRequest moved = byCode(service, 2, tag++, kQuick);
        moved.scene.camera.eye.x += 0.1 * static_cast<double>(tag);
        ASSERT_TRUE(service.draw(moved));
    }
    EXPECT_THAT(service.service->status().gpuGivenUp, HasSubstr("the GPU 0 lost 3 workers"));
}

// Its loop is bounded by a constant, and a control says how much of it is run.
TEST(IsolatingService, CodeThatHangsByAControlIsRefusedWithThatAlone) {
    workers::RenderSettings settings = quickSettings();
    settings.frameDeadline = milliseconds{8'000};
    const Service service = startIsolatingService(settings);
    ASSERT_TRUE(service.service);
    const auto withLoop = [&](std::uint64_t view, std::uint64_t tag, double rounds) {
        workers::RenderRequest request = byCode(service, view, tag, kSlider);
        request.scene.layers[0].shader.controls = {{.name = "rounds", .value = rounds}};
        request.scene.layers[0].stepWorld = 1e-3;
        request.size = {256, 256};
        return request;
    };
    const auto good = service.draw(withLoop(1, 1, 0));
    ASSERT_TRUE(good);
    service.service->submit(withLoop(1, 2, 200));
    const auto error = service.events->waitForFailure(1, 2);
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code, ErrorCode::kDeviceLost);
    EXPECT_EQ(error->field, "layers[0].shader.code");
    EXPECT_THAT(error->message, HasSubstr("#uicontrol int rounds slider(min=0, max=200"));
    EXPECT_THAT(error->message, HasSubstr("missed its deadline of 8000 ms"));
    const auto again = service.draw(withLoop(1, 3, 0));
    ASSERT_TRUE(again) << "the same code with its former control";
    EXPECT_EQ(again->picture->rgba8, good->picture->rgba8);
    service.service->submit(withLoop(2, 4, 200));
    EXPECT_TRUE(service.events->waitForFailure(2, 4)) << "at once, in every view";
    workers::RenderRequest hidden = withLoop(1, 5, 200);
    hidden.scene.layers[0].visible = false;
    EXPECT_TRUE(service.draw(hidden)) << "code of a hidden layer is not run";
}

TEST(IsolatingService, ViewsWithWorkersOfTheirOwnAreLimited) {
    workers::RenderSettings settings = quickSettings();
    settings.warmSpare = false;
    const Service service = startIsolatingService(settings);
    ASSERT_TRUE(service.service);
    for (std::uint64_t view = 1; view <= 9; ++view) {
        service.service->submit(byCode(service, view, view, kQuick));
    }
    const auto refused = service.events->waitForFailure(9, 9);
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->code, ErrorCode::kLimitExceeded);
    EXPECT_THAT(refused->message, HasSubstr("shader code runs in 8 views already"));
    service.service->dropView(1);
    EXPECT_TRUE(service.draw(byCode(service, 9, 10, kQuick)));
}

}  // namespace
}  // namespace volcast::test
