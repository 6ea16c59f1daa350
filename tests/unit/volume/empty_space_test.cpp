// What is known of blocks of voxels, against loops over all of them.
#include "renderer/volume/empty_space.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "renderer/data/volume_builder.h"
#include "renderer/volume/block_ranges.h"

namespace volcast::volume {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Calls f(place, index) for all places of a grid, x fastest.
template <class F>
void forAll(glm::ivec3 grid, F f) {
    std::size_t i = 0;
    for (int z = 0; z < grid.z; ++z) {
        for (int y = 0; y < grid.y; ++y) {
            for (int x = 0; x < grid.x; ++x) f(glm::ivec3{x, y, z}, i++);
        }
    }
}

std::size_t cells(glm::ivec3 grid) {
    return static_cast<std::size_t>(grid.x) * grid.y * grid.z;
}

TEST(EmptySpace, DistancesAreThoseToTheNearestBlockThatShows) {
    std::mt19937 random{7};
    for (const glm::ivec3 grid : {glm::ivec3{13, 9, 11}, {1, 17, 5}, {40, 1, 1}, {1, 1, 1}}) {
        for (const double share : {0.002, 0.02, 0.3, 0.98}) {
            std::vector<std::uint8_t> shows(cells(grid));
            std::bernoulli_distribution showing{share};
            for (std::uint8_t& one : shows) one = showing(random) ? 1 : 0;
            const auto distances = distancesToShowing(shows, grid);
            forAll(grid, [&](glm::ivec3 at, std::size_t i) {
                int nearest = 255;
                forAll(grid, [&](glm::ivec3 other, std::size_t j) {
                    const glm::ivec3 off = glm::abs(other - at);
                    if (shows[j] == 1) nearest = std::min(nearest, std::max({off.x, off.y, off.z}));
                });
                ASSERT_EQ(distances[i], nearest) << at.x << ' ' << at.y << ' ' << at.z;
            });
        }
    }
}

TEST(EmptySpace, DistancesEndAt255) {
    std::vector<std::uint8_t> shows(400);
    shows[0] = 1;
    const auto distances = distancesToShowing(shows, {400, 1, 1});
    EXPECT_EQ(distances[254], 254);
    EXPECT_EQ(distances[255], 255);
    EXPECT_EQ(distances[399], 255);
}

TEST(EmptySpace, BlocksShowWhereTheirRangeHoldsAShownValue) {
    const ShownValues shown{{-kInfinity, -4.0F}, {1.0F, 2.0F}, {5.0F, 5.0F}};
    const std::vector<glm::vec2> ranges{
        {-9, -8}, {-5, 0},   {-3.9F, 0.9F},          {0, 1}, {2, 3}, {3, 4}, {3, 6}, {5.1F, 99},
        {-4, -4}, {-20, 20}, {kInfinity, -kInfinity}};
    const std::vector<std::uint8_t> expected{1, 1, 0, 1, 1, 0, 1, 0, 1, 1, 0};
    EXPECT_EQ(showingBlocks(ranges, shown, 0.0F), expected);
    EXPECT_EQ(showingBlocks(ranges, {}, 0.0F), std::vector<std::uint8_t>(ranges.size(), 0));
    // [3, 4] and half of its extent to both sides is [2.5, 4.5].
    EXPECT_EQ(showingBlocks(std::vector<glm::vec2>{{3, 4}}, {{4.4F, 4.6F}}, 0.5F),
              std::vector<std::uint8_t>{1});
    EXPECT_EQ(showingBlocks(std::vector<glm::vec2>{{3, 4}}, {{4.6F, 4.7F}}, 0.5F),
              std::vector<std::uint8_t>{0});
}

TEST(EmptySpace, RangesAreOfTheVoxelsOfABlockAndAroundIt) {
    std::mt19937 random{3};
    std::uniform_real_distribution<float> values{-1.0F, 1.0F};
    for (const glm::ivec3 size : {glm::ivec3{9, 14, 5}, {1, 30, 2}, {8, 8, 8}}) {
        data::ChannelInput channel{.name = "f", .unit = "", .voxels = {}};
        std::vector<float> voxels(cells(size));
        for (float& voxel : voxels) voxel = values(random);
        channel.voxels.resize(voxels.size() * sizeof(float));
        std::memcpy(channel.voxels.data(), voxels.data(), channel.voxels.size());
        data::VolumeInput input;
        input.size = size;
        input.channels.push_back(std::move(channel));
        const auto volume = data::buildVolume(std::move(input));
        ASSERT_TRUE(volume.has_value());
        const glm::ivec3 grid = blockGrid(size);
        // Joined around: a block more.
        const auto joined = joinedAround(blockRanges(*volume, volume->channels[0], 0), grid);
        for (const int around : {0, 1, kRangeBlock}) {
            const auto found =
                around == kRangeBlock ? joined : blockRanges(*volume, volume->channels[0], around);
            ASSERT_EQ(found.size(), cells(grid));
            forAll(grid, [&](glm::ivec3 block, std::size_t i) {
                glm::vec2 range{kInfinity, -kInfinity};
                forAll(size, [&](glm::ivec3 at, std::size_t j) {
                    const glm::ivec3 low = block * kRangeBlock - around;
                    const glm::ivec3 high = (block + 1) * kRangeBlock + around;
                    if (glm::any(glm::lessThan(at, low)) || glm::any(glm::greaterThan(at, high))) {
                        return;
                    }
                    range = {std::min(range.x, voxels[j]), std::max(range.y, voxels[j])};
                });
                ASSERT_EQ(found[i], range) << around << ' ' << i;
            });
        }
    }
}

}  // namespace
}  // namespace volcast::volume
