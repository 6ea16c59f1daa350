// Volumes under a light: a field that is linear in the world has one normal.
#include <algorithm>
#include <cmath>
#include <functional>

#include "renderer/plan/effects.h"
#include "tests/support/phantoms.h"
#include "tests/support/render_test.h"
#include "tests/support/volume_reference.h"

namespace volcast {
namespace {

using scene::Light;
using support::GridPlace;

const GridPlace kPlace{.size = {20, 31, 43},
                       .spacing = {0.5, 0.9, 0.31},
                       .origin = {1.0e4, -300.0, 20.0},
                       .direction = support::turn({1, 2, 3}, 37.0)};
const glm::dvec3 kGradient{0.02, -0.05, 0.04};
constexpr double kExtinction = 0.07;
const glm::dvec3 kColour{0.9, 0.5, 0.1};

glm::dvec3 centerOf(const GridPlace& place) {
    return place.origin + place.direction * (0.5 * place.spacing * glm::dvec3(place.size - 1));
}

class VolumeLight : public support::RenderTest {
protected:
    void show(const GridPlace& place, const std::function<double(const glm::dvec3&)>& ofGrid) {
        volume_ = support::volumeOf(place, ofGrid);
        renderer_->addDataset("volume", volume_);
        scene::Layer layer;
        layer.id = "layer";
        layer.dataset = "volume";
        layer.map = support::constantMap(glm::vec3(kColour), static_cast<float>(kExtinction));
        layer.stepWorld = 0.13;
        scene_.layers = {layer};
        scene_.camera = {.eye = centerOf(place) + glm::dvec3(15, 11, 19),
                         .center = centerOf(place)};
        scene_.camera.orthographicHeight = 14.0;
    }
    void showLinear() {
        show(kPlace, [](const glm::dvec3& grid) {
            return 0.5 + glm::dot(kGradient, kPlace.direction * (kPlace.spacing * grid));
        });
    }

    /// What the samples of a ray show, in double.
    [[nodiscard]] glm::dvec4 expected(const support::ReferenceRay& ray, const Light& light) const {
        const support::VolumeReference reference{volume_, scene::Sampling::kTrilinear};
        const glm::dvec2 span = reference.span(ray);
        if (span.x > span.y) return glm::dvec4(0.0);
        const int samples = std::max(1, static_cast<int>(std::ceil((span.y - span.x) / 0.13)));
        const double dt = (span.y - span.x) / samples;
        const glm::dvec3 normal = glm::normalize(kGradient);
        glm::dvec3 colour{0.0};
        for (int i = 0; i < samples; ++i) {
            const glm::dvec3 at = ray.eye + (span.x + (i + 0.5) * dt) * ray.direction;
            const glm::dvec3 l =
                light.position ? glm::normalize(*light.position - at) : -ray.direction;
            const glm::dvec3 h = glm::normalize(l - ray.direction);
            const double shine = std::pow(std::abs(glm::dot(normal, h)), light.exponent);
            const glm::dvec3 lit =
                kColour * (light.ambient + light.diffuse * std::abs(glm::dot(normal, l))) +
                light.specular * shine;
            colour += lit * (std::exp(-kExtinction * dt * i) * -std::expm1(-kExtinction * dt));
        }
        return {colour, -std::expm1(-kExtinction * dt * samples)};
    }

    data::Volume volume_;
    scene::Scene scene_;
};

TEST_F(VolumeLight, ALinearFieldHasOneNormal) {
    showLinear();
    const glm::dvec3 center = centerOf(kPlace);
    const glm::ivec2 size{41, 33};
    for (const auto projection :
         {scene::Projection::kPerspective, scene::Projection::kOrthographic}) {
        scene_.camera.projection = projection;
        for (const Light& light : {Light{}, Light{.position = center + glm::dvec3(-30, 8, 12)},
                                   Light{.position = center + glm::dvec3(1, -2, 0.5),
                                   .ambient = 0.0F,
                                   .specular = 1.0F,
                                   .exponent = 5.5F}}) {
            scene_.layers[0].light = light;
            const auto picture = draw(scene_, size);
            int met = 0;
            for (int y = 0; y < size.y; ++y) {
                for (int x = 0; x < size.x; ++x) {
                    const auto ray = support::referenceRay(scene_.camera, size, x, y);
                    const glm::dvec4 wanted = expected(ray, light);
                    met += wanted.a > 0.0 ? 1 : 0;
                    // Voxels of up to 1 are rounded by 2^-25, which over 2 intervals of 0.31 turns
                    // a gradient of length 0.067 by 1.5e-6; the highlight's exponent multiplies
                    // that by up to 32. The 130 samples of a ray round their sum by 1e-5 at most.
                    for (int c = 0; c < 4; ++c) {
                        ASSERT_NEAR(picture.at(x, y)[c], wanted[c], 6e-5) << x << ' ' << y;
                    }
                }
            }
            EXPECT_GT(met, 400);
        }
    }
}

// The light is on both sides of the matter.
TEST_F(VolumeLight, BothSidesAreLitAlike) {
    const GridPlace place{.size = {9, 9, 9}};
    const auto drawn = [&](double sign) {
        show(place, [sign](const glm::dvec3& p) { return sign * (p.z + 0.3 * p.x); });
        scene_.layers[0].light = Light{.position = glm::dvec3(4, 20, 15)};
        return draw(scene_, {8, 8}).linear;
    };
    const auto up = drawn(1.0);
    EXPECT_EQ(up, drawn(-1.0));
    EXPECT_GT(*std::max_element(up.begin(), up.end()), 0.05F);
}

TEST_F(VolumeLight, WhereTheFieldIsFlatThereIsNoHighlight) {
    show({.size = {9, 9, 5}}, [](const glm::dvec3&) { return 1e30; });
    scene_.camera = {.eye = {4.1, 3.9, 10}, .center = {4.1, 3.9, 0}};
    scene_.camera.projection = scene::Projection::kOrthographic;
    scene_.camera.orthographicHeight = 2.0;
    scene_.layers[0].light = Light{.ambient = 0.25F, .diffuse = 0.5F, .specular = 10.0F};
    const glm::vec4 pixel = draw(scene_, {3, 3}).at(1, 1);
    EXPECT_NEAR(pixel.r, 0.75 * 0.9 * -std::expm1(-kExtinction * 4.0), 1e-6);
    EXPECT_NEAR(pixel.a, -std::expm1(-kExtinction * 4.0), 1e-6);
}

// Values whose differences are no float, a light at a sample, one voxel in a direction.
TEST_F(VolumeLight, HardCasesGiveFiniteNumbers) {
    const auto expectFinite = [&](const char* what) {
        for (const float value : draw(scene_, {9, 9}).linear) {
            ASSERT_TRUE(std::isfinite(value)) << what;
        }
    };
    show({.size = {9, 9, 9}}, [](const glm::dvec3& p) {
        return (static_cast<int>(p.x + p.y + p.z) % 2 == 0 ? 1.0 : -1.0) * 3e38;
    });
    scene_.layers[0].light = Light{.specular = 1.0F, .exponent = 1e-30F};
    expectFinite("huge");
    show({.size = {9, 9, 9}, .spacing = glm::dvec3(1e-12)},
         [](const glm::dvec3& p) { return 1e-36 * p.x; });
    scene_.camera.eye = centerOf({.size = {9, 9, 9}, .spacing = glm::dvec3(1e-12)}) +
                        glm::dvec3(3e-11, 2e-11, 1e-11);
    scene_.layers[0].stepWorld = 0.0;
    scene_.layers[0].light = Light{};
    expectFinite("tiny");
    show({.size = {9, 9, 5}}, [](const glm::dvec3& p) { return p.z; });
    scene_.camera = {.eye = {4, 4, 10}, .center = {4, 4, 0}};
    scene_.layers[0].stepWorld = 8.0;
    scene_.layers[0].light = Light{.position = glm::dvec3(4, 4, 2)};
    expectFinite("the light at the only sample of the middle ray");
    show({.size = {1, 9, 5}}, [](const glm::dvec3& p) { return p.z; });
    scene_.camera = {.eye = {0, 4, 10}, .center = {0, 4, 0}};
    scene_.layers[0].light = Light{};
    expectFinite("one voxel wide");
}

TEST_F(VolumeLight, WithoutALightNothingOfItIsCompiledIn) {
    showLinear();
    const auto unlit = draw(scene_, {16, 16});
    EXPECT_FALSE(unlit.info.plan.layers[0].has(plan::kLight));
    scene_.layers[0].light = Light{.ambient = 1.0F, .diffuse = 0.0F, .specular = 0.0F};
    const auto ambient = draw(scene_, {16, 16});
    EXPECT_TRUE(ambient.info.plan.layers[0].has(plan::kLight));
    EXPECT_EQ(ambient.info.work.programsBuilt, 1) << "another program";
    EXPECT_EQ(ambient.linear, unlit.linear);
    scene_.layers[0].light->diffuse = 0.5F;
    EXPECT_EQ(draw(scene_, {16, 16}).info.work.programsBuilt, 0) << "numbers of a light";
    scene_.layers[0].light->position = glm::dvec3(1, 2, 3);
    EXPECT_EQ(draw(scene_, {16, 16}).info.work.programsBuilt, 1) << "from a place";
    scene_.layers[0].light->position->x = 9.0;
    EXPECT_EQ(draw(scene_, {16, 16}).info.work.programsBuilt, 0) << "numbers of a place";
}

}  // namespace
}  // namespace volcast
