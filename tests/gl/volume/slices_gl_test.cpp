// Slices against the march: two ways to the same integrals.
#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/plan/effects.h"
#include "renderer/scene/ray_models.h"
#include "tests/support/phantoms.h"
#include "tests/support/render_test.h"

namespace volcast {
namespace {

using scene::RayModel;
using scene::VoxelEvaluator;

constexpr std::array kModels{RayModel::kVolume, RayModel::kXray,  RayModel::kSplat,
                             RayModel::kMip,    RayModel::kMinip, RayModel::kMipColour};
constexpr std::array kSlices{VoxelEvaluator::kSlices, VoxelEvaluator::kSliceInstances};

double waves(const glm::dvec3& p) {
    return 50.0 + 30.0 * std::sin(0.7 * p.x) * std::cos(0.5 * p.y) + p.z;
}

data::TransferFunction map() {
    return {{{.value = 30.0F, .colour = {0.1F, 0.2F, 0.9F}, .extinction = 0.05F},
             {.value = 60.0F, .colour = {0.2F, 0.9F, 0.1F}, .extinction = 0.4F},
             {.value = 90.0F, .colour = {1.0F, 0.1F, 0.1F}, .extinction = 0.9F}}};
}

class Slices : public support::RenderTest {
protected:
    void show(const support::GridPlace& place, double step) {
        renderer_->addDataset("volume", support::volumeOf(place, waves));
        scene::Layer layer;
        layer.id = "layer";
        layer.dataset = "volume";
        layer.map = map();
        layer.stepWorld = step;
        scene_.layers = {layer};
        const glm::dvec3 extent = place.spacing * glm::dvec3(place.size - 1);
        center_ = place.origin + place.direction * (0.5 * extent);
        scene_.camera = {.eye = center_ + glm::dvec3(0, 0, 40), .center = center_};
    }

    support::Drawn by(VoxelEvaluator evaluator, scene::PictureSize size) {
        scene_.layers[0].voxelEvaluator = evaluator;
        return draw(scene_, size);
    }

    double worst(VoxelEvaluator evaluator, scene::PictureSize size) {
        const auto slices = by(evaluator, size);
        const auto march = by(VoxelEvaluator::kMarch, size);
        double largest = 0.0;
        for (std::size_t i = 0; i < march.linear.size(); ++i) {
            largest = std::max(largest,
                               std::abs(static_cast<double>(slices.linear[i]) - march.linear[i]));
        }
        return largest;
    }

    scene::Scene scene_;
    glm::dvec3 center_{0.0};
};

// Along an axis both take the same samples.
TEST_F(Slices, AgreeWithTheMarchAtEqualSamples) {
    show({.size = {13, 9, 17}, .spacing = {1, 1, 1}}, 0.5);
    scene_.camera.projection = scene::Projection::kOrthographic;
    scene_.camera.orthographicHeight = 19.0;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-30.0, 30.0}) {
            glm::dvec3 eye{0.0};
            eye[axis] = side;
            scene_.camera.eye = center_ + eye;
            scene_.camera.up = axis == 1 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
            for (const RayModel model : kModels) {
                // On a march it looks at all values between two samples too.
                if (model == RayModel::kMipColour) continue;
                scene_.layers[0].model = model;
                for (const VoxelEvaluator evaluator : kSlices) {
                    // Positions differ by rounding alone, 1e-6 of the way; a value's slope is 21.
                    EXPECT_LT(worst(evaluator, {31, 31}), 2e-4)
                        << scene::name(model) << ' ' << axis << ' ' << side;
                }
            }
        }
    }
}

// From every near corner, in perspective, on a turned grid with uneven spacing: first and last
// piece of a ray may be half a step too long or too short, which is an optical depth of at most one
// step's largest; what lies between is summed up to second order.
TEST_F(Slices, AgreeWithTheMarchFromEverySideUpToAStep) {
    const support::GridPlace place{.size = {13, 9, 11},
                                   .spacing = {0.8, 1.1, 0.6},
                                   .origin = {5, -900, 3},
                                   .direction = support::turn({1, 2, -1}, 37.0)};
    for (const double step : {0.2, 0.05}) {
        show(place, step);
        for (int corner = 0; corner < 8; ++corner) {
            scene_.camera.eye = center_ + 9.0 * glm::dvec3((corner & 1) != 0 ? 1.1 : -1.0,
                                                           (corner & 2) != 0 ? 0.9 : -1.2,
                                                           (corner & 4) != 0 ? 1.0 : -0.7);
            for (const RayModel model : {RayModel::kVolume, RayModel::kXray}) {
                scene_.layers[0].model = model;
                scene_.layers[0].extinctionScale = 1.0F;
                EXPECT_LT(worst(kSlices[corner % 2], {40, 30}), 0.9 * step * 1.2 + 1e-4)
                    << scene::name(model) << ' ' << corner << ' ' << step;
            }
        }
    }
}

TEST_F(Slices, CoverWhatTheMarchCovers) {
    show({.size = {9, 9, 9}}, 0.02);
    scene_.layers[0].model = RayModel::kMip;
    for (const glm::dvec3& eye : {glm::dvec3(14, 9, 11), glm::dvec3(-3, 16, 2),
                                  glm::dvec3(0, 0, 20), glm::dvec3(1, -1, 0.5)}) {
        scene_.camera.eye = center_ + eye;
        scene_.camera.up = {0.1, 1.0, 0.2};
        const auto slices = by(VoxelEvaluator::kSlices, {64, 48});
        const auto march = by(VoxelEvaluator::kMarch, {64, 48});
        int seen = 0, off = 0;
        for (std::size_t i = 3; i < march.linear.size(); i += 4) {
            seen += march.linear[i] > 0.0F ? 1 : 0;
            off += march.linear[i] != slices.linear[i] ? 1 : 0;
        }
        EXPECT_GT(seen, 100);
        // Rays that cut off a corner shorter than a step may pass between two slices.
        EXPECT_LE(off, seen / 100);
    }
}

TEST_F(Slices, InstancesAreTheSamePicture) {
    show({.size = {9, 12, 10}, .spacing = {1, 0.5, 2}}, 0.3);
    scene_.camera.eye = center_ + glm::dvec3(14, 9, 11);
    for (const RayModel model : kModels) {
        scene_.layers[0].model = model;
        EXPECT_EQ(by(VoxelEvaluator::kSlices, {48, 48}).linear,
                  by(VoxelEvaluator::kSliceInstances, {48, 48}).linear)
            << scene::name(model);
    }
}

TEST_F(Slices, KeepToIntervalsClipPlanesAndLight) {
    show({.size = {13, 13, 13}}, 0.05);
    scene_.camera.eye = center_ + glm::dvec3(14, 9, 11);
    scene_.layers[0].interval = data::Range{.min = 40.0F, .max = 62.0F};
    scene_.clipPlanes = {{.normal = {1, 0.5, 0}, .offset = 6.0}};
    scene_.layers[0].light = scene::Light{.position = center_ + glm::dvec3(20, 30, 0)};
    // Ends of what counts, at most some six of them, are off by half a step each.
    EXPECT_LT(worst(VoxelEvaluator::kSlices, {40, 40}), 3 * 0.05 * 0.9 * 1.2);
}

TEST_F(Slices, SayWhatTheyAreAndWhatTheyCannotDo) {
    show({.size = {9, 9, 9}}, 0.5);
    const auto picture = by(VoxelEvaluator::kSlices, {16, 16});
    EXPECT_EQ(picture.info.plan.layers[0].evaluator, plan::Evaluator::kVolumeSlices);
    EXPECT_EQ(picture.info.plan.layers[0].integrator, "slices");
    scene_.layers[0].model = RayModel::kIsosurface;
    scene_.layers[0].levels.values = {50.0F};
    const auto refused = tryDraw(*renderer_, scene_, {16, 16});
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().message,
              "layers[0].voxel_evaluator: slices draws what rays gather, not isosurface");
}

}  // namespace
}  // namespace volcast
