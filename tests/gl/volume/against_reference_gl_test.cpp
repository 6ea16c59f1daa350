// The march at small steps against renderer/reference, which integrates the interpolated field.
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "renderer/reference/reference.h"
#include "renderer/scene/ray_models.h"
#include "tests/support/against_reference.h"
#include "tests/support/phantoms.h"
#include "tests/support/render_test.h"

namespace volcast {
namespace {

using scene::RayModel;
using scene::Sampling;

constexpr glm::ivec2 kSize{40, 30};
const glm::dvec3 kLightPlace{2, 99, 4};

/// Values of 0 to 1 on a turned grid with unequal spacing.
data::Volume bumpy(double offset = 0.0) {
    return support::volumeOf({.size = {13, 9, 20},
                              .spacing = {0.4, 0.7, 0.25},
                              .origin = {-3.0, 90.0, 5.0},
                              .direction = support::turn({2, -1, 1}, 63.0)},
                             [=](const glm::dvec3& p) {
                                 return offset + 0.5 + 0.25 * std::sin(0.9 * p.x + 0.7 * p.y) +
                                        0.25 * std::cos(0.5 * p.z * (1.0 + 0.1 * p.y));
                             });
}

class AgainstReference : public support::RenderTest {
protected:
    AgainstReference() : dataset_{bumpy()} {
        renderer_->addDataset("volume", dataset_);
        scene::Layer layer;
        layer.id = "layer";
        layer.dataset = "volume";
        layer.map = {{{.value = 0.15F, .colour = {0.1F, 0.1F, 0.9F}, .extinction = 0.0F},
                      {.value = 0.3F, .colour = {0.2F, 0.9F, 0.1F}, .extinction = 0.6F},
                      {.value = 0.6F, .colour = {0.9F, 0.8F, 0.1F}, .extinction = 0.1F},
                      {.value = 0.9F, .colour = {1.0F, 0.1F, 0.1F}, .extinction = 2.0F}}};
        layer.levels.values = {0.35F, 0.7F};
        layer.exposure = -3.0F;
        layer.stepWorld = 0.004;
        scene_.layers.push_back(layer);
        const auto& volume = std::get<data::Volume>(dataset_);
        const glm::dvec3 middle =
            volume.origin + volume.direction * (0.5 * volume.spacing * glm::dvec3(volume.size - 1));
        scene_.camera = {.eye = middle + glm::dvec3(6, 4, 7), .center = middle};
    }

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

bool isExtreme(RayModel model) {
    return model == RayModel::kMip || model == RayModel::kMinip || model == RayModel::kMipColour;
}

// Samples in the middle of steps of 0.004 are off by the square of a step; measured: at most 1e-5.
// Extremes at the ends of a ray are half a step away from a sample: there colours rise by 6 a unit
// of the field, which rises by 1.6 a world unit.
TEST_F(AgainstReference, EveryModelOfContinuousFields) {
    for (const scene::RayModelRow& row : scene::rayModels()) {
        if (!row.onVolumes || row.chunk.empty()) continue;
        for (const Sampling sampling : {Sampling::kTrilinear, Sampling::kTricubic}) {
            scene_.layers[0].model = row.model;
            scene_.layers[0].sampling = sampling;
            const std::string what = std::string{row.name} + ' ' + std::string{name(sampling)};
            const support::Distance found = off(what);
            EXPECT_LT(found.largest, isExtreme(row.model) ? 0.002 * 6 * 1.6 : 5e-5)
                << what << " at " << found.worst.x << ' ' << found.worst.y;
        }
    }
}

// The march may miss a corner of a voxel that a ray crosses in less than a step; few rays do.
TEST_F(AgainstReference, EveryModelOfNearestVoxels) {
    for (const scene::RayModelRow& row : scene::rayModels()) {
        if (!row.onVolumes || row.chunk.empty()) continue;
        scene_.layers[0].model = row.model;
        scene_.layers[0].sampling = Sampling::kNearest;
        scene_.layers[0].headlight =
            false;  // On a voxel's face rounding decides what is beside it.
        const support::Distance found = off(std::string{row.name});
        EXPECT_LT(found.off, found.pixels / (isExtreme(row.model) ? 20 : 4)) << row.name;
        EXPECT_LT(found.rms, 0.02) << row.name;
    }
}

// Where the field is nearly flat rounding turns its normal: on single samples of a ray.
TEST_F(AgainstReference, LightOnSamples) {
    for (const auto& place : {std::optional<glm::dvec3>{}, std::optional{kLightPlace}}) {
        scene_.layers[0].light = scene::Light{.position = place};
        const support::Distance found = off(place ? "light at a place" : "light at the eye");
        EXPECT_LT(found.rms, 2e-5);
        EXPECT_LT(found.largest, 5e-4);
    }
}

// Values far from 0 beside their width keep their digits.
TEST_F(AgainstReference, ValuesFarFromZero) {
    const float far = 4096.0F;
    auto& volume = std::get<data::Volume>(dataset_);
    volume = bumpy(far);
    renderer_->addDataset("volume", dataset_);
    for (data::ControlPoint& point : scene_.layers[0].map.points) point.value += far;
    for (const RayModel model : {RayModel::kVolume, RayModel::kMip}) {
        scene_.layers[0].model = model;
        // float32 keeps values to 2^-12 here, colours rise by 6 a unit.
        EXPECT_LT(off(std::string{name(model)}).rms, 6.0 / 4096) << name(model);
    }
}

TEST_F(AgainstReference, AnIntervalAndClipPlanes) {
    scene_.layers[0].interval = data::Range{.min = 0.3F, .max = 0.8F};
    scene_.clipPlanes = {
        {.normal = {1, 1, 0.2}, .offset = glm::dot({1, 1, 0.2}, scene_.camera.center)}};
    for (const RayModel model : {RayModel::kVolume, RayModel::kXray, RayModel::kSplat}) {
        scene_.layers[0].model = model;
        // Each end of the interval is met within half a step: extinction 1.4, four times a ray.
        EXPECT_LT(off(std::string{name(model)}).largest, 0.002 * 1.4 * 4);
    }
}

// With steps of two fifths of the smallest spacing; what each is off by is what it is for.
TEST_F(AgainstReference, EveryIntegrator) {
    scene_.layers[0].stepWorld = 0.1;
    for (const RayModel model : {RayModel::kVolume, RayModel::kXray, RayModel::kSplat}) {
        scene_.layers[0].model = model;
        const auto rows = scene::row(model).voxelIntegrators;
        double ofSamples = 0.0;
        for (const scene::IntegratorRow& row : rows) {
            scene_.layers[0].integrator = row.integrator;
            const std::string what = std::string{name(model)} + ' ' + std::string{row.name};
            const support::Distance found = off(what);
            if (&row == rows.data()) ofSamples = found.rms;
            EXPECT_LT(found.largest, 0.03) << what;
            EXPECT_LT(found.rms, 0.005) << what;
        }
        EXPECT_LT(off("the last").rms, 0.25 * ofSamples) << name(model);
    }
}

// The largest error that the adaptive march allows a ray, whatever the step it may begin with.
TEST_F(AgainstReference, AdaptiveStepsKeepTheirError) {
    scene_.layers[0].integrator = scene::Integrator::kAdaptive;
    for (const RayModel model : {RayModel::kVolume, RayModel::kXray, RayModel::kSplat}) {
        for (const Sampling sampling : {Sampling::kTrilinear, Sampling::kTricubic}) {
            for (const double step : {0.02, 0.12}) {
                scene_.layers[0].model = model;
                scene_.layers[0].sampling = sampling;
                scene_.layers[0].stepWorld = step;
                EXPECT_LT(off("adaptive").largest, 1.0 / 255) << name(model) << ' ' << step;
            }
        }
    }
}

// From wall to wall nearest voxels are exact with any step.
TEST_F(AgainstReference, NearestVoxelsAreExactFromWallToWall) {
    scene_.layers[0].sampling = Sampling::kNearest;
    scene_.layers[0].integrator = scene::Integrator::kExact;
    scene_.layers[0].stepWorld = 3.0;
    for (const bool interval : {false, true}) {
        if (interval) scene_.layers[0].interval = data::Range{.min = 0.3F, .max = 0.8F};
        for (const RayModel model : {RayModel::kVolume, RayModel::kXray, RayModel::kSplat}) {
            scene_.layers[0].model = model;
            EXPECT_LT(off(std::string{name(model)}).largest, 5e-5) << name(model) << interval;
        }
    }
    scene_.layers[0].interval.reset();
    scene_.layers[0].model = RayModel::kVolume;
    scene_.layers[0].light = scene::Light{.position = kLightPlace};
    scene_.layers[0].integrator = scene::Integrator::kAdaptive;
    EXPECT_LT(off("lit").rms, 0.02);  // Within a voxel the way to the light turns.
}

TEST_F(AgainstReference, IntervalsAndLightOfAllIntegrators) {
    scene_.layers[0].interval = data::Range{.min = 0.3F, .max = 0.8F};
    scene_.layers[0].stepWorld = 0.01;
    for (const scene::IntegratorRow& row : scene::row(RayModel::kVolume).voxelIntegrators) {
        scene_.layers[0].integrator = row.integrator;
        EXPECT_LT(off(std::string{row.name}).largest, 0.01 * 1.4 * 4) << row.name;
    }
    scene_.layers[0].interval.reset();
    scene_.layers[0].light = scene::Light{.position = kLightPlace};
    scene_.layers[0].integrator = scene::Integrator::kAdaptive;
    EXPECT_LT(off("light").rms, 1e-4);
}

TEST_F(AgainstReference, HalvingTheStepQuartersTheError) {
    scene_.layers[0].stepWorld = 0.1;
    const double coarse = off("coarse").rms;
    scene_.layers[0].stepWorld = 0.05;
    const double fine = off("fine").rms;
    EXPECT_GT(coarse, 3.0 * fine);
    EXPECT_LT(coarse, 5.0 * fine);
}

}  // namespace
}  // namespace volcast
