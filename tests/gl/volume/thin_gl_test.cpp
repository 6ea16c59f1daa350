// Volumes of one voxel along an axis: planes, lines and points, which have values but no extent.
#include <cmath>
#include <string>

#include "renderer/scene/ray_models.h"
#include "tests/support/phantoms.h"
#include "tests/support/render_test.h"

namespace volcast {
namespace {

using scene::RayModel;
using scene::Sampling;

class ThinVolumes : public support::RenderTest {
protected:
    ThinVolumes() {
        scene::Layer layer;
        layer.id = "layer";
        layer.dataset = "thin";
        layer.map = {{{.value = 0.0F, .colour = glm::vec3(0.0F), .extinction = 0.5F},
                      {.value = 8.0F, .colour = glm::vec3(1.0F), .extinction = 2.0F}}};
        layer.levels.values = {3.0F};
        scene_.layers.push_back(layer);
    }

    scene::Layer& layer() { return scene_.layers[0]; }

    /// Seen along `axis`, parallel rays; the pixel in the middle meets grid point (4, 4) of a
    /// plane.
    void lookAlong(int axis) {
        scene_.camera.center = glm::dvec3(4.0);
        scene_.camera.center[axis] = 0.0;
        scene_.camera.eye = scene_.camera.center;
        scene_.camera.eye[axis] = 20.0;
        scene_.camera.up = axis == 1 ? glm::dvec3{0, 0, 1} : glm::dvec3{0, 1, 0};
        scene_.camera.projection = scene::Projection::kOrthographic;
        scene_.camera.orthographicHeight = 6.0;
    }

    scene::Scene scene_;
};

/// What a plane shows of a value of 4 of 8.
glm::vec4 expectedOf(RayModel model) {
    switch (model) {
        case RayModel::kMip:
        case RayModel::kMinip:
        case RayModel::kMipColour:
        case RayModel::kCrossSections: return {0.5F, 0.5F, 0.5F, 1.0F};
        case RayModel::kXray: return glm::vec4(1.0F);
        default: return glm::vec4(0.0F);  // No length to absorb or emit on, no level to cross.
    }
}

TEST_F(ThinVolumes, EveryModelShowsAPlaneAcrossEachAxisByItsValues) {
    for (int axis = 0; axis < 3; ++axis) {
        glm::ivec3 size{9};
        size[axis] = 1;
        const int along = (axis + 1) % 3;
        renderer_->addDataset("thin", support::volumeOf({.size = size}, [=](const glm::dvec3& p) {
                                  return p[along];
                              }));
        lookAlong(axis);
        for (const scene::RayModelRow& row : scene::rayModels()) {
            if (!row.onVolumes) continue;
            layer().model = row.model;
            for (const Sampling sampling :
                 {Sampling::kNearest, Sampling::kTrilinear, Sampling::kTricubic}) {
                layer().sampling = sampling;
                for (const scene::IntegratorRow& integrator : row.voxelIntegrators) {
                    layer().integrator = integrator.integrator;
                    for (const bool lit : {false, true}) {
                        layer().light.reset();
                        if (lit && row.model == RayModel::kVolume) layer().light = scene::Light{};
                        const glm::vec4 shown = draw(scene_, {3, 3}).at(1, 1);
                        for (int c = 0; c < 4; ++c) {
                            EXPECT_NEAR(shown[c], expectedOf(row.model)[c], 1e-5)
                                << row.name << ' ' << scene::name(sampling) << ' '
                                << integrator.name << " across " << axis;
                        }
                    }
                }
                layer().integrator = scene::Integrator::kAuto;
            }
        }
    }
}

TEST_F(ThinVolumes, LinesAndPointsGiveFiniteNumbers) {
    for (const glm::ivec3 size : {glm::ivec3{1, 1, 9}, {1, 9, 1}, {9, 1, 1}, {1, 1, 1}}) {
        renderer_->addDataset("thin", support::volumeOf({.size = size}, [](const glm::dvec3& p) {
                                  return p.x + p.y + p.z + 1.0;
                              }));
        for (int axis = 0; axis < 3; ++axis) {
            lookAlong(axis);
            scene_.camera.center = 0.5 * glm::dvec3(size - 1);
            scene_.camera.eye +=
                scene_.camera.center -
                glm::dvec3(axis == 0 ? 0 : 4, axis == 1 ? 0 : 4, axis == 2 ? 0 : 4);
            for (const scene::RayModelRow& row : scene::rayModels()) {
                if (!row.onVolumes) continue;
                layer().model = row.model;
                layer().light.reset();
                if (row.model == RayModel::kVolume) layer().light = scene::Light{};
                const auto picture = draw(scene_, {3, 3});
                for (const float value : picture.linear) {
                    ASSERT_TRUE(std::isfinite(value)) << row.name << " across " << axis;
                }
                if (row.model != RayModel::kMip) continue;
                EXPECT_EQ(picture.at(1, 1).a, 1.0F) << "the middle ray meets it";
            }
        }
    }
}

}  // namespace
}  // namespace volcast
