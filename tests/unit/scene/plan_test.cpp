// Which effects a plan turns on for which scene. That a reduced plan draws the same picture is
// tested where pictures are drawn (tests/gl).
#include "renderer/plan/plan.h"

#include <cmath>

#include "gtest/gtest.h"

#include "renderer/plan/effects.h"
#include "renderer/scene/ray_models.h"

namespace volcast::plan {
namespace {

using scene::RayModel;

class Plan : public ::testing::Test {
protected:
    Plan() {
        data::FieldSummary field;
        field.name = "f";
        field.range = {.min = 10.0F, .max = 20.0F};
        data::DatasetSummary mesh;
        mesh.bounds = {.min = {0, 0, 0}, .max = {1, 1, 1}};
        mesh.fields.push_back(field);
        data::DatasetSummary volume = mesh;
        volume.isMesh = false;
        volume.voxels = {33, 33, 33};
        volume.spacing = glm::dvec3(1.0 / 32);
        summaries_ = {{"mesh", mesh}, {"volume", volume}};
        layer_.id = "layer";
        layer_.dataset = "volume";
        layer_.map.points = {{.value = 12.0F, .extinction = 0.0F},
                             {.value = 15.0F, .extinction = 50.0F}};
        scene_.camera.eye = {5, 5, 5};
    }

    LayerPlan planned() {
        scene_.layers = {layer_};
        return plan(scene_, summaries_).layers.at(0);
    }
    [[nodiscard]] static bool lists(const LayerPlan& planned, const std::string& name) {
        for (const Effect& effect : planned.effects) {
            if (effect.name == name) return !effect.reason.empty();
        }
        return false;
    }

    scene::Summaries summaries_;
    scene::Layer layer_;
    scene::Scene scene_;
};

TEST_F(Plan, EveryEffectHasItsReason) {
    for (const char* dataset : {"mesh", "volume"}) {
        layer_.dataset = dataset;
        for (const auto model : {RayModel::kVolume, RayModel::kMip}) {
            layer_.model = model;
            const LayerPlan result = planned();
            EXPECT_FALSE(result.effects.empty());
            for (const Effect& effect : result.effects) EXPECT_FALSE(effect.reason.empty());
        }
    }
}

TEST_F(Plan, EmptyBricksAreLookedForOnlyWhereTheyCanBe) {
    EXPECT_TRUE(planned().has(kEmptyBricks));
    layer_.map.points[0].extinction = 0.1F;
    EXPECT_FALSE(planned().has(kEmptyBricks));
    EXPECT_TRUE(lists(planned(), kEmptyBricks));
    layer_.map.points[0].extinction = 0.0F;
    layer_.map.points[0].value = 9.0F;  // Nothing in the data's range is transparent.
    EXPECT_FALSE(planned().has(kEmptyBricks));
    layer_.model = RayModel::kMip;
    EXPECT_TRUE(planned().has(kEmptyBricks));
    summaries_["volume"].voxels = {17, 17, 17};
    EXPECT_FALSE(planned().has(kEmptyBricks));
}

TEST_F(Plan, EveryModelOfVoxelsSaysWhichBricksItPassesOver) {
    layer_.map.points[0].extinction = 0.1F;
    for (const auto& [model, passes] :
         {std::pair{RayModel::kMip, true}, std::pair{RayModel::kMinip, true},
          std::pair{RayModel::kIsosurface, true}, std::pair{RayModel::kMipColour, false},
          std::pair{RayModel::kSplat, false}, std::pair{RayModel::kXray, false}}) {
        layer_.model = model;
        layer_.interval.reset();
        EXPECT_EQ(planned().has(kEmptyBricks), passes) << scene::name(model);
        EXPECT_TRUE(lists(planned(), kEmptyBricks));
        layer_.interval = data::Range{.min = 12.0F, .max = 13.0F};
        EXPECT_TRUE(planned().has(kEmptyBricks)) << scene::name(model);
    }
    layer_.interval.reset();
    layer_.map.points[0].extinction = 0.0F;
    layer_.model = RayModel::kXray;
    EXPECT_TRUE(planned().has(kEmptyBricks));
}

TEST_F(Plan, SamplesOfVoxelsTakeTheCheapestWayThatIsRight) {
    EXPECT_EQ(planned().method, scene::Integrator::kAverage);
    layer_.model = RayModel::kXray;
    EXPECT_EQ(planned().method, scene::Integrator::kFront);
    layer_.model = RayModel::kMipColour;
    EXPECT_EQ(planned().method, scene::Integrator::kExact);
    layer_.sampling = scene::Sampling::kTricubic;
    EXPECT_EQ(planned().method, scene::Integrator::kExact);
    layer_.sampling = scene::Sampling::kNearest;
    EXPECT_EQ(planned().method, scene::Integrator::kEnds);
}

TEST_F(Plan, VoxelsAreIntegratedAsAskedFor) {
    EXPECT_EQ(planned().integrator, "average");
    layer_.integrator = scene::Integrator::kPsi;
    EXPECT_EQ(planned().integrator, "psi");
    layer_.light.emplace();  // On samples.
    EXPECT_EQ(planned().integrator, "average");
    layer_.integrator = scene::Integrator::kAdaptive;
    EXPECT_EQ(planned().integrator, "adaptive");
    layer_.light.reset();
    layer_.integrator = scene::Integrator::kAuto;
    scene_.accuracy.kind = scene::Accuracy::Kind::kExact;
    EXPECT_EQ(planned().integrator, "adaptive");
    scene_.accuracy.kind = scene::Accuracy::Kind::kFastest;
    EXPECT_EQ(planned().integrator, "average");
    layer_.model = RayModel::kMip;
    EXPECT_EQ(planned().integrator, "march");
}

TEST_F(Plan, DepthSamplesAreSpreadOverTheDepthAlongTheView) {
    layer_.depthSamples = 100;
    scene_.camera = {.eye = {0.5, 0.5, 5.0}, .center = {0.5, 0.5, 0.5}};
    EXPECT_NEAR(planned().stepWorld, 1.0 / 100, 1e-15);
    scene_.camera.eye = {5.5, 5.5, 5.5};
    EXPECT_NEAR(planned().stepWorld, std::sqrt(3.0) / 100, 1e-15);
}

// All loops of a pixel have 65,535 rounds.
TEST_F(Plan, StepsLeaveRoomForTheLoopsOfAllPixels) {
    layer_.stepWorld = 1e-9;
    const double longest = std::sqrt(3.0);
    EXPECT_NEAR(planned().stepWorld, longest / kMaxRaySamples, 1e-12);
    layer_.integrator = scene::Integrator::kExact;
    EXPECT_NEAR(planned().stepWorld, longest / kMaxRayPieces, 1e-12);
    EXPECT_LE(2 * kMaxRayPieces, 65'535 - 16 * 256);
    layer_.integrator = scene::Integrator::kAdaptive;
    EXPECT_TRUE(planned().has(kStepEnlarged));
}

TEST_F(Plan, JitterMovesSamplesThatStandForSteps) {
    EXPECT_FALSE(planned().has(kJitter));
    layer_.jitter = 3;
    EXPECT_TRUE(planned().has(kJitter));
    layer_.integrator = scene::Integrator::kPreintegrated;
    EXPECT_FALSE(planned().has(kJitter));
    layer_.integrator = scene::Integrator::kAuto;
    layer_.model = RayModel::kIsosurface;
    EXPECT_FALSE(planned().has(kJitter));
}

TEST_F(Plan, AnIsosurfaceOfVoxelsNeedsAGradientOnlyWhereItIsLit) {
    layer_.model = RayModel::kIsosurface;
    EXPECT_TRUE(planned().has(kGradient));
    EXPECT_TRUE(planned().has(kEarlyStop));
    layer_.headlight = false;
    EXPECT_FALSE(planned().has(kGradient));
    EXPECT_TRUE(lists(planned(), kGradient));
}

TEST_F(Plan, AVolumeOfVoxelsIsLitOnlyWhereItHasALight) {
    EXPECT_FALSE(planned().has(kLight));
    EXPECT_TRUE(lists(planned(), kLight));
    layer_.light = scene::Light{};
    EXPECT_TRUE(planned().has(kLight));
    layer_.model = RayModel::kMip;
    EXPECT_FALSE(planned().has(kLight));
    layer_.model = RayModel::kVolume;
    layer_.dataset = "mesh";
    EXPECT_FALSE(planned().has(kLight));
}

TEST_F(Plan, ATransparentMapDrawsNothing) {
    layer_.map.points[1].value = 1000.0F;
    layer_.map.points[0].value = 20.5F;
    for (const char* dataset : {"mesh", "volume"}) {
        layer_.dataset = dataset;
        layer_.model = RayModel::kVolume;
        EXPECT_FALSE(planned().drawn);
        EXPECT_FALSE(planned().has(kVisible));
        layer_.model = RayModel::kMip;  // Shows colours whatever the extinction.
        EXPECT_TRUE(planned().drawn);
    }
}

TEST_F(Plan, TricubicValuesMayLeaveTheRangeOfTheVoxels) {
    layer_.map.points = {{.value = 24.0F, .extinction = 0.0F},
                         {.value = 25.0F, .extinction = 100.0F}};
    EXPECT_FALSE(planned().drawn);
    layer_.sampling = scene::Sampling::kTricubic;  // Up to 20 + 0.48 * 10.
    EXPECT_TRUE(planned().drawn);
    layer_.map.points[0].value = 24.9F;
    EXPECT_FALSE(planned().drawn);
}

TEST_F(Plan, AnExtinctionPeakBetweenTheRangesEndsIsSeen) {
    layer_.map.points = {{.value = 14.0F, .extinction = 0.0F},
                         {.value = 14.1F, .extinction = 3.0F},
                         {.value = 14.2F, .extinction = 0.0F}};
    EXPECT_TRUE(planned().drawn);
    EXPECT_TRUE(planned().has(kEmptyBricks));
}

TEST_F(Plan, EarlyStopNeedsMatterThatCanBeOpaque) {
    EXPECT_TRUE(planned().has(kEarlyStop));  // 50 * sqrt(3)
    layer_.map.points[1].extinction = 5.0F;
    EXPECT_FALSE(planned().has(kEarlyStop));
    layer_.model = RayModel::kMip;
    EXPECT_FALSE(planned().has(kEarlyStop));
}

TEST_F(Plan, OnlyNonConvexMeshesAreReEntered) {
    layer_.dataset = "mesh";
    EXPECT_TRUE(planned().has(kReEntry));
    summaries_["mesh"].convex = true;
    EXPECT_FALSE(planned().has(kReEntry));
    EXPECT_EQ(planned().evaluator, Evaluator::kMeshWalk);
    EXPECT_EQ(planned().integrator, "exact");
}

TEST_F(Plan, FewLevelsAreDrawnAloneAndManyInOneWalk) {
    layer_.dataset = "mesh";
    layer_.model = RayModel::kIsosurface;
    layer_.levels.spacing = scene::Levels::Spacing::kLinear;
    layer_.levels.count = 8;
    EXPECT_EQ(planned().evaluator, Evaluator::kMeshProjection);
    EXPECT_TRUE(planned().has(kCellsOfLevels));
    EXPECT_FALSE(lists(planned(), kReEntry));
    layer_.levels.count = 9;
    EXPECT_EQ(planned().evaluator, Evaluator::kMeshWalk);
    EXPECT_FALSE(planned().has(kCellsOfLevels));
    EXPECT_TRUE(lists(planned(), kReEntry));
    layer_.levels.first = 11;
    layer_.levels.last = 19;
    layer_.interval = data::Range{.min = 12.0F, .max = 18.0F};  // Leaves 7 of 9.
    EXPECT_EQ(planned().evaluator, Evaluator::kMeshProjection);
    EXPECT_FALSE(planned().has(kInterval));
    layer_.interval = data::Range{.min = 12.1F, .max = 12.2F};
    EXPECT_FALSE(planned().drawn);
    layer_.interval.reset();
    layer_.levels.count = 1;
    layer_.evaluator = scene::MeshEvaluator::kWalk;
    EXPECT_EQ(planned().evaluator, Evaluator::kMeshWalk);
}

TEST_F(Plan, OneValueACellNeedsNoInterpolation) {
    layer_.dataset = "mesh";
    EXPECT_TRUE(planned().has(kInterpolation));
    summaries_["mesh"].fields[0].association = data::Association::kCell;
    EXPECT_FALSE(planned().has(kInterpolation));
}

TEST_F(Plan, ASurfaceAsksForWhatItShows) {
    layer_.dataset = "mesh";
    layer_.model = RayModel::kSurface;
    LayerPlan result = planned();
    EXPECT_EQ(result.evaluator, Evaluator::kMeshRaster);
    EXPECT_FALSE(result.has(kColourByValue));
    EXPECT_TRUE(result.has(kHeadlight));
    layer_.coloured = true;
    layer_.headlight = false;
    result = planned();
    EXPECT_TRUE(result.has(kColourByValue));
    EXPECT_FALSE(result.has(kHeadlight));
}

TEST_F(Plan, RaysEndAtSurfacesOnlyWhereThereAreAny) {
    EXPECT_FALSE(planned().has(kEndsAtSurfaces));
    scene::Layer surface;
    surface.id = "surface";
    surface.dataset = "mesh";
    surface.model = RayModel::kSurface;
    scene_.layers = {layer_, surface};
    EXPECT_TRUE(plan(scene_, summaries_).layers[0].has(kEndsAtSurfaces));
    scene_.layers[1].visible = false;
    EXPECT_FALSE(plan(scene_, summaries_).layers[0].has(kEndsAtSurfaces));
    EXPECT_FALSE(plan(scene_, summaries_).layers[1].drawn);
}

TEST_F(Plan, TheStepHasItsDefaultAndItsBound) {
    EXPECT_DOUBLE_EQ(planned().stepWorld, 0.5 / 32);
    layer_.stepWorld = 0.2;
    EXPECT_DOUBLE_EQ(planned().stepWorld, 0.2);
    EXPECT_FALSE(planned().has(kStepEnlarged));
    layer_.stepWorld = 1e-12;
    EXPECT_TRUE(planned().has(kStepEnlarged));
    EXPECT_NEAR(planned().stepWorld * kMaxRaySamples, std::sqrt(3.0), 1e-12);
}

TEST_F(Plan, TheCameraInsideIsNoticed) {
    EXPECT_FALSE(planned().has(kCameraInside));
    scene_.camera.eye = {0.5, 0.5, 0.6};
    EXPECT_TRUE(planned().has(kCameraInside));
}

TEST_F(Plan, EqualPlansHaveEqualIds) {
    scene_.layers = {layer_};
    const std::string id = plan(scene_, summaries_).id;
    EXPECT_EQ(id.size(), 12U);
    EXPECT_EQ(plan(scene_, summaries_).id, id);
    scene_.camera.eye.x += 0.1;
    EXPECT_EQ(plan(scene_, summaries_).id, id);
    scene_.layers[0].model = RayModel::kMip;
    EXPECT_NE(plan(scene_, summaries_).id, id);
}

}  // namespace
}  // namespace volcast::plan
