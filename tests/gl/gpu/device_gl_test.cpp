#include <array>
#include <thread>

#include "gmock/gmock.h"

#include "renderer/gpu/buffer.h"
#include "renderer/gpu/target.h"
#include "renderer/gpu/texture3d.h"
#include "renderer/gpu/timer.h"
#include "tests/support/gl_test.h"

namespace volcast::gpu {
namespace {

using support::must;
using ::testing::HasSubstr;

class DeviceTest : public support::GlTest {};

TEST_F(DeviceTest, SaysWhatItFound) {
    const DeviceInfo& info = device().info();
    EXPECT_FALSE(info.glRenderer.empty());
    EXPECT_FALSE(info.glVersion.empty());
    EXPECT_GE(info.limits.textureSide, 16384);
    EXPECT_GE(info.limits.texture3DSide, 2048);
    EXPECT_GE(info.limits.texelBufferTexels, 65536);
    EXPECT_GE(info.limits.uniformBlockBytes, 16384);
    EXPECT_EQ(device().resetStatus(), ResetStatus::kNone);
    EXPECT_TRUE(device().onDeviceThread());
    std::thread{[&] { EXPECT_FALSE(device().onDeviceThread()); }}.join();
}

TEST_F(DeviceTest, AnUnknownGpuIsNotFound) {
    for (const char* gpu : {"99", "-1", "/dev/dri/none", "1x", "anything"}) {
        const auto opened = Device::create({.gpu = gpu});
        ASSERT_TRUE(opened.has_error()) << gpu;
        EXPECT_EQ(opened.error().code, ErrorCode::kNotFound) << gpu;
    }
}

// On a thread of its own: a context that another replaces on this thread would be lost to the
// other tests.
TEST_F(DeviceTest, EveryListedEglDeviceWithSoftwareGlOpensByItsIndex) {
    for (const EglDeviceInfo& listed : listEgl().deviceList) {
        if (!listed.software) continue;
        std::thread{[&] {
            const auto opened = Device::create({.gpu = std::to_string(listed.index)});
            ASSERT_TRUE(opened.has_value()) << opened.error().message;
            EXPECT_THAT((*opened)->info().platform,
                        HasSubstr("device " + std::to_string(listed.index)));
        }}.join();
    }
}

TEST_F(DeviceTest, AfterBeingGivenUpObjectsForgetTheirNames) {
    std::thread{[] {
        const auto own = must(Device::create());
        Buffer buffer = must(Buffer::create(*own, {.bytes = 16, .label = "b"}));
        const Texture2D texture = must(Texture2D::create(*own, {.label = "t"}));
        own->abandon();
        EXPECT_FALSE(own->alive());
        EXPECT_EQ(own->check("anything").error().code, ErrorCode::kDeviceLost);
        EXPECT_EQ(Timer{*own}.lapMs().error().code, ErrorCode::kDeviceLost);
        own->abandon();
    }}.join();  // The destructors above must not call GL: there is no context.
}

TEST_F(DeviceTest, SizesBeyondTheLimitsAreRefused) {
    const int side = device().limits().texture3DSide + 1;
    EXPECT_EQ(Texture3D::create(device(), {.size = {1, side, 1}, .label = "v"}).error().code,
              ErrorCode::kLimitExceeded);
    EXPECT_EQ(Texture3D::create(device(), {.size = {0, 1, 1}, .label = "v"}).error().code,
              ErrorCode::kLimitExceeded);
    const auto flat = Texture2D::create(
        device(), {.size = {device().limits().textureSide + 1, 1}, .label = "flat"});
    ASSERT_TRUE(flat.has_error());
    EXPECT_EQ(flat.error().code, ErrorCode::kLimitExceeded);
    EXPECT_THAT(flat.error().message, HasSubstr("flat"));
    EXPECT_EQ(Buffer::create(device(), {.bytes = 0, .label = "b"}).error().code,
              ErrorCode::kInvalidArgument);
    const std::array<std::byte, 8> bytes{};
    EXPECT_EQ(Buffer::create(device(), {.bytes = 4, .label = "b"}, bytes).error().code,
              ErrorCode::kInvalidArgument);
}

TEST_F(DeviceTest, TooManyBytesOfVoxelsAreRefused) {
    Texture3D texture = must(Texture3D::create(device(), {.size = {2, 2, 2}, .label = "v"}));
    const std::array<float, 9> voxels{};
    EXPECT_EQ(texture.upload(0, 2, std::as_bytes(std::span{voxels})).error().code,
              ErrorCode::kInvalidArgument);
    EXPECT_EQ(texture.upload(1, 2, std::as_bytes(std::span{voxels}.first(8))).error().code,
              ErrorCode::kInvalidArgument);
    EXPECT_TRUE(texture.upload(0, 2, std::as_bytes(std::span{voxels}.first(8))).has_value());
}

// More memory than any device has: an Error, not an abort, and the device goes on.
TEST_F(DeviceTest, OutOfMemoryIsAnError) {
    const int side = device().limits().texture3DSide;
    const auto huge = Texture3D::create(
        device(), {.size = {side, side, side}, .format = VoxelFormat::kRg32F, .label = "huge"});
    ASSERT_TRUE(huge.has_error());
    EXPECT_EQ(huge.error().code, ErrorCode::kOutOfGpuMemory);
    EXPECT_THAT(huge.error().message, HasSubstr("huge"));
    EXPECT_TRUE(Texture3D::create(device(), {.size = {4, 4, 4}, .label = "small"}).has_value());
}

TEST_F(DeviceTest, ATargetHoldsWhatItWasClearedTo) {
    const auto colour = must(Texture2D::create(device(), {.size = {2, 2}, .label = "c"}));
    const auto distance = must(Texture2D::create(
        device(), {.size = {2, 2}, .format = PixelFormat::kR32F, .label = "distance"}));
    const std::array colours{&colour, &distance};
    const Target target = must(Target::create(device(), "t", colours));
    target.clearColour(0, {0.25F, 0.5F, 0.75F, 1.0F});
    target.clearColour(1, glm::vec4(3.0e38F));
    std::array<float, 16> pixels{};
    target.readRgba32F(pixels);
    EXPECT_EQ(pixels[4], 0.25F);
    EXPECT_EQ(pixels[15], 1.0F);
    target.readRgba32F(pixels, 1);
    EXPECT_EQ(pixels[8], 3.0e38F);
}

}  // namespace
}  // namespace volcast::gpu
