// Measurements beside pictures, and what becomes of them when a worker is lost.
#include <csignal>

#include "tests/e2e/workers/service_fixture.h"

namespace volcast::test {
namespace {

using std::chrono::milliseconds;

/// A measurement of view 1 with a hundred thousand rays of the reference, and the picture that
/// shows that its first part has begun: a worker gets the next part before a picture is told of.
workers::MeasureRequest longMeasurement(const Service& service) {
    workers::MeasureRequest request;
    request.view = 1;
    request.job = {.scene = service.scene("mesh", scene::RayModel::kVolume),
                   .size = {512, 512},
                   .candidate = {.integrator = scene::Integrator::kExact,
                                 .evaluator = scene::MeshEvaluator::kWalk},
                   .frames = 2,
                   .pixels = 100'000};
    return request;
}

workers::RenderRequest turned(const Service& service, std::uint64_t tag) {
    workers::RenderRequest request = service.request(2, tag, "mesh");
    request.scene.camera = scene::orbit(request.scene.camera, static_cast<double>(tag));
    return request;
}

TEST(Measuring, PicturesOfOtherViewsDoNotWaitForIt) {
    const Service service = startService();
    ASSERT_TRUE(service.service);
    service.service->measure(longMeasurement(service));
    for (std::uint64_t tag = 1; tag <= 5; ++tag) {
        ASSERT_TRUE(service.draw(turned(service, tag)));
        ASSERT_FALSE(service.events->hasMeasurement()) << tag;
    }
    const auto measured = service.events->waitForMeasurement(1);
    ASSERT_TRUE(measured);
    ASSERT_TRUE(measured->has_value()) << measured->error().message;
    EXPECT_EQ((*measured)->all.pixels, 100'000U);
    EXPECT_EQ((*measured)->frames, 2);
    EXPECT_GT((*measured)->minMs, 0.0);
    EXPECT_LT((*measured)->inner.max, 1e-4);
}

TEST(Measuring, IsDoneAgainByTheNextWorker) {
    const Service service = startService();
    ASSERT_TRUE(service.service);
    service.service->measure(longMeasurement(service));
    ASSERT_TRUE(service.draw(turned(service, 1)));
    ASSERT_EQ(::kill(service.pid(), SIGKILL), 0);
    const auto measured = service.events->waitForMeasurement(1);
    ASSERT_TRUE(measured);
    ASSERT_TRUE(measured->has_value()) << measured->error().message;
    EXPECT_EQ((*measured)->all.pixels, 100'000U);
    EXPECT_EQ(service.service->status().losses, 1U);
    EXPECT_TRUE(service.draw(turned(service, 2)));
}

TEST(Measuring, EndsWithAnErrorAfterTwoLosses) {
    const Service service = startService();
    ASSERT_TRUE(service.service);
    service.service->measure(longMeasurement(service));
    for (std::uint32_t loss = 1; loss <= 2; ++loss) {
        ASSERT_TRUE(service.draw(turned(service, loss)));
        ASSERT_FALSE(service.events->hasMeasurement());
        ASSERT_EQ(::kill(service.pid(), SIGKILL), 0);
        ASSERT_TRUE(service.events->waitForRecovering(2, loss));
    }
    const auto measured = service.events->waitForMeasurement(1);
    ASSERT_TRUE(measured);
    ASSERT_FALSE(measured->has_value());
    EXPECT_EQ(measured->error().code, ErrorCode::kDeviceLost);
    EXPECT_NE(measured->error().message.find("signal 9"), std::string::npos)
        << measured->error().message;
    EXPECT_TRUE(service.draw(turned(service, 3)));
}

TEST(Measuring, AWorkerThatHangsInAPartCostsTheMeasurementAndNoOtherWorker) {
    workers::RenderSettings settings = quickSettings();
    settings.frameDeadline = milliseconds{8'000};
    const Service service = startService(settings);
    ASSERT_TRUE(service.service);
    service.service->measure(longMeasurement(service));
    ASSERT_TRUE(service.draw(turned(service, 1)));
    ASSERT_EQ(::kill(service.pid(), SIGSTOP), 0);
    const auto measured = service.events->waitForMeasurement(1);
    ASSERT_TRUE(measured);
    ASSERT_FALSE(measured->has_value());
    EXPECT_EQ(measured->error().code, ErrorCode::kDeviceLost);
    EXPECT_NE(measured->error().message.find("8000 ms for a measurement"), std::string::npos)
        << measured->error().message;
    EXPECT_TRUE(service.draw(turned(service, 2)));
    EXPECT_EQ(service.service->status().losses, 1U);
}

TEST(Measuring, PastItsDeadlineItEndsAndTheWorkerLivesOn) {
    workers::RenderSettings settings = quickSettings();
    settings.measureDeadline = milliseconds{20};
    const Service service = startService(settings);
    ASSERT_TRUE(service.service);
    service.service->measure(longMeasurement(service));
    const auto measured = service.events->waitForMeasurement(1);
    ASSERT_TRUE(measured);
    ASSERT_FALSE(measured->has_value());
    EXPECT_EQ(measured->error().code, ErrorCode::kTimeout);
    EXPECT_NE(measured->error().message.find("20 ms"), std::string::npos);
    EXPECT_TRUE(service.draw(turned(service, 1)));
    EXPECT_EQ(service.service->status().losses, 0U);
}

}  // namespace
}  // namespace volcast::test
