// Voxels without a value (NaN): nothing is drawn wherever interpolation would use one.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "renderer/plan/effects.h"
#include "renderer/reference/reference.h"
#include "renderer/scene/ray_models.h"
#include "tests/support/against_reference.h"
#include "tests/support/edited_renderers.h"
#include "tests/support/phantoms.h"
#include "tests/support/render_test.h"

namespace volcast {
namespace {

using scene::Integrator;
using scene::RayModel;
using scene::Sampling;

constexpr glm::ivec2 kSize{24, 18};
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kStep = 0.012;

/// Values of 0 to 1 around a cavity, with single voxels missing and a corner cut off.
data::Volume holed(double offset = 0.0) {
    return support::volumeOf(
        {.size = {23, 19, 26},
         .spacing = {0.3, 0.4, 0.25},
         .origin = {-3.0, 90.0, 5.0},
         .direction = support::turn({2, -1, 1}, 63.0)},
        [=](const glm::dvec3& p) {
            const bool cavity = glm::length((p - glm::dvec3(11, 9, 13)) / 1.0) < 4.2;
            const bool single = p == glm::dvec3(4, 4, 6) || p == glm::dvec3(17, 5, 20);
            if (cavity || single || p.x + p.y + p.z > 52.0) return kNan;
            return offset + 0.5 + 0.25 * std::sin(0.5 * p.x + 0.4 * p.y) +
                   0.25 * std::cos(0.4 * p.z * (1.0 + 0.03 * p.y));
        });
}

class Missing : public support::RenderTest {
protected:
    Missing() : dataset_{holed()} {
        renderer_->addDataset("volume", dataset_);
        scene::Layer layer;
        layer.id = "layer";
        layer.dataset = "volume";
        layer.map = {{{.value = 0.15F, .colour = {0.1F, 0.1F, 0.9F}, .extinction = 0.1F},
                      {.value = 0.6F, .colour = {0.9F, 0.8F, 0.1F}, .extinction = 0.4F},
                      {.value = 0.9F, .colour = {1.0F, 0.1F, 0.1F}, .extinction = 0.2F}}};
        layer.levels.values = {0.35F, 0.7F};
        layer.exposure = -3.0F;
        layer.stepWorld = kStep;
        scene_.layers.push_back(layer);
        const auto& volume = std::get<data::Volume>(dataset_);
        const glm::dvec3 middle =
            volume.origin + volume.direction * (0.5 * volume.spacing * glm::dvec3(volume.size - 1));
        scene_.camera = {.eye = middle + glm::dvec3(9, 6, 10), .center = middle};
    }

    scene::Layer& layer() { return scene_.layers[0]; }

    support::Distance off(const std::string& what) {
        const auto wanted = reference::draw(
            scene_, reference::Bodies{{"volume", reference::makeBody(dataset_)}}, kSize, {}, 2);
        EXPECT_TRUE(wanted.has_value()) << wanted.error().message;
        if (!wanted) return {};
        const support::Distance found = support::distanceTo(*wanted, draw(scene_, kSize));
        EXPECT_EQ(found.notFinite, 0) << what;
        EXPECT_GT(found.pixels, kSize.x * kSize.y / 5) << what;
        RecordProperty(what, std::to_string(found.largest));
        return found;
    }

    data::Dataset dataset_;
    scene::Scene scene_;
};

// A gap begins and ends within a step: a ray is off by at most a step of matter, 0.4 * 0.004, at
// each of the ends, of which a ray meets at most 6 here.
constexpr double kGaps = 6 * 0.4 * kStep;

TEST_F(Missing, SumsAreThoseOfWhatIsThere) {
    for (const RayModel model : {RayModel::kVolume, RayModel::kXray, RayModel::kSplat}) {
        layer().model = model;
        for (const scene::IntegratorRow& row : scene::row(model).voxelIntegrators) {
            for (const Sampling sampling : {Sampling::kTrilinear, Sampling::kTricubic}) {
                // The reference takes long for polynomials of degree 9.
                const bool first = &row == scene::row(model).voxelIntegrators.data();
                if (sampling == Sampling::kTricubic && !first) continue;
                layer().integrator = row.integrator;
                layer().sampling = sampling;
                const std::string what = std::string{scene::name(model)} + ' ' +
                                         std::string{row.name} + ' ' +
                                         std::string{scene::name(sampling)};
                EXPECT_LT(off(what).largest, kGaps) << what;
            }
        }
    }
}

// Beside a gap the extreme may lie up to a step from the next sample: colours rise by 3 a unit of
// the field, the field by 0.6 a world unit.
TEST_F(Missing, NothingThatIsMissingIsAnExtreme) {
    for (const RayModel model : {RayModel::kMip, RayModel::kMinip, RayModel::kMipColour}) {
        for (const Sampling sampling : {Sampling::kTrilinear, Sampling::kTricubic}) {
            layer().model = model;
            layer().sampling = sampling;
            const std::string what =
                std::string{scene::name(model)} + ' ' + std::string{scene::name(sampling)};
            EXPECT_LT(off(what).largest, kStep * 3 * 0.6) << what;
        }
    }
}

// Up to the gap: a level that is crossed between it and the sample next to it is met.
TEST_F(Missing, SurfacesEndAtGaps) {
    layer().model = RayModel::kIsosurface;
    layer().headlight = false;
    for (const Sampling sampling : {Sampling::kTrilinear, Sampling::kTricubic}) {
        layer().sampling = sampling;
        EXPECT_EQ(off(std::string{scene::name(sampling)}).off, 0) << scene::name(sampling);
    }
}

// Hits are within step / 256 of a crossing: normals of a field that bends by 0.6 a square of a
// world unit at most, where it rises by 0.1 or more, turn by 6 a unit. Edges are compared as well:
// rays that are blind beside gaps miss surfaces there, or meet those behind them.
TEST_F(Missing, SurfacesAreLitByWhatIsThere) {
    layer().model = RayModel::kIsosurface;
    const auto blind = support::editedRenderer(
        device(),
        {{"volume/march_ray.glsl", "if (kSampling == kNearest) return false;", "return false;"}});
    blind->addDataset("volume", std::get<data::Volume>(dataset_));
    const scene::Camera camera = scene_.camera;
    int missed = 0;
    for (int turn = 0; turn < 6; ++turn) {
        constexpr glm::ivec2 kLarger{60, 45};
        scene_.camera = scene::orbit(camera, 60.0 * turn);
        auto wanted = reference::draw(
            scene_, reference::Bodies{{"volume", reference::makeBody(dataset_)}}, kLarger, {}, 2);
        ASSERT_TRUE(wanted.has_value());
        std::ranges::fill(wanted->nearEdge, 0);
        const auto found = support::distanceTo(*wanted, draw(scene_, kLarger));
        EXPECT_LT(found.largest, 6 * kStep / 256)
            << turn << " at " << found.worst.x << ' ' << found.worst.y;
        missed += support::distanceTo(*wanted, support::must(tryDraw(*blind, scene_, kLarger))).off;
    }
    EXPECT_GT(missed, 0);
}

TEST_F(Missing, LightIsThatOfWhatIsThere) {
    layer().light = scene::Light{};
    EXPECT_LT(off("light").largest, kGaps + 1e-3);
}

TEST_F(Missing, NearestVoxelsAreThereOrNot) {
    layer().sampling = Sampling::kNearest;
    layer().integrator = Integrator::kExact;
    // From wall to wall: exact but for rounding.
    EXPECT_LT(off("nearest").rms, 1e-4);
}

TEST_F(Missing, ValuesFarFromZeroAreMissedAsWell) {
    const float far = 4096.0F;
    dataset_ = holed(far);
    renderer_->addDataset("volume", std::get<data::Volume>(dataset_));
    for (auto& point : layer().map.points) point.value += far;
    // Their steps are 2^-11: of colours, 3 a unit of the field at most; of depth, 0.7 a unit.
    EXPECT_LT(off("far").largest, kGaps + 3.0 / 2048);
}

TEST_F(Missing, CrossSectionsAndSlicesHaveHoles) {
    layer().model = RayModel::kCrossSections;
    const auto& volume = std::get<data::Volume>(dataset_);
    const glm::dvec3 across = volume.direction[2];
    layer().crossSections.shown = {false, false, true};
    scene_.camera.projection = scene::Projection::kOrthographic;
    scene_.camera.orthographicHeight = 6.0;
    // Beside planes of grid points, where rounding would choose between two cells.
    scene_.camera.center += 0.05 * volume.direction[0] + 0.07 * volume.direction[1];
    scene_.camera.eye = scene_.camera.center + 9.0 * across;
    scene_.camera.up = volume.direction[1];
    const auto sections = draw(scene_, {31, 31});
    EXPECT_EQ(sections.at(15, 15), glm::vec4(0.0F)) << "the cavity";
    EXPECT_GT(sections.at(4, 15).a, 0.9F);
    layer().model = RayModel::kVolume;
    layer().stepWorld = 0.02;
    scene_.camera.center = scene_.camera.eye - across;
    const auto march = draw(scene_, {31, 31});
    layer().voxelEvaluator = scene::VoxelEvaluator::kSlices;
    const auto slices = draw(scene_, {31, 31});
    // Along an axis both see the same samples.
    for (int i = 0; i < 31; ++i) {
        EXPECT_NEAR(march.at(i, 15).a, slices.at(i, 15).a, 1e-4) << i;
    }
    EXPECT_LT(march.at(15, 15).a, 0.9F * march.at(4, 15).a);
}

TEST_F(Missing, ThePlanSaysSoAndWholeDataPaysNothing) {
    const auto effectOf = [](const support::Drawn& drawn) {
        const auto& effects = drawn.info.plan.layers[0].effects;
        return *std::ranges::find(effects, plan::kVoxelsWithoutValue, &plan::Effect::name);
    };
    const plan::Effect on = effectOf(draw(scene_, {4, 4}));
    EXPECT_TRUE(on.on);
    const auto count = std::get<data::Volume>(dataset_).channels[0].voxelsWithoutValue;
    EXPECT_NE(on.reason.find(std::to_string(count) + " voxel(s)"), std::string::npos) << on.reason;
    renderer_->addDataset("volume",
                          support::volumeOf({.size = {5, 5, 5}}, [](auto p) { return p.x; }));
    EXPECT_FALSE(effectOf(draw(scene_, {4, 4})).on);
}

}  // namespace
}  // namespace volcast
