// What a voxel volume must look like where the answer is known in closed form.
#include <cmath>

#include "tests/support/phantoms.h"
#include "tests/support/render_test.h"

namespace volcast {
namespace {

using scene::Projection;
using scene::RayModel;
using support::GridPlace;

class MarchClosedForm : public support::RenderTest {
protected:
    /// Shows `volume` alone, from `eye` towards `center`.
    scene::Scene sceneOf(data::Volume volume, const data::TransferFunction& map, RayModel model) {
        renderer_->addDataset("volume", std::move(volume));
        scene::Layer layer;
        layer.id = "layer";
        layer.dataset = "volume";
        layer.field = "f";
        layer.model = model;
        layer.map = map;
        scene::Scene scene;
        scene.layers.push_back(layer);
        return scene;
    }
};

double one(const glm::dvec3& /*grid*/) {
    return 1.0;
}

// Through a slab of constant extinction the opacity is closed: 1 - exp(-sigma * length).
TEST_F(MarchClosedForm, ASlabObeysBeerLambertForAnyStep) {
    scene::Scene scene =
        sceneOf(support::volumeOf({.size = {9, 9, 5}, .spacing = {1, 1, 0.75}}, one),
                support::constantMap({0.9F, 0.5F, 0.1F}, 0.7F), RayModel::kVolume);
    scene.camera = {.eye = {4.1, 3.9, 10}, .center = {4.1, 3.9, 0}};
    scene.camera.projection = Projection::kOrthographic;
    scene.camera.orthographicHeight = 2.0;
    const double alpha = 1.0 - std::exp(-0.7 * 3.0);
    for (const double step : {2.3, 0.7, 0.013, 0.00011}) {
        scene.layers[0].stepWorld = step;
        const auto picture = draw(scene, {4, 4});
        EXPECT_NEAR(picture.at(2, 1).a, alpha, 2e-5) << "step " << step;
        EXPECT_NEAR(picture.at(2, 1).r, 0.9 * alpha, 2e-5) << "step " << step;
        EXPECT_NEAR(picture.at(2, 1).b, 0.1 * alpha, 2e-5) << "step " << step;
    }
}

TEST_F(MarchClosedForm, ThinMatterKeepsItsDigits) {
    scene::Scene scene = sceneOf(support::volumeOf({.size = {9, 9, 5}}, one),
                                 support::constantMap({1, 1, 1}, 1e-7F), RayModel::kVolume);
    scene.camera = {.eye = {4.1, 3.9, 10}, .center = {4.1, 3.9, 0}};
    scene.camera.projection = Projection::kOrthographic;
    const double alpha = 4e-7;
    EXPECT_NEAR(draw(scene, {4, 4}).at(1, 1).a / alpha, 1.0, 1e-5);
}

// Every ray's own length counts: oblique rays, a turned and stretched grid far from the origin.
TEST_F(MarchClosedForm, ATurnedStretchedGridFarAwayHasTheLengthOfEachRay) {
    const GridPlace place{.size = {20, 7, 33},
                          .spacing = {0.5, 2.0, 0.31},
                          .origin = {1.0e6, -3.0e5, 20.0},
                          .direction = support::turn({1, 2, 3}, 37.0)};
    const float sigma = 0.05F;
    scene::Scene scene = sceneOf(support::volumeOf(place, one),
                                 support::constantMap({1, 1, 1}, sigma), RayModel::kVolume);
    const glm::dvec3 half = 0.5 * place.spacing * glm::dvec3(place.size - 1);
    const glm::dvec3 center = place.origin + place.direction * half;
    const auto span = [&](const glm::dvec3& eye, const glm::dvec3& direction) {
        const glm::dvec3 o = glm::transpose(place.direction) * (eye - center);
        const glm::dvec3 d = glm::transpose(place.direction) * direction;
        glm::dvec2 inside{0.0, 1e300};
        for (int axis = 0; axis < 3; ++axis) {
            const double a = (-half[axis] - o[axis]) / d[axis],
                         b = (half[axis] - o[axis]) / d[axis];
            inside = {std::max(inside.x, std::min(a, b)), std::min(inside.y, std::max(a, b))};
        }
        return std::max(inside.y - inside.x, 0.0);
    };
    for (const bool perspective : {true, false}) {
        for (const double distance : {40.0, 2.0}) {  // Outside, then within the box.
            scene.camera = {.eye = center + distance * glm::normalize(glm::dvec3(1, 0.4, -0.7)),
                            .center = center};
            scene.camera.projection =
                perspective ? Projection::kPerspective : Projection::kOrthographic;
            scene.camera.orthographicHeight = 12.0;
            const glm::ivec2 size{31, 23};
            const auto picture = draw(scene, size);
            const glm::dvec3 w = glm::normalize(center - scene.camera.eye);
            const glm::dvec3 u = glm::normalize(glm::cross(w, glm::dvec3(0, 1, 0)));
            const glm::dvec3 v = glm::cross(u, w);
            for (int y = 0; y < size.y; ++y) {
                for (int x = 0; x < size.x; ++x) {
                    const double right = (2.0 * (x + 0.5) - size.x) / size.y;
                    const double up = (size.y - 2.0 * (y + 0.5)) / size.y;
                    const double slope = std::tan(15.0 * 3.14159265358979323846 / 180.0);
                    const double length =
                        perspective ? span(scene.camera.eye,
                                           glm::normalize(w + slope * (right * u + up * v)))
                                    : span(scene.camera.eye + 6.0 * (right * u + up * v), w);
                    ASSERT_NEAR(picture.at(x, y).a, 1.0 - std::exp(-sigma * length), 3e-6)
                        << x << ' ' << y << ' ' << perspective << ' ' << distance;
                }
            }
        }
    }
}

// Of a field that is linear in the cube, the largest value on a ray lies at one of its ends; half
// a step before it is the last sample.
TEST_F(MarchClosedForm, MipOfALinearFieldIsItsLargerEnd) {
    const glm::dvec3 gradient{0.3, -0.2, 0.5};
    scene::Scene scene =
        sceneOf(support::volumeOf({.size = {17, 17, 17}},
                                  [&](const glm::dvec3& p) { return glm::dot(gradient, p); }),
                {{{.value = -4.0F, .colour = glm::vec3(0.0F)},
                  {.value = 16.0F, .colour = glm::vec3(1.0F)}}},
                RayModel::kMip);
    scene.camera = {.eye = {40, 30, 25}, .center = {8, 8, 8}};
    scene.camera.projection = Projection::kOrthographic;
    scene.camera.orthographicHeight = 30.0;
    const double step = 0.01;
    scene.layers[0].stepWorld = step;
    const glm::ivec2 size{19, 19};
    const auto picture = draw(scene, size);
    const glm::dvec3 w = glm::normalize(glm::dvec3(-32, -22, -17));
    const glm::dvec3 u = glm::normalize(glm::cross(w, glm::dvec3(0, 1, 0)));
    const glm::dvec3 v = glm::cross(u, w);
    int met = 0;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const glm::dvec3 eye =
                scene.camera.eye + 15.0 * ((2.0 * (x + 0.5) - size.x) / size.y * u +
                                           (size.y - 2.0 * (y + 0.5)) / size.y * v);
            glm::dvec2 inside{0.0, 1e300};
            for (int axis = 0; axis < 3; ++axis) {
                const double a = -eye[axis] / w[axis], b = (16.0 - eye[axis]) / w[axis];
                inside = {std::max(inside.x, std::min(a, b)), std::min(inside.y, std::max(a, b))};
            }
            const glm::vec4 pixel = picture.at(x, y);
            if (inside.x >= inside.y) {
                EXPECT_EQ(pixel, glm::vec4(0.0F));
                continue;
            }
            ++met;
            EXPECT_EQ(pixel.a, 1.0F);
            const double ends = std::max(glm::dot(gradient, eye + inside.x * w),
                                         glm::dot(gradient, eye + inside.y * w));
            const double halfStep = 0.5 * step * glm::length(gradient);
            const double drawn = pixel.r * 20.0 - 4.0;
            EXPECT_LE(drawn, ends + 2e-5);
            EXPECT_GE(drawn, ends - halfStep - 2e-5);
        }
    }
    EXPECT_GT(met, 100);
}

// One sample a ray, in the middle between two planes: the value at a point.
TEST_F(MarchClosedForm, TricubicKeepsGridPointsAndReproducesQuadratics) {
    const auto quadratic = [](const glm::dvec3& p) {
        return 0.1 * (p.x * p.x - 3.0 * p.x + 1.0) * (0.1 * p.y * p.y + p.y) *
               (2.0 + p.z - 0.2 * p.z * p.z);
    };
    constexpr double kScale = 160.0;
    scene::Scene scene =
        sceneOf(support::volumeOf({.size = {9, 8, 7}}, quadratic),
                {{{.value = static_cast<float>(-kScale), .colour = glm::vec3(0.0F)},
                  {.value = static_cast<float>(kScale), .colour = glm::vec3(1.0F)}}},
                RayModel::kMip);
    scene.layers[0].sampling = scene::Sampling::kTricubic;
    scene.layers[0].stepWorld = 1.0;
    scene.camera.projection = Projection::kOrthographic;
    const auto expectAt = [&](const glm::dvec3& point) {
        scene.camera.eye = point + glm::dvec3(0, 0, 20);
        scene.camera.center = point;
        scene.clipPlanes = {{.normal = {0, 0, 1}, .offset = point.z - 0.25},
                            {.normal = {0, 0, -1}, .offset = -point.z - 0.25}};
        // Positions are off by 2^-20 where the field rises by at most 60 a voxel; the sum of values
        // up to 157 is rounded some 10 times, each time by at most 2^-24 of twice that.
        EXPECT_NEAR(draw(scene, {1, 1}).at(0, 0).r * 2.0 * kScale - kScale, quadratic(point), 3e-4)
            << point.x << ' ' << point.y << ' ' << point.z;
    };
    for (int i = 0; i < 60; ++i) {
        expectAt({1.0 + std::fmod(i * 0.618, 1.0) * 6.0, 1.0 + std::fmod(i * 0.755, 1.0) * 5.0,
                  1.0 + std::fmod(i * 0.570, 1.0) * 4.0});
    }
    for (int i = 0; i < 4; ++i) expectAt({2.0 * i + 1, i + 2, i + 1});
    // Grid points in a face, along which values are read beyond it.
    for (int i = 0; i < 4; ++i) expectAt({0, 2 * i, 3});
    for (int i = 0; i < 4; ++i) expectAt({8, 7, i + 1});
}

// C(max f), not max C(f): a peak of the map that the ray passes below the maximum must not show.
TEST_F(MarchClosedForm, MipMapsTheMaximumAndNotTheColours) {
    scene::Scene scene =
        sceneOf(support::volumeOf({.size = {5, 5, 9}}, [](const glm::dvec3& p) { return p.z; }),
                {{{.value = 0.0F, .colour = {0, 0, 0}},
                  {.value = 4.0F, .colour = {1, 0, 0}},
                  {.value = 7.5F, .colour = {0, 1, 0}},
                  {.value = 7.5F, .colour = {0, 0, 1}}}},
                RayModel::kMip);
    scene.camera = {.eye = {2, 2, 30}, .center = {2, 2, 0}};
    scene.camera.projection = Projection::kOrthographic;
    EXPECT_EQ(draw(scene, {3, 3}).at(1, 1), glm::vec4(0, 0, 1, 1));
}

// Two half-volumes, one behind the other, are one volume.
TEST_F(MarchClosedForm, TwoHalvesAreOneVolume) {
    const auto value = [](const glm::dvec3& p) { return 0.1 + 0.01 * p.z + 0.02 * p.x; };
    const data::TransferFunction map{{{.value = 0.0F, .colour = {1, 0.2F, 0}, .extinction = 0.0F},
                                      {.value = 0.5F, .colour = {0, 0.5F, 1}, .extinction = 0.4F}}};
    scene::Scene whole =
        sceneOf(support::volumeOf({.size = {9, 9, 17}}, value), map, RayModel::kVolume);
    whole.camera = {.eye = {4, 4, 50}, .center = {4, 4, 0}};
    whole.layers[0].stepWorld = 0.05;
    const auto expected = draw(whole, {16, 16});
    renderer_->addDataset("behind", support::volumeOf({.size = {9, 9, 9}}, value));
    renderer_->addDataset("before", support::volumeOf({.size = {9, 9, 9}, .origin = {0, 0, 8}},
                                                      [&](const glm::dvec3& p) {
                                                          return value(p + glm::dvec3(0, 0, 8));
                                                      }));
    scene::Scene halves = whole;
    halves.layers[0].dataset = "behind";
    halves.layers.push_back(halves.layers[0]);
    halves.layers[1].id = "nearer";
    halves.layers[1].dataset = "before";
    const auto picture = draw(halves, {16, 16});
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x) {
            for (int c = 0; c < 4; ++c) {
                ASSERT_NEAR(picture.at(x, y)[c], expected.at(x, y)[c], 2e-5) << x << ' ' << y;
            }
        }
    }
}

TEST_F(MarchClosedForm, ThePictureIsTheLayersOverTheBackgroundInSrgb) {
    scene::Scene scene =
        sceneOf(support::volumeOf({.size = {9, 9, 5}}, one),
                support::constantMap({0.2F, 0.4F, 0.8F}, 0.25F), RayModel::kVolume);
    scene.camera = {.eye = {4, 4, 10}, .center = {4, 4, 0}};
    scene.camera.projection = Projection::kOrthographic;
    const auto srgb = [](double c) {
        return static_cast<int>(std::lround(
            255.0 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055)));
    };
    const double alpha = 1.0 - std::exp(-1.0);
    for (const float cover : {1.0F, 0.5F, 0.0F}) {
        scene.background = {1.0F, 0.5F, 0.0F, cover};
        const glm::ivec4 pixel = draw(scene, {3, 3}).byteAt(1, 1);
        const double opacity = alpha + (1 - alpha) * cover;
        const double behind = (1 - alpha) * cover;
        EXPECT_NEAR(pixel.r, srgb((0.2 * alpha + behind) / opacity), 1);
        EXPECT_NEAR(pixel.g, srgb((0.4 * alpha + 0.5 * behind) / opacity), 1);
        EXPECT_NEAR(pixel.b, srgb(0.8 * alpha / opacity), 1);
        EXPECT_NEAR(pixel.a, 255.0 * opacity, 1);
    }
}

}  // namespace
}  // namespace volcast
