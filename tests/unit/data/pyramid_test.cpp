#include "renderer/data/pyramid.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "renderer/base/memfd.h"
#include "renderer/data/packed_dataset.h"
#include "renderer/data/volume_builder.h"

namespace volcast::data {
namespace {

/// A volume of `size` whose voxel (x, y, z) is valueAt(x, y, z).
template <class T, class ValueAt>
Volume volumeOf(VoxelType type, glm::ivec3 size, const ValueAt& valueAt,
                const std::function<void(double)>& progress = {}) {
    std::vector<std::byte> voxels(static_cast<std::size_t>(size.x) * size.y * size.z * sizeof(T));
    std::size_t i = 0;
    for (int z = 0; z < size.z; ++z) {
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x, ++i) {
                const auto value = static_cast<T>(valueAt(x, y, z));
                std::memcpy(voxels.data() + i * sizeof(T), &value, sizeof(T));
            }
        }
    }
    VolumeInput input{.size = size, .type = type};
    input.channels.push_back({.name = "c", .voxels = std::move(voxels)});
    return buildVolume(std::move(input), progress).value();
}

template <class T>
T voxelOf(const Volume& volume, int level, glm::ivec3 point) {
    const Channel& channel = volume.channels[0];
    const auto& voxels =
        level == 0 ? channel.voxels : channel.coarser[static_cast<std::size_t>(level) - 1].voxels;
    const glm::ivec3 size = volume.levelSize(level);
    T value{};
    std::memcpy(
        &value,
        voxels.data() +
            ((static_cast<std::size_t>(point.z) * size.y + point.y) * size.x + point.x) * sizeof(T),
        sizeof(T));
    return value;
}

template <class Use>
void forEachPoint(glm::ivec3 size, const Use& use) {
    for (int z = 0; z < size.z; ++z) {
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) use(glm::ivec3{x, y, z});
        }
    }
}

TEST(Pyramid, VoxelsWithoutAValueAreLeftOutOfMeans) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    // A constant stays so beside a hole; within one, where no fine point counts, there is nothing.
    const auto valueAt = [&](int x, int y, int z) {
        const glm::ivec3 from = glm::abs(glm::ivec3{x, y, z} - glm::ivec3{64, 60, 62});
        return std::max({from.x, from.y, from.z}) <= 5 ? nan : 7.0F;
    };
    const Volume volume = volumeOf<float>(VoxelType::kF32, {131, 128, 126}, valueAt);
    EXPECT_EQ(volume.channels[0].voxelsWithoutValue, 11U * 11U * 11U);
    int missing = 0;
    forEachPoint(volume.levelSize(1), [&](glm::ivec3 point) {
        const float value = voxelOf<float>(volume, 1, point);
        const glm::ivec3 from = glm::abs(2 * point - glm::ivec3{64, 60, 62});
        const bool within = std::max({from.x, from.y, from.z}) <= 4;  // Neighbours reach by 1.
        ASSERT_EQ(std::isnan(value), within) << point.x << ' ' << point.y << ' ' << point.z;
        missing += within ? 1 : 0;
        ASSERT_FLOAT_EQ(within ? 7.0F : value, 7.0F);
    });
    EXPECT_EQ(missing, 5 * 5 * 5);
    // Three points of level 1, 30 to 34 along x, have none around them either.
    EXPECT_TRUE(std::isnan(voxelOf<float>(volume, 2, {16, 15, 15})));
    EXPECT_FLOAT_EQ(voxelOf<float>(volume, 2, {17, 15, 15}), 7.0F);
    EXPECT_FLOAT_EQ(voxelOf<float>(volume, 3, {8, 7, 7}), 7.0F);
}

TEST(Pyramid, SmallVolumesHaveNone) {
    EXPECT_EQ(pyramidLevels({127, 128, 128}), 0);
    EXPECT_EQ(pyramidLevels({128, 128, 128}), 2);
    EXPECT_EQ(pyramidLevels({129, 129, 129}), 2) << "128 intervals are 4 times 32";
    EXPECT_EQ(pyramidLevels({130, 129, 129}), 3);
    EXPECT_EQ(pyramidLevels({1024, 1024, 1024}), 5);
    EXPECT_EQ(pyramidLevels({kMaxVolumeSide, 64, 1}), 10);
    EXPECT_EQ(volumeOf<float>(VoxelType::kF32, {40, 30, 20}, [](int, int, int) { return 1; })
                  .coarserLevels(),
              0);
}

TEST(Pyramid, EveryLevelHasTheFacesOfTheBox) {
    const Volume volume{.size = {130, 129, 1}, .channels = {}};
    EXPECT_EQ(volume.levelSize(0), glm::ivec3(130, 129, 1));
    EXPECT_EQ(volume.levelSize(1), glm::ivec3(66, 65, 1));
    EXPECT_EQ(volume.levelSize(3), glm::ivec3(18, 17, 1));
    EXPECT_EQ(volume.brickGrid(1), glm::ivec3(5, 4, 1));
}

// All numbers below are sums of few powers of two: the means are exact.
TEST(Pyramid, LinearFieldsAreTheSameOnAllLevels) {
    const auto field = [](int x, int y, int z) {
        return 7.0F + 2.0F * static_cast<float>(x) - 3.0F * static_cast<float>(y) +
               0.5F * static_cast<float>(z);
    };
    const Volume volume = volumeOf<float>(VoxelType::kF32, {135, 128, 124}, field);
    ASSERT_EQ(volume.coarserLevels(), 3);
    for (int level = 1; level <= 3; ++level) {
        forEachPoint(volume.levelSize(level), [&](glm::ivec3 point) {
            const glm::ivec3 at = glm::min(point << level, volume.size - 1);
            ASSERT_EQ(voxelOf<float>(volume, level, point), field(at.x, at.y, at.z))
                << level << ": " << point.x << " " << point.y << " " << point.z;
        });
    }
}

TEST(Pyramid, APeakIsSpreadByQuartersAndRounded) {
    const Volume volume = volumeOf<std::uint8_t>(
        VoxelType::kU8, {128, 128, 128},
        [](int x, int y, int z) { return x == 64 && y == 64 && z == 63 ? 200 : 0; });
    // A half along x and y, a quarter along z, which lies between points 31 and 32.
    EXPECT_EQ(voxelOf<std::uint8_t>(volume, 1, {32, 32, 31}), 12) << "12.5, to even";
    EXPECT_EQ(voxelOf<std::uint8_t>(volume, 1, {32, 32, 32}), 12);
    EXPECT_EQ(voxelOf<std::uint8_t>(volume, 1, {33, 32, 32}), 0);
}

TEST(Pyramid, ConstantsStayAsTheyAre) {
    const float odd = 1.0F / 3.0F;
    const Volume volume =
        volumeOf<float>(VoxelType::kF32, {150, 121, 117}, [odd](int, int, int) { return odd; });
    for (int level = 1; level <= volume.coarserLevels(); ++level) {
        forEachPoint(volume.levelSize(level), [&](glm::ivec3 point) {
            ASSERT_EQ(voxelOf<float>(volume, level, point), odd);
        });
    }
}

TEST(Pyramid, RangesBoundTheLevelAndAllBeneathIt) {
    std::mt19937 random{7};
    const Volume volume =
        volumeOf<std::int16_t>(VoxelType::kI16, {131, 128, 127}, [&random](int x, int, int) {
            return static_cast<int>(random() % 2000) - 1000 + 40 * (x % 64);
        });
    const int levels = volume.coarserLevels();
    ASSERT_EQ(levels, 3);
    for (int level = 1; level <= levels; ++level) {
        const auto& bricks = volume.channels[0].coarser[static_cast<std::size_t>(level) - 1].bricks;
        const glm::ivec3 grid = volume.brickGrid(level);
        ASSERT_EQ(bricks.size(), static_cast<std::size_t>(grid.x) * grid.y * grid.z);
        forEachPoint(grid, [&](glm::ivec3 brick) {
            glm::vec2 expected{1e9F, -1e9F};
            for (int finer = 0; finer <= level; ++finer) {
                const glm::ivec3 first = (Volume::kBrickSize * brick) << (level - finer);
                const glm::ivec3 last = glm::min(first + (Volume::kBrickSize << (level - finer)),
                                                 volume.levelSize(finer) - 1);
                forEachPoint(last - first + 1, [&](glm::ivec3 point) {
                    const auto value =
                        static_cast<float>(voxelOf<std::int16_t>(volume, finer, first + point));
                    expected = {std::min(expected.x, value), std::max(expected.y, value)};
                });
            }
            ASSERT_EQ(
                bricks[(static_cast<std::size_t>(brick.z) * grid.y + brick.y) * grid.x + brick.x],
                expected);
        });
    }
}

TEST(Pyramid, ProgressGrowsToTheEnd) {
    double last = 0.0;
    volumeOf<std::uint8_t>(
        VoxelType::kU8, {128, 128, 128}, [](int x, int, int) { return x; },
        [&last](double share) {
            EXPECT_GE(share, last);
            last = share;
        });
    EXPECT_GT(last, 0.98);
    EXPECT_LE(last, 1.0);
}

TEST(Pyramid, IsPackedWithItsVolume) {
    const Volume volume = volumeOf<std::uint16_t>(VoxelType::kU16, {129, 128, 128},
                                                  [](int x, int y, int z) { return x * y + z; });
    const auto fd = pack(volume).value();
    for (const Trust trust : {Trust::kNone, Trust::kVoxelsChecked}) {
        const auto back = std::get<Volume>(unpack(fd, trust).value());
        ASSERT_EQ(back.coarserLevels(), 2);
        for (std::size_t level = 0; level < 2; ++level) {
            const ChannelLevel& before = volume.channels[0].coarser[level];
            const ChannelLevel& after = back.channels[0].coarser[level];
            EXPECT_TRUE(std::ranges::equal(before.voxels, after.voxels));
            EXPECT_TRUE(std::ranges::equal(before.bricks, after.bricks));
        }
    }
}

TEST(Pyramid, DamagedLevelsAreRefused) {
    Volume volume =
        volumeOf<float>(VoxelType::kF32, {128, 128, 128}, [](int x, int, int) { return x; });
    const auto refusal = [&volume](const auto& change) {
        Volume damaged = volume;
        change(damaged.channels[0]);
        const auto result = unpack(pack(damaged).value());
        return result ? std::string{"accepted"} : result.error().message;
    };
    const auto shorter = [](auto& array) {
        using T = std::remove_cvref_t<decltype(array[0])>;
        array = std::vector<T>(array.begin(), array.end() - 1);
    };
    EXPECT_EQ(refusal([](Channel& c) { c.coarser.pop_back(); }),
              "packed dataset: channel 'c': wrong number of levels");
    EXPECT_EQ(refusal([](Channel& c) { c.coarser.clear(); }),
              "packed dataset: channel 'c': wrong number of levels");
    EXPECT_EQ(refusal([&](Channel& c) { shorter(c.coarser[1].voxels); }),
              "packed dataset: channel 'c': level 2: wrong number of bytes");
    EXPECT_EQ(refusal([&](Channel& c) { shorter(c.coarser[0].bricks); }),
              "packed dataset: channel 'c': level 1: wrong number of bricks");
    EXPECT_EQ(refusal([](Channel& c) {
                  std::vector<std::byte> voxels(c.coarser[0].voxels.size(), std::byte{0xFF});
                  c.coarser[0].voxels = voxels;
              }),
              "packed dataset: channel 'c': level 1: a voxel lies outside the channel's range");
    EXPECT_EQ(refusal([](Channel& c) {
                  c.coarser[1].bricks =
                      std::vector<glm::vec2>(c.coarser[1].bricks.size(), glm::vec2{-1.0F, 5.0F});
              }),
              "packed dataset: channel 'c': level 2: a brick is damaged");
}

}  // namespace
}  // namespace volcast::data
