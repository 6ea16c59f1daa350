// Coarser levels of a pyramid show the same field, by longer steps.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "renderer/plan/effects.h"
#include "renderer/scene/ray_models.h"
#include "tests/gl/bricks/bricks_fixture.h"

namespace volcast {
namespace {

using data::VoxelType;
using scene::Sampling;

class BrickLevels : public support::BricksTest {
protected:
    static constexpr int kCoarsest = 2;  // Its samples lie 4 times as far from each other.

    /// How far the layer's picture of a linear field may be from its integral, by samples in the
    /// middle of steps of length `h`, world units.
    ///
    /// Extinction and colour rise linearly on a ray, by r and c a unit at most, from control point
    /// to control point; no ray is longer than L. The opacity of a step without control points is
    /// exact. Its emission lacks int c x rho(x) T dx, x from the middle, of which c h^3 / 12
    /// times at most r or rho^2, times T, is left; over all steps int rho T <= 1, so that is
    /// c h^2 / 12 (r L + rho). Each control point lies in one step of a ray at most: its depth and
    /// its emission are off by (r + c rho) h^2 / 8 there.
    [[nodiscard]] double offBySteps(double h) const {
        const glm::dvec3 slope = glm::dvec3(2.0, -1.5, 0.5) / support::kBricksPlace.spacing;
        const auto& points = scene_.layers[0].map.points;
        double r = 0.0, c = 0.0, rho = 0.0;
        for (std::size_t i = 1; i < points.size(); ++i) {
            const double width = double{points[i].value} - points[i - 1].value;
            const glm::vec3 colour = glm::abs(points[i].colour - points[i - 1].colour);
            const double rise = std::abs(double{points[i].extinction} - points[i - 1].extinction);
            c = std::max(
                c, glm::length(slope) / width * double{std::max({colour.r, colour.g, colour.b})});
            r = std::max(r, glm::length(slope) / width * rise);
            rho = std::max(rho, double{points[i].extinction});
        }
        const double longest =
            glm::length(support::kBricksPlace.spacing * glm::dvec3(support::kBricksPlace.size - 1));
        return h * h *
               (c / 12.0 * (r * longest + rho) +
                static_cast<double>(points.size()) / 8.0 * (r + c * rho));
    }

    /// What the picture of level 0 and the one of the coarsest level may differ by.
    [[nodiscard]] double offByLevels(double step) const {
        const double coarse = step * (1 << kCoarsest);
        return offBySteps(step) + offBySteps(coarse) + kRounding;
    }

    // Interpolated values of up to 540 are off by 2^-23 of that, extinction rises by 0.28 / 162 a
    // unit of them, over rays of 118: by 1.4e-5 of depth.
    static constexpr double kRounding = 540.0 / (1 << 23) * 0.28 / 162 * 118;
};

// All levels of a linear field are the same field: whatever level is drawn, and wherever two of
// them meet, the picture is that of level 0.
TEST_F(BrickLevels, LevelsAreNotShifted) {
    const data::Volume volume = support::volumeAs<float>(VoxelType::kF32, support::linear);
    renderer_->addDataset("volume", volume);
    const auto renderer = bricked(volume, 1);
    scene_.layers[0].map = support::mapOver(-160.0F, 380.0F);
    scene_.layers[0].stepWorld = 0.02;
    showAll();
    for (const Sampling sampling : {Sampling::kTrilinear, Sampling::kTricubic}) {
        scene_.layers[0].sampling = sampling;
        const support::Drawn whole = draw(scene_, support::kBricksSize);
        const support::Drawn parts = complete(*renderer);
        const volume::BrickReport& report = parts.info.bricks.at(0).report;
        EXPECT_EQ(report.finest, 2) << "a pixel is 2.1 wide, voxels of level 1 are 1.4 long";
        EXPECT_EQ(report.coarsest, kCoarsest);
        if (sampling == Sampling::kTrilinear) {
            EXPECT_LE(largestDifference(whole, parts), offByLevels(0.02));
        }
        // A cubic through repeated faces is not linear there, and farther in the coarser it is.
        EXPECT_GT(largest(parts), 0.3F);
    }
    scene_.camera.projection = scene::Projection::kPerspective;
    scene_.camera.eye = center_ + support::kBricksPlace.direction * glm::dvec3(0.0, 0.0, 45.0);
    scene_.camera.fovyDegrees = 70.0;
    scene_.layers[0].sampling = Sampling::kTrilinear;
    const support::Drawn whole = draw(scene_, support::kBricksSize);
    const support::Drawn parts = complete(*renderer);
    const volume::BrickReport& report = parts.info.bricks.at(0).report;
    EXPECT_LT(report.finest, report.coarsest);
    EXPECT_LE(report.coarsest, kCoarsest);
    EXPECT_LE(largestDifference(whole, parts), offByLevels(0.02));
}

// The shorter the step, the closer to what ever more samples of level 0 show.
TEST_F(BrickLevels, CoarseLevelsTakeLongerStepsAndConverge) {
    const data::Volume volume = support::volumeAs<float>(VoxelType::kF32, support::linear);
    renderer_->addDataset("volume", volume);
    const auto renderer = bricked(volume, 1);
    scene_.layers[0].map = support::mapOver(-160.0F, 380.0F);
    showAll();
    for (const scene::Integrator integrator :
         {scene::Integrator::kAverage, scene::Integrator::kPreintegrated}) {
        scene_.layers[0].integrator = integrator;
        scene_.layers[0].stepWorld = 0.01;
        const support::Drawn best = draw(scene_, support::kBricksSize);
        std::vector<double> off;
        for (const double step : {0.2, 0.1, 0.05}) {
            scene_.layers[0].stepWorld = step;
            const support::Drawn parts = complete(*renderer);
            EXPECT_EQ(parts.info.bricks.at(0).report.finest, kCoarsest);
            off.push_back(largestDifference(best, parts));
            EXPECT_LT(off.back(), offByLevels(step)) << scene::name(integrator) << ' ' << step;
        }
        // Of second order: a quarter at half of the step, but for where control points lie in
        // steps.
        EXPECT_LT(off[1], off[0] / 3) << scene::name(integrator);
        EXPECT_LT(off[2], off[1] / 3) << scene::name(integrator);
        RecordProperty(
            std::string{scene::name(integrator)},
            std::to_string(off[0]) + ' ' + std::to_string(off[1]) + ' ' + std::to_string(off[2]));
    }
}

TEST_F(BrickLevels, WithoutRoomThePictureIsCoarserAndSaysSo) {
    const data::Volume volume = support::volumeAs<float>(VoxelType::kF32, support::linear);
    renderer_->addDataset("volume", volume);
    const auto renderer = bricked(volume, 1);  // The least that a pool holds.
    scene_.layers[0].map = support::mapOver(-160.0F, 380.0F);
    showAll();
    scene_.camera.orthographicHeight = 35.0;
    scene_.layers[0].sampling = Sampling::kTrilinear;
    const support::Drawn parts = complete(*renderer);
    const volume::BrickReport& report = parts.info.bricks.at(0).report;
    EXPECT_TRUE(report.limited);
    EXPECT_LE(report.needed, volume::BrickPool::kLeastBricks);
    EXPECT_EQ(report.finest, 0);
    EXPECT_EQ(report.coarsest, 1);
    const double step = parts.info.plan.layers[0].stepWorld;
    EXPECT_LE(largestDifference(draw(scene_, support::kBricksSize), parts), offByLevels(step));
    const auto& effects = parts.info.plan.layers[0].effects;
    const auto effect = std::ranges::find(effects, plan::kBricks, &plan::Effect::name);
    ASSERT_NE(effect, effects.end());
    EXPECT_TRUE(effect->on);
    EXPECT_NE(effect->reason.find("level 0 to 1, no finer because there is no room"),
              std::string::npos)
        << effect->reason;
}

}  // namespace
}  // namespace volcast
