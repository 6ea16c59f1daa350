// Which layers of voxels are drawn from bricks, and what that limits.
#include <cmath>

#include "gtest/gtest.h"

#include "renderer/plan/effects.h"
#include "renderer/plan/plan.h"

namespace volcast::plan {
namespace {

using scene::Integrator;

constexpr std::uint64_t kChannel = std::uint64_t{200} * 200 * 200 * 4;

class PlanResidency : public ::testing::Test {
protected:
    PlanResidency() {
        data::DatasetSummary volume;
        volume.isMesh = false;
        volume.bounds = {.min = {0, 0, 0}, .max = {1, 1, 1}};
        volume.voxels = glm::ivec3(200);
        volume.spacing = glm::dvec3(1.0 / 199);
        volume.coarserLevels = 3;
        for (const char* name : {"a", "b"}) {
            data::FieldSummary& field = volume.fields.emplace_back();
            field.name = name;
            field.range = {.min = 10.0F, .max = 20.0F};
        }
        summaries_ = {{"volume", volume}};
        scene_.camera.eye = {5, 5, 5};
        add("a");
    }

    scene::Layer& add(const std::string& field) {
        scene::Layer& layer = scene_.layers.emplace_back();
        layer.id = std::to_string(scene_.layers.size());
        layer.dataset = "volume";
        layer.field = field;
        layer.map.points = {{.value = 12.0F, .extinction = 0.0F},
                            {.value = 15.0F, .extinction = 50.0F}};
        return layer;
    }
    [[nodiscard]] FramePlan planned(std::uint64_t bytes) const {
        return plan(scene_, summaries_, {}, {.volumeBytes = bytes});
    }
    /// Of the first layer.
    [[nodiscard]] bool bricked(std::uint64_t bytes) const {
        return planned(bytes).layers[0].has(kBricks);
    }
    [[nodiscard]] Effect effect(std::uint64_t bytes, const char* name) const {
        for (const Effect& one : planned(bytes).layers[0].effects) {
            if (one.name == name) return one;
        }
        return {};
    }

    scene::Summaries summaries_;
    scene::Scene scene_;
};

TEST_F(PlanResidency, AChannelThatFitsIsThereAsAWhole) {
    EXPECT_FALSE(bricked(kChannel));
    EXPECT_TRUE(bricked(kChannel - 1));
    EXPECT_EQ(effect(kChannel - 1, kBricks).reason,
              "its voxels take 30.52 MiB of GPU memory, 30.52 MiB are allowed: loaded by bricks of "
              "its pyramid");
    summaries_["volume"].coarserLevels = 0;
    EXPECT_FALSE(bricked(1));
    EXPECT_NE(effect(1, kBricks).reason.find("too small"), std::string::npos);
}

TEST_F(PlanResidency, TheBudgetIsThatOfAllLayersTogether) {
    add("b");
    EXPECT_FALSE(bricked(2 * kChannel));
    const FramePlan both = planned(2 * kChannel - 1);
    EXPECT_TRUE(both.layers[0].has(kBricks));
    EXPECT_TRUE(both.layers[1].has(kBricks));
    EXPECT_NE(effect(2 * kChannel - 1, kBricks).reason.find("the voxels of 2 layers"),
              std::string::npos);
    scene_.layers[1].field = "a";  // The same voxels.
    EXPECT_FALSE(bricked(kChannel));
    scene_.layers[1].field = "b";
    scene_.layers[1].visible = false;
    EXPECT_FALSE(bricked(kChannel));
}

TEST_F(PlanResidency, SeveralChannelsTakeFourAndStayWhole) {
    scene::Layer& layer = add("");
    layer.channels = {{.field = "a", .map = layer.map}, {.field = "b", .map = layer.map}};
    EXPECT_FALSE(bricked(5 * kChannel));
    const FramePlan frame = planned(5 * kChannel - 1);
    EXPECT_TRUE(frame.layers[0].has(kBricks));
    EXPECT_FALSE(frame.layers[1].has(kBricks));
}

// llvmpipe ends all loops of a pixel after 65,535 rounds. A search is a round a level and one more;
// ranges are asked for every 32 intervals, 8 searches and a round each.
TEST_F(PlanResidency, RaysThroughBricksLeaveRoomForTheirSearches) {
    constexpr int kRounds = 65'535;
    constexpr int kSearch = 9, kWideSearch = 11;
    constexpr int kRanges = kMaxSkippedSide / 32 * (8 * kSearch);
    constexpr int kEntries = 3 * (kMaxSkippedSide / 32) * kSearch;
    constexpr int kWideEntries = 3 * ((1 << 15) / 32) * kWideSearch;
    const RayLimits limits = rayLimits(true, 7), wide = rayLimits(true, 10);
    EXPECT_LE(limits.samples + 2 * kRanges + kEntries, kRounds);
    EXPECT_LE(2 * limits.pieces + kRanges + kEntries, kRounds);
    EXPECT_LE(wide.samples + kWideEntries, kRounds);
    EXPECT_LE(2 * wide.pieces + kWideEntries, kRounds);
}

TEST_F(PlanResidency, StepsThatNeedMoreAreEnlargedAndSaidToBe) {
    const double longest = std::sqrt(3.0);
    const auto expectMost = [&](Integrator integrator, int levels, int most) {
        scene_.layers[0].integrator = integrator;
        scene_.layers[0].stepWorld = 1e-9;
        summaries_["volume"].coarserLevels = levels;
        EXPECT_NEAR(planned(1).layers[0].stepWorld, longest / most, 1e-12) << most;
        const Effect enlarged = effect(1, kStepEnlarged);
        EXPECT_TRUE(enlarged.on);
        EXPECT_NE(enlarged.reason.find(std::to_string(most) + " samples"), std::string::npos)
            << enlarged.reason;
        scene_.layers[0].stepWorld = 1.001 * longest / most;
        EXPECT_FALSE(effect(1, kStepEnlarged).on) << most;
    };
    expectMost(Integrator::kAverage, 3, 36'000);
    expectMost(Integrator::kExact, 3, 24'000);
    expectMost(Integrator::kAdaptive, 3, 3'000);
    expectMost(Integrator::kAverage, 8, 30'000);
    expectMost(Integrator::kExact, 8, 14'000);
    expectMost(Integrator::kAdaptive, 8, 1'750);
}

TEST_F(PlanResidency, LongVolumesAskForNoRanges) {
    EXPECT_TRUE(effect(1, kEmptyBricks).on);
    summaries_["volume"].voxels.z = kMaxSkippedSide;
    EXPECT_TRUE(effect(1, kEmptyBricks).on);
    summaries_["volume"].voxels.z = kMaxSkippedSide + 1;
    EXPECT_FALSE(effect(1, kEmptyBricks).on);
    EXPECT_NE(effect(1, kEmptyBricks).reason.find("4096"), std::string::npos);
}

TEST_F(PlanResidency, VoxelsWithoutAValueAreAnEffectWithItsReason) {
    EXPECT_FALSE(effect(kChannel, kVoxelsWithoutValue).on);
    EXPECT_EQ(effect(kChannel, kVoxelsWithoutValue).reason, "every voxel has a value");
    summaries_["volume"].fields[1].voxelsWithoutValue = 12;
    EXPECT_FALSE(effect(kChannel, kVoxelsWithoutValue).on) << "of another channel";
    scene_.layers[0].field = "b";
    EXPECT_TRUE(effect(kChannel, kVoxelsWithoutValue).on);
    EXPECT_EQ(effect(kChannel, kVoxelsWithoutValue).reason,
              "nothing is drawn where 12 voxel(s) without a value (NaN) would count");
    scene::Layer& layer = scene_.layers[0];
    layer.channels = {{.field = "a", .map = layer.map}, {.field = "b", .map = layer.map}};
    EXPECT_TRUE(effect(kChannel, kVoxelsWithoutValue).on);
    layer.channels[1].visible = false;
    EXPECT_FALSE(effect(kChannel, kVoxelsWithoutValue).on);
    layer.channels.clear();
    layer.model = scene::RayModel::kCrossSections;
    EXPECT_TRUE(effect(kChannel, kVoxelsWithoutValue).on);
}

}  // namespace
}  // namespace volcast::plan
