#include "renderer/data/moments.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace volcast::data {
namespace {

Dataset volumeOf(VoxelType type, std::vector<std::byte> bytes, int count) {
    Volume volume;
    volume.size = {count, 1, 1};
    volume.type = type;
    Channel channel;
    channel.voxels = base::Array<std::byte>{std::move(bytes)};
    volume.channels.push_back(std::move(channel));
    return volume;
}

template <class T>
std::vector<std::byte> bytesOf(const std::vector<T>& values) {
    const auto bytes = std::as_bytes(std::span{values});
    return {bytes.begin(), bytes.end()};
}

// 0, 1 ... n - 1: the mean is (n - 1) / 2, the variance (n^2 - 1) / 12; over several blocks.
TEST(Moments, AreThoseOfAllValues) {
    constexpr int kCount = 50'000;
    std::vector<std::uint16_t> values(kCount);
    for (int i = 0; i < kCount; ++i)
        values[static_cast<std::size_t>(i)] = static_cast<std::uint16_t>(i);
    const auto found = momentsOf(volumeOf(VoxelType::kU16, bytesOf(values), kCount));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].values, static_cast<std::uint64_t>(kCount));
    EXPECT_DOUBLE_EQ(found[0].mean, (kCount - 1) / 2.0);
    EXPECT_NEAR(found[0].deviation, std::sqrt((double{kCount} * kCount - 1.0) / 12.0), 1e-8);
}

// A large offset takes the digits of a sum of squares, but not of distances from the mean.
TEST(Moments, KeepTheirDigitsFarFromZero) {
    std::vector<float> values;
    for (int i = 0; i < 40'000; ++i) values.push_back(8e6F + static_cast<float>(i % 2));
    const auto found = momentsOf(volumeOf(VoxelType::kF32, bytesOf(values), 40'000));
    EXPECT_NEAR(found[0].mean, 8e6 + 0.5, 1e-6);
    EXPECT_NEAR(found[0].deviation, 0.5, 1e-9);
}

TEST(Moments, LeaveNaNOut) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto some = momentsOf(volumeOf(VoxelType::kF32, bytesOf<float>({1, nan, 3}), 3));
    EXPECT_EQ(some[0].values, 2U);
    EXPECT_EQ(some[0].mean, 2.0);
    EXPECT_EQ(some[0].deviation, 1.0);
    const auto none = momentsOf(volumeOf(VoxelType::kF32, bytesOf<float>({nan}), 1));
    EXPECT_EQ(none[0].values, 0U);
    EXPECT_EQ(none[0].mean, 0.0);
}

TEST(Moments, OfSignedAndSmallTypes) {
    const auto small = momentsOf(volumeOf(VoxelType::kI16, bytesOf<std::int16_t>({-300, 100}), 2));
    EXPECT_EQ(small[0].mean, -100.0);
    EXPECT_EQ(small[0].deviation, 200.0);
    const auto bytes = momentsOf(volumeOf(VoxelType::kU8, bytesOf<std::uint8_t>({255, 255}), 2));
    EXPECT_EQ(bytes[0].mean, 255.0);
}

TEST(Moments, OfAMeshGoOverAllSteps) {
    Mesh mesh;
    Field field;
    field.steps.push_back(base::Array<float>{std::vector<float>{0, 1}});
    field.steps.push_back(base::Array<float>{std::vector<float>{2, 3}});
    mesh.fields.push_back(std::move(field));
    const auto found = momentsOf(Dataset{std::move(mesh)});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].values, 4U);
    EXPECT_EQ(found[0].mean, 1.5);
}

}  // namespace
}  // namespace volcast::data
