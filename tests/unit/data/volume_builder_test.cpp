#include "renderer/data/volume_builder.h"

#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "renderer/data/dataset.h"

namespace volcast::data {
namespace {

template <class T>
std::vector<std::byte> bytesOf(const std::vector<T>& values) {
    std::vector<std::byte> bytes(values.size() * sizeof(T));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

VolumeInput ramp(glm::ivec3 size) {
    std::vector<float> values;
    for (int z = 0; z < size.z; ++z) {
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) values.push_back(static_cast<float>(x + 100 * y));
        }
    }
    VolumeInput input;
    input.size = size;
    input.channels.push_back({.name = "ramp", .unit = "", .voxels = bytesOf(values)});
    return input;
}

TEST(VolumeBuilder, RangeAndBricksAreThoseOfTheVoxels) {
    const auto volume = buildVolume(ramp({34, 17, 3}));
    ASSERT_TRUE(volume) << volume.error().message;
    const Channel& channel = volume->channels[0];
    EXPECT_EQ(channel.range, (Range{0.0F, 33.0F + 1600.0F}));
    // 33 intervals along x make three bricks, 16 along y one, 2 along z one.
    EXPECT_EQ(volume->brickGrid(), glm::ivec3(3, 1, 1));
    ASSERT_EQ(channel.bricks.size(), 3U);
    EXPECT_EQ(channel.bricks[0], glm::vec2(0.0F, 1616.0F));
    EXPECT_EQ(channel.bricks[1], glm::vec2(16.0F, 1632.0F));
    EXPECT_EQ(channel.bricks[2], glm::vec2(32.0F, 1633.0F));
}

TEST(VolumeBuilder, EveryVoxelTypeIsRead) {
    const auto rangeOf = [](VoxelType type, std::vector<std::byte> voxels) {
        VolumeInput input;
        input.size = {2, 1, 1};
        input.type = type;
        input.channels.push_back({.name = "c", .unit = "", .voxels = std::move(voxels)});
        return buildVolume(std::move(input)).value().channels[0].range;
    };
    EXPECT_EQ(rangeOf(VoxelType::kU8, bytesOf<std::uint8_t>({7, 255})), (Range{7.0F, 255.0F}));
    EXPECT_EQ(rangeOf(VoxelType::kU16, bytesOf<std::uint16_t>({65535, 3})),
              (Range{3.0F, 65535.0F}));
    EXPECT_EQ(rangeOf(VoxelType::kI16, bytesOf<std::int16_t>({-32768, 5})),
              (Range{-32768.0F, 5.0F}));
    EXPECT_EQ(rangeOf(VoxelType::kF32, bytesOf<float>({-1.5F, 2.5F})), (Range{-1.5F, 2.5F}));
}

TEST(VolumeBuilder, InfinityIsRefusedByItsPlace) {
    VolumeInput input = ramp({4, 3, 2});
    const float bad = std::numeric_limits<float>::infinity();
    std::memcpy(input.channels[0].voxels.data() + (12 + 4 + 2) * sizeof(float), &bad, sizeof(bad));
    const auto error = buildVolume(input).error();
    EXPECT_EQ(error.code, ErrorCode::kInvalidArgument);
    EXPECT_NE(error.message.find("(2, 1, 1)"), std::string::npos) << error.message;
    EXPECT_NE(error.message.find("inf"), std::string::npos) << error.message;
}

VolumeInput withMissing(VolumeInput input, const std::vector<std::size_t>& voxels) {
    const float missing = std::numeric_limits<float>::quiet_NaN();
    for (const std::size_t i : voxels) {
        std::memcpy(input.channels[0].voxels.data() + i * sizeof(float), &missing, sizeof(float));
    }
    return input;
}

TEST(VolumeBuilder, VoxelsWithoutAValueAreCountedAndHaveNoPartInRanges) {
    // The first brick of 17 columns loses its smallest and its largest value, the third all.
    const std::vector<std::size_t> missing{0, 33, 32};
    const auto volume = buildVolume(withMissing(ramp({34, 1, 1}), missing));
    ASSERT_TRUE(volume) << volume.error().message;
    const Channel& channel = volume->channels[0];
    EXPECT_EQ(channel.voxelsWithoutValue, 3U);
    EXPECT_EQ(channel.range, (Range{1.0F, 31.0F}));
    EXPECT_EQ(channel.bricks[0], glm::vec2(1.0F, 16.0F));
    EXPECT_EQ(channel.bricks[1], glm::vec2(16.0F, 31.0F));
    const float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(channel.bricks[2], glm::vec2(infinity, -infinity));
}

TEST(VolumeBuilder, VoxelsWithoutAValueAreWarnedOfAndNotSummarized) {
    const DatasetSummary one = summarize(buildVolume(withMissing(ramp({8, 8, 64}), {9})).value());
    EXPECT_EQ(one.fields[0].voxelsWithoutValue, 1U);
    EXPECT_EQ(warningsOf(one), std::vector<std::string>{
                                   "1 of 4096 voxels of \"ramp\" is NaN and is drawn as empty"});
    std::size_t counted = 0;
    for (const std::uint32_t bin : one.fields[0].spread.histogram) counted += bin;
    EXPECT_EQ(counted, 4095U);
    for (const float percentile : one.fields[0].spread.percentiles) {
        EXPECT_TRUE(std::isfinite(percentile));
    }
    const DatasetSummary two =
        summarize(buildVolume(withMissing(ramp({8, 8, 64}), {1, 9})).value());
    EXPECT_EQ(warningsOf(two), std::vector<std::string>{
                                   "2 of 4096 voxels of \"ramp\" are NaN and are drawn as empty"});
    EXPECT_TRUE(warningsOf(summarize(buildVolume(ramp({8, 8, 64})).value())).empty());
}

TEST(VolumeBuilder, AChannelOfNanAloneIsRefused) {
    const auto error = buildVolume(withMissing(ramp({2, 2, 1}), {0, 1, 2, 3})).error();
    EXPECT_EQ(error.code, ErrorCode::kInvalidArgument);
    EXPECT_EQ(error.message, "channel 'ramp': has no value, all 4 voxels are NaN");
}

TEST(VolumeBuilder, BadGridsAreRefused) {
    const auto codeOf = [](const auto& change) {
        VolumeInput input = ramp({4, 3, 2});
        change(input);
        const auto volume = buildVolume(input);
        return volume ? "accepted" : name(volume.error().code);
    };
    EXPECT_STREQ(codeOf([](auto& v) { v.size.x = 0; }), "invalid_argument");
    EXPECT_STREQ(codeOf([](auto& v) { v.size.x = 5; }), "invalid_argument");
    EXPECT_STREQ(codeOf([](auto& v) { v.size = glm::ivec3{kMaxVolumeSide + 1}; }),
                 "limit_exceeded");
    EXPECT_STREQ(codeOf([](auto& v) { v.size = glm::ivec3{kMaxVolumeSide}; }), "limit_exceeded");
    EXPECT_STREQ(codeOf([](auto& v) { v.spacing.y = 0.0; }), "invalid_argument");
    EXPECT_STREQ(codeOf([](auto& v) { v.spacing.y = std::nan(""); }), "invalid_argument");
    EXPECT_STREQ(codeOf([](auto& v) { v.origin.z = std::nan(""); }), "invalid_argument");
    EXPECT_STREQ(codeOf([](auto& v) { v.direction[0] = glm::dvec3{1, 1, 0}; }), "unsupported");
    EXPECT_STREQ(codeOf([](auto& v) { v.direction[0].x = std::nan(""); }), "unsupported");
    EXPECT_STREQ(codeOf([](auto& v) { v.channels.clear(); }), "invalid_argument");
    EXPECT_STREQ(codeOf([](auto& v) { v.channels.push_back(v.channels[0]); }), "invalid_argument");
    EXPECT_STREQ(codeOf([](auto&) {}), "accepted");
}

TEST(VolumeBuilder, AxesBecomeExactlyOrthonormal) {
    VolumeInput input = ramp({4, 3, 2});
    input.direction = glm::dmat3{{0.8, 0.600001, 0}, {-0.6, 0.8, 1e-5}, {0, 0, -1}};
    const auto volume = buildVolume(input);
    ASSERT_TRUE(volume);
    const glm::dmat3 product = glm::transpose(volume->direction) * volume->direction;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) EXPECT_NEAR(product[i][j], i == j ? 1.0 : 0.0, 1e-14);
    }
    EXPECT_LT(volume->direction[2].z, -0.99) << "left-handed axes stay left-handed";
}

TEST(DatasetSummary, VolumeBoundsAreThoseOfTheTurnedBox) {
    VolumeInput input = ramp({5, 3, 2});
    input.spacing = {1, 2, 3};
    input.origin = {10, 20, 30};
    input.direction = glm::dmat3{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}};
    const DatasetSummary summary = summarize(buildVolume(input).value());
    EXPECT_FALSE(summary.isMesh);
    EXPECT_EQ(summary.bounds.min, glm::dvec3(6, 20, 30));
    EXPECT_EQ(summary.bounds.max, glm::dvec3(10, 24, 33));
    ASSERT_EQ(summary.fields.size(), 1U);
    EXPECT_EQ(summary.bytes, 30 * sizeof(float) + sizeof(glm::vec2));
}

TEST(DatasetSummary, HistogramCountsEveryValueOfSmallData) {
    VolumeInput input;
    input.size = {4, 1, 1};
    input.channels.push_back({.name = "c", .unit = "", .voxels = bytesOf<float>({0, 1, 1, 256})});
    const auto fields = summarize(buildVolume(input).value()).fields;
    ASSERT_EQ(fields[0].spread.histogram.size(), 256U);
    EXPECT_EQ(fields[0].spread.histogram[0], 1U);
    EXPECT_EQ(fields[0].spread.histogram[1], 2U);
    EXPECT_EQ(fields[0].spread.histogram[255], 1U);
}

// 2^14 equal steps through rows of 2^k voxels would meet but one or a few columns.
TEST(DatasetSummary, HistogramMeetsAllColumnsOfLargeData) {
    constexpr int kSide = 128;
    std::vector<float> values;
    for (int i = 0; i < kSide * kSide * kSide; ++i) {
        values.push_back(static_cast<float>(i % kSide));
    }
    VolumeInput input;
    input.size = glm::ivec3(kSide);
    input.channels.push_back({.name = "x", .unit = "", .voxels = bytesOf(values)});
    const auto fields = summarize(buildVolume(input).value()).fields;
    std::uint32_t counted = 0;
    for (int quarter = 0; quarter < 4; ++quarter) {
        std::uint32_t count = 0;
        for (std::size_t i = 0; i < 64; ++i) {
            count += fields[0].spread.histogram[64 * static_cast<std::size_t>(quarter) + i];
        }
        EXPECT_NEAR(count, 1 << 12, 64) << quarter;
        counted += count;
    }
    EXPECT_EQ(counted, 1U << 14);
}

}  // namespace
}  // namespace volcast::data
