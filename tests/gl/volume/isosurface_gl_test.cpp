// Isosurfaces of voxels, clip planes and rays that miss, against closed forms.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "renderer/data/mesh_builder.h"
#include "tests/support/mesh_phantoms.h"
#include "tests/support/phantoms.h"
#include "tests/support/render_test.h"
#include "tests/support/volume_reference.h"

namespace volcast {
namespace {

using scene::Projection;
using scene::RayModel;
using scene::Sampling;
using support::GridPlace;

const GridPlace kTurned{.size = {20, 31, 43},
                        .spacing = {0.5, 0.9, 0.31},
                        .origin = {1.0e5, -300.0, 20.0},
                        .direction = support::turn({1, 2, 3}, 37.0)};

glm::dvec3 worldOf(const GridPlace& place, const glm::dvec3& grid) {
    return place.origin + place.direction * (place.spacing * grid);
}

glm::dvec3 centerOf(const GridPlace& place) {
    return worldOf(place, 0.5 * glm::dvec3(place.size - 1));
}

class VoxelIsosurface : public support::RenderTest {
protected:
    /// A layer of `levels` in a volume, with colours from black at 0 to white at 1.
    scene::Layer& add(const std::string& id, data::Volume volume, std::vector<float> levels) {
        renderer_->addDataset(id, std::move(volume));
        scene::Layer layer;
        layer.id = id;
        layer.dataset = id;
        layer.model = RayModel::kIsosurface;
        layer.levels.values = std::move(levels);
        layer.map = {{{.value = 0.0F, .colour = glm::vec3(0.0F)},
                      {.value = 1.0F, .colour = glm::vec3(1.0F)}}};
        return scene_.layers.emplace_back(layer);
    }

    /// White fog all over `place`: 1 - exp(-kFog L) in front of a black surface at distance L
    /// within it tells L.
    void addFog(const GridPlace& place) {
        scene::Layer& layer =
            add("fog", support::volumeOf(place, [](const glm::dvec3&) { return 1.0; }), {});
        layer.model = RayModel::kVolume;
        layer.map = support::constantMap(glm::vec3(1.0F), static_cast<float>(kFog));
    }

    void look(const GridPlace& place, const glm::dvec3& from) {
        scene_.camera = {.eye = centerOf(place) + from, .center = centerOf(place)};
        scene_.camera.orthographicHeight = 14.0;
    }

    static constexpr double kFog = 0.05;
    scene::Scene scene_;
};

// A field that is linear in the world is so between grid points: a plane, with one normal.
TEST_F(VoxelIsosurface, OfALinearFieldIsAPlaneWithOneNormal) {
    const glm::dvec3 gradient{0.02, -0.05, 0.04};
    const glm::dvec3 center = centerOf(kTurned);
    const auto value = [&](const glm::dvec3& grid) {
        return 0.5 + glm::dot(gradient, worldOf(kTurned, grid) - center);
    };
    add("plane", support::volumeOf(kTurned, value), {0.53F});
    addFog(kTurned);
    const glm::ivec2 size{41, 33};
    const data::Volume shape = support::volumeOf(kTurned, [](const glm::dvec3&) { return 0.0; });
    const support::VolumeReference reference{shape, Sampling::kTrilinear};
    for (const auto projection : {Projection::kPerspective, Projection::kOrthographic}) {
        for (const glm::dvec3& from : {glm::dvec3(15, 11, 19), glm::dvec3(-12, 20, -14)}) {
            look(kTurned, from);
            scene_.camera.projection = projection;
            const auto picture = draw(scene_, size);
            int hits = 0;
            for (int y = 0; y < size.y; ++y) {
                for (int x = 0; x < size.x; ++x) {
                    const auto ray = support::referenceRay(scene_.camera, size, x, y);
                    const glm::dvec2 span = reference.span(ray);
                    const double slope = glm::dot(gradient, ray.direction);
                    const double at = (0.03 - glm::dot(gradient, ray.eye - center)) / slope;
                    // Rays that hit within a hair of a face may go either way.
                    if (!(at > span.x + 1e-3 && at < span.y - 1e-3)) continue;
                    ++hits;
                    const double fog = -std::expm1(-kFog * (at - span.x));
                    const double lit = 0.53 * std::abs(slope) / glm::length(gradient);
                    // Voxels are rounded to 2^-25, which turns the normal by 1e-6 and moves the
                    // plane by 1e-6; the rest is rounding of the fog.
                    ASSERT_NEAR(picture.at(x, y).r, fog + (1.0 - fog) * lit, 1e-5) << x << ' ' << y;
                    ASSERT_EQ(picture.at(x, y).a, 1.0F);
                }
            }
            EXPECT_GT(hits, 200);
        }
    }
}

/// Where `ray` first changes sides of a level between samples, by halving that step 50 times, and
/// the length of a step; huge: nowhere.
struct Crossing {
    double distance = 1e300;
    double dt = 0.0;
    double front = 0.0;  ///< Where the volume begins.
};
Crossing crossingOf(const support::VolumeReference& reference, const support::ReferenceRay& ray,
                    const std::vector<float>& levels, double stepWorld) {
    const glm::dvec2 span = reference.span(ray);
    Crossing found{.front = span.x};
    if (span.x > span.y) return found;
    const int steps = std::max(1, static_cast<int>(std::ceil((span.y - span.x) / stepWorld)));
    found.dt = (span.y - span.x) / steps;
    const auto side = [&](double s) {
        const double value = reference.valueAt(ray.eye + s * ray.direction);
        return std::count_if(levels.begin(), levels.end(),
                             [&](float level) { return value >= static_cast<double>(level); });
    };
    const auto before = side(span.x);
    for (int i = 0; i < steps; ++i) {
        double near = span.x + i * found.dt, far = near + found.dt;
        if (side(far) == before) continue;
        for (int halving = 0; halving < 50; ++halving) {
            const double middle = 0.5 * (near + far);
            (side(middle) == before ? near : far) = middle;
        }
        found.distance = far;
        break;
    }
    return found;
}

TEST_F(VoxelIsosurface, OfACurvedFieldIsWithinItsBoundOfTheCrossing) {
    const auto value = [](const glm::dvec3& p) {
        return 0.5 + 0.3 * std::sin(0.5 * p.x) * std::cos(0.3 * p.y) + 0.2 * std::sin(0.23 * p.z);
    };
    const data::Volume volume = support::volumeOf(kTurned, value);
    const std::vector<float> levels{0.35F, 0.62F, 0.8F};
    scene::Layer& layer = add("waves", support::volumeOf(kTurned, value), levels);
    layer.map = support::constantMap(glm::vec3(0.0F), 0.0F);
    addFog(kTurned);
    const support::VolumeReference reference{volume, Sampling::kTrilinear};
    look(kTurned, {15, 11, 19});
    const glm::ivec2 size{41, 33};
    for (const double step : {0.11, 0.4}) {
        scene_.layers[0].stepWorld = step;
        const auto picture = draw(scene_, size);
        int hits = 0, other = 0;
        double worst = 0.0;
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const auto ray = support::referenceRay(scene_.camera, size, x, y);
                const Crossing expected = crossingOf(reference, ray, levels, step);
                if (expected.distance > 1e299) continue;
                ++hits;
                const double length = -std::log1p(-picture.at(x, y).r) / kFog;
                const double off = std::abs(length - (expected.distance - expected.front));
                // A ray that all but touches a level may be seen to cross it in another step.
                other += off > expected.dt ? 1 : 0;
                if (off < expected.dt) worst = std::max(worst, off / expected.dt);
            }
        }
        EXPECT_GT(hits, 600);
        EXPECT_LE(other, hits / 200);
        // The fog tells lengths of up to 17 to 4e-6, a hundredth of the bound of the shorter step.
        EXPECT_LT(worst, 1.0 / 256) << step;
    }
}

// Of two layers the nearer one shows, whatever their order.
TEST_F(VoxelIsosurface, TheNearerOfTwoLayersShows) {
    const GridPlace place{.size = {5, 5, 9}};
    const auto ramp = [](const glm::dvec3& p) { return p.z / 8.0; };
    add("low", support::volumeOf(place, ramp), {0.3F});
    add("high", support::volumeOf(place, ramp), {0.6F});
    scene_.camera.projection = Projection::kOrthographic;
    scene_.camera.orthographicHeight = 2.0;
    for (const bool swapped : {false, true}) {
        if (swapped) std::swap(scene_.layers[0], scene_.layers[1]);
        scene_.camera.eye = {2, 2, 30};
        scene_.camera.center = {2, 2, 0};
        EXPECT_NEAR(draw(scene_, {3, 3}).at(1, 1).r, 0.6, 1e-6);
        scene_.camera.eye = {2, 2, -30};
        EXPECT_NEAR(draw(scene_, {3, 3}).at(1, 1).r, 0.3, 1e-6);
    }
}

// A slab of cells from z = 3 to 4, between levels at z = 2.4 and 4.8.
TEST_F(VoxelIsosurface, MeshesAndVoxelsHideEachOther) {
    const data::MeshInput slab = support::latticeMesh({.low = {-1, -1, 3}, .high = {5, 5, 4}});
    renderer_->addDataset("mesh", support::must(data::buildMesh(slab)));
    scene::Layer surface;
    surface.id = surface.dataset = "mesh";
    surface.model = RayModel::kSurface;
    surface.headlight = false;
    surface.surfaceColour = glm::vec3(0.125F);
    scene_.layers.push_back(surface);
    const auto ramp = [](const glm::dvec3& p) { return p.z / 8.0; };
    add("ramp", support::volumeOf({.size = {5, 5, 9}}, ramp), {0.3F});
    scene_.camera.orthographicHeight = 2.0;
    for (const auto projection : {Projection::kPerspective, Projection::kOrthographic}) {
        scene_.camera.projection = projection;
        const auto seenFrom = [&](double z, float level) {
            scene_.layers[1].levels.values = {level};
            scene_.camera.eye = {2, 2, z};
            scene_.camera.center = {2, 2, 3.5};
            return draw(scene_, {3, 3}).at(1, 1).r;
        };
        EXPECT_NEAR(seenFrom(30, 0.6F), 0.6, 1e-6);
        EXPECT_EQ(seenFrom(30, 0.3F), 0.125F);
        EXPECT_NEAR(seenFrom(-30, 0.3F), 0.3, 1e-6);
        EXPECT_EQ(seenFrom(-30, 0.6F), 0.125F);
    }
}

// One voxel that stands out is as high on both sides: central differences there are 0.
TEST_F(VoxelIsosurface, WhereTheFieldIsFlatItIsLitAsIfItFacedTheEye) {
    scene::Layer& layer =
        add("sheet",
            support::volumeOf({.size = {5, 5, 17}},
                              [](const glm::dvec3& p) { return p.z == 8.0 ? 1.0 : 0.0; }),
            {0.5F});
    layer.sampling = Sampling::kNearest;
    scene_.camera = {.eye = {2.1, 2.2, 30}, .center = {1.3, 2.4, 0}};
    scene_.camera.projection = Projection::kOrthographic;
    scene_.camera.orthographicHeight = 1.0;
    EXPECT_NEAR(draw(scene_, {3, 3}).at(1, 1).r, 0.5, 1e-6);
}

TEST_F(VoxelIsosurface, VolumesOfOneVoxelInADirectionHaveNoSlopeThere) {
    add("flat", support::volumeOf({.size = {1, 9, 9}}, [](const glm::dvec3& p) { return p.z / 8; }),
        {0.4F});
    scene_.camera = {.eye = {0, 4, 30}, .center = {0, 4, 0}, .up = {0, 1, 0}};
    scene_.camera.projection = Projection::kOrthographic;
    scene_.camera.orthographicHeight = 1.0;
    EXPECT_NEAR(draw(scene_, {1, 1}).at(0, 0).r, 0.4, 1e-6);
}

TEST_F(VoxelIsosurface, LevelsOutsideTheIntervalAreLeftOut) {
    scene::Layer& layer =
        add("ramp",
            support::volumeOf({.size = {5, 5, 9}}, [](const glm::dvec3& p) { return p.z / 8.0; }),
            {0.3F, 0.6F, 0.9F});
    scene_.camera = {.eye = {2, 2, 30}, .center = {2, 2, 0}};
    scene_.camera.projection = Projection::kOrthographic;
    scene_.camera.orthographicHeight = 2.0;
    EXPECT_NEAR(draw(scene_, {3, 3}).at(1, 1).r, 0.9, 1e-6);
    layer.interval = data::Range{.min = 0.25F, .max = 0.7F};
    EXPECT_NEAR(draw(scene_, {3, 3}).at(1, 1).r, 0.6, 1e-6);
    layer.interval = data::Range{.min = 0.65F, .max = 0.7F};
    EXPECT_EQ(draw(scene_, {3, 3}).at(1, 1), glm::vec4(0.0F));
}

// Two planes cut a turned volume: a ray's length is that between them within the box.
TEST_F(VoxelIsosurface, ClipPlanesCutVolumes) {
    addFog(kTurned);
    look(kTurned, {15, 11, 19});
    const glm::dvec3 center = centerOf(kTurned);
    const std::array<glm::dvec3, 2> normals{glm::dvec3(0.2, 1.0, -0.3), glm::dvec3(-2.0, 1.0, 3.0)};
    const std::array<double, 2> depths{-2.0, -4.0};
    for (std::size_t i = 0; i < 2; ++i) {
        scene_.clipPlanes.push_back(
            {.normal = normals[i], .offset = glm::dot(normals[i], center) + depths[i]});
    }
    const data::Volume shape = support::volumeOf(kTurned, [](const glm::dvec3&) { return 0.0; });
    const support::VolumeReference reference{shape, Sampling::kTrilinear};
    const glm::ivec2 size{41, 33};
    const auto picture = draw(scene_, size);
    int cut = 0, gone = 0;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const auto ray = support::referenceRay(scene_.camera, size, x, y);
            glm::dvec2 span = reference.span(ray);
            if (span.x > span.y) continue;
            const glm::dvec2 whole = span;
            for (std::size_t i = 0; i < 2; ++i) {
                const double rise = glm::dot(normals[i], ray.direction);
                const double at = (depths[i] - glm::dot(normals[i], ray.eye - center)) / rise;
                if (rise > 0.0) span.x = std::max(span.x, at);
                if (rise < 0.0) span.y = std::min(span.y, at);
            }
            cut += span != whole ? 1 : 0;
            gone += span.x > span.y ? 1 : 0;
            const double length = std::max(span.y - span.x, 0.0);
            // Distances of about 30 are off by 2^-21; the volume lies 1e5 from the origin.
            ASSERT_NEAR(picture.at(x, y).a, -std::expm1(-kFog * length), 3e-6) << x << ' ' << y;
        }
    }
    EXPECT_GT(cut, 200);
    EXPECT_GT(gone, 20);
}

TEST_F(VoxelIsosurface, ClipPlanesUncoverALevelBehind) {
    add("ramp",
        support::volumeOf({.size = {5, 5, 9}}, [](const glm::dvec3& p) { return p.z / 8.0; }),
        {0.3F, 0.6F});
    scene_.camera = {.eye = {2, 2, 30}, .center = {2, 2, 0}};
    scene_.camera.projection = Projection::kOrthographic;
    scene_.camera.orthographicHeight = 2.0;
    scene_.clipPlanes = {{.normal = {0, 0, -1}, .offset = -4.5}};  // z <= 4.5
    EXPECT_NEAR(draw(scene_, {3, 3}).at(1, 1).r, 0.3, 1e-6);
    scene_.clipPlanes = {{.normal = {0, 0, -1}, .offset = -2.0}};
    EXPECT_EQ(draw(scene_, {3, 3}).at(1, 1), glm::vec4(0.0F));
}

// What an X-ray does not meet lets all light through, as beside a mesh.
TEST_F(VoxelIsosurface, AnXrayIsWhiteBesideTheVolume) {
    addFog({.size = {5, 5, 5}});
    scene_.layers[0].model = RayModel::kXray;
    scene_.layers[0].extinctionScale = 2.0F;
    scene_.camera = {.eye = {2, 2, 30}, .center = {2, 2, 0}};
    scene_.camera.projection = Projection::kOrthographic;
    scene_.camera.orthographicHeight = 12.0;
    const auto picture = draw(scene_, {3, 3});
    EXPECT_EQ(picture.at(0, 0), glm::vec4(1.0F));
    EXPECT_NEAR(picture.at(1, 1).r, std::exp(-2.0 * kFog * 4.0), 1e-6);
}

}  // namespace
}  // namespace volcast
