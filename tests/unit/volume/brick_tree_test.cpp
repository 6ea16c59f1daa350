#include "renderer/volume/brick_tree.h"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "renderer/shading/shared.h"

namespace volcast::volume {
namespace {

constexpr int kSide = shading::shared::kPoolBrick;

/// A volume without voxels: of `size`, with a pyramid of `levels` above it. A range is that of the
/// x coordinates of its brick.
data::Volume volumeOf(glm::ivec3 size, int levels) {
    data::Volume volume{.size = size, .channels = {}};
    volume.channels.emplace_back();
    const auto ranges = [&](int level) {
        const glm::ivec3 grid = volume.brickGrid(level);
        std::vector<glm::vec2> made;
        for (int i = 0; i < grid.x * grid.y * grid.z; ++i) {
            const int first = (i % grid.x) * (data::Volume::kBrickSize << level);
            made.emplace_back(first,
                              std::min(first + (data::Volume::kBrickSize << level), size.x - 1));
        }
        return made;
    };
    volume.channels[0].bricks = ranges(0);
    for (int level = 1; level <= levels; ++level) {
        volume.channels[0].coarser.push_back({.voxels = {}, .bricks = ranges(level)});
    }
    return volume;
}

/// From far in front of the middle of the face z = 0, all of it at level 0.
BrickView viewOf(const data::Volume& volume) {
    const glm::dvec3 middle = 0.5 * glm::dvec3(volume.size - 1);
    BrickView view;
    view.depth = {0, 0, 1, 1000};
    view.right = {1, 0, 0, -middle.x};
    view.up = {0, 1, 0, -middle.y};
    view.perspective = false;
    view.footprint = 0.5;
    view.stepWorld = 0.5;
    view.voxelWorld = 1.0;
    return view;
}

BrickTree choose(const data::Volume& volume, const BrickView& view, std::size_t capacity = 1000) {
    return chooseBricks(volume, volume.channels[0], view, capacity);
}

/// Volume, in bricks of level 0, of the needed leaves of each level.
std::map<int, int> leavesOf(const BrickTree& tree) {
    std::map<int, int> leaves;
    for (const BrickNode& node : tree.nodes) {
        if (node.need == Need::kNeeded && node.firstChild == 0) ++leaves[node.brick.level];
    }
    return leaves;
}

TEST(BrickTree, FineSamplingNeedsEveryBrickOfLevel0AndThoseAbove) {
    const data::Volume volume = volumeOf({129, 129, 129}, 2);
    const BrickTree tree = choose(volume, viewOf(volume));
    EXPECT_EQ(leavesOf(tree), (std::map<int, int>{{0, 64}}));
    EXPECT_EQ(tree.order.size(), 1U + 8U + 64U);
    EXPECT_EQ(tree.hidden + tree.outside, 0U);
    EXPECT_EQ(tree.finest, 0);
    EXPECT_EQ(tree.coarsest, 0);
    EXPECT_FALSE(tree.limited);
}

TEST(BrickTree, BricksThatAreMissingInAnOddGridAreNotCounted) {
    const data::Volume volume = volumeOf({70, 40, 20}, 2);  // 3 x 2 x 1 bricks
    const BrickTree tree = choose(volume, viewOf(volume));
    EXPECT_EQ(leavesOf(tree), (std::map<int, int>{{0, 6}}));
    EXPECT_EQ(tree.outside, 0U);
    for (const BrickNode& node : tree.nodes)
        EXPECT_EQ(node.firstChild % 8, node.firstChild ? 1 : 0);
}

TEST(BrickTree, TheFinestLevelIsNoFinerThanTheSampling) {
    const data::Volume volume = volumeOf({129, 129, 129}, 2);
    BrickView view = viewOf(volume);
    const auto levelFor = [&](double step, double pixel) {
        view.stepWorld = step;
        view.footprint = pixel;
        const BrickTree tree = choose(volume, view);
        EXPECT_EQ(tree.finest, tree.coarsest);
        return tree.finest;
    };
    EXPECT_EQ(levelFor(0.1, 0.1), 0);
    EXPECT_EQ(levelFor(1.0, 0.1), 0);
    EXPECT_EQ(levelFor(1.01, 0.1), 1);
    EXPECT_EQ(levelFor(0.1, 2.0), 1);
    EXPECT_EQ(levelFor(0.1, 2.01), 2);
    EXPECT_EQ(levelFor(50.0, 50.0), 2) << "the coarsest there is";
}

TEST(BrickTree, WhatIsFartherAwayIsCoarser) {
    const data::Volume volume = volumeOf({33, 33, 257}, 3);
    BrickView view = viewOf(volume);
    view.perspective = true;
    view.depth = {0, 0, 1, 10};
    view.footprint = 0.03;  // A pixel is a voxel wide at depth 33.
    const BrickTree tree = choose(volume, view);
    // At the nearest point of a brick, of which there is one a level along each axis but z.
    const auto pixelAt = [](int level, int z) { return 0.03 * (10.0 + z * (kSide << level)); };
    for (const BrickNode& node : tree.nodes) {
        if (node.need != Need::kNeeded || node.firstChild != 0) continue;
        const int level = node.brick.level, z = node.brick.place.z;
        if (level < 3) {
            EXPECT_GE(1 << level, pixelAt(level + 1, z / 2));
        }
        if (level > 0) {
            EXPECT_LT(1 << (level - 1), pixelAt(level, z));
        }
    }
    EXPECT_EQ(leavesOf(tree), (std::map<int, int>{{0, 2}, {1, 1}, {2, 1}}));
}

TEST(BrickTree, WhatNoRayMeetsIsLeftOut) {
    const data::Volume volume = volumeOf({129, 129, 129}, 2);
    BrickView view = viewOf(volume);
    view.planes.push_back({-1, 0, 0, 31});  // x <= 31
    const BrickTree tree = choose(volume, view);
    EXPECT_EQ(leavesOf(tree), (std::map<int, int>{{0, 16}}));
    EXPECT_EQ(tree.outside, 4U + 16U) << "half of level 1, half of level 0 beneath the rest";
}

TEST(BrickTree, WhatCannotShowIsLeftOut) {
    const data::Volume volume = volumeOf({129, 129, 129}, 2);
    BrickView view = viewOf(volume);
    view.shows = [](glm::vec2 range) { return range.y > 97.0F; };  // x > 97
    const BrickTree tree = choose(volume, view);
    EXPECT_EQ(leavesOf(tree), (std::map<int, int>{{0, 16}}));
    EXPECT_EQ(tree.hidden, 4U + 16U);
    EXPECT_EQ(tree.nodes[0].need, Need::kNeeded);
    view.reachesAround = true;
    EXPECT_EQ(leavesOf(choose(volume, view)), (std::map<int, int>{{0, 32}}))
        << "values from 16 intervals farther count";
}

TEST(BrickTree, TheRootIsNeededEvenWhereNothingShows) {
    const data::Volume volume = volumeOf({129, 129, 129}, 2);
    BrickView view = viewOf(volume);
    view.shows = [](glm::vec2) { return false; };
    const BrickTree tree = choose(volume, view);
    ASSERT_EQ(tree.nodes.size(), 1U);
    EXPECT_EQ(tree.order, std::vector<int>{0});
}

TEST(BrickTree, OvershootWidensRanges) {
    const data::Volume volume = volumeOf({129, 129, 129}, 2);
    BrickView view = viewOf(volume);
    view.overshoot = 0.25;
    EXPECT_EQ(choose(volume, view).nodes[0].range, glm::vec2(-32.0F, 160.0F));
}

TEST(BrickTree, CoarseComesFirstAndThenTheMiddle) {
    const data::Volume volume = volumeOf({129, 129, 129}, 2);
    const BrickTree tree = choose(volume, viewOf(volume));
    for (std::size_t i = 1; i < tree.order.size(); ++i) {
        const BrickNode& before = tree.nodes[static_cast<std::size_t>(tree.order[i - 1])];
        const BrickNode& node = tree.nodes[static_cast<std::size_t>(tree.order[i])];
        EXPECT_GE(before.brick.level, node.brick.level);
        if (before.brick.level == node.brick.level) {
            EXPECT_LE(before.fromMiddle, node.fromMiddle);
        }
    }
}

TEST(BrickTree, WithoutRoomTheFartherStayCoarse) {
    const data::Volume volume = volumeOf({129, 129, 129}, 2);
    const BrickTree tree = choose(volume, viewOf(volume), 1 + 8 + 4 * 8);
    EXPECT_TRUE(tree.limited);
    EXPECT_EQ(tree.order.size(), 41U);
    EXPECT_EQ(leavesOf(tree), (std::map<int, int>{{0, 32}, {1, 4}}));
    for (const BrickNode& node : tree.nodes) {
        if (node.brick.level == 1) {
            EXPECT_EQ(node.firstChild != 0, node.brick.place.z == 0);
        }
    }
    EXPECT_EQ(tree.finest, 0);
    EXPECT_EQ(tree.coarsest, 1);
    EXPECT_EQ(choose(volume, viewOf(volume), 1).order.size(), 1U);
}

}  // namespace
}  // namespace volcast::volume
