#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/reference/scenes.h"

/// Changes that must not change the picture, or change it in a known way.
namespace volcast::reference::test {
namespace {

using scene::RayModel;

constexpr scene::PictureSize kSize{24, 24};

double wave(const glm::dvec3& p) {
    return 0.5 + 0.5 * std::sin(4.0 * p.x + 2.0 * p.y) * std::cos(3.0 * p.z);
}

/// A cube with a tunnel, points of float32, and fields of all kinds.
data::MeshInput tunnel(double unit = 1.0) {
    const glm::ivec3 cubes{4};
    const glm::dvec3 low{-1.0}, high{1.0};
    const auto moved = support::jitter(cubes, low, high, 0.15);
    data::MeshInput input = support::latticeMesh(
        {.cubes = cubes,
         .low = low,
         .high = high,
         .keep = [](const auto& c) { return c.x < 1 || c.x > 2 || c.y != 1; },
         .move = [&](const glm::dvec3& p) { return glm::dvec3{glm::vec3{moved(p)}}; }});
    support::addField(input, "f", data::Association::kVertex, wave);
    support::addField(input, "cells", data::Association::kCell, wave);
    support::addField(input, "corners", data::Association::kCellVertex,
                      [](const auto& p) { return wave(1.1 * p); });
    for (glm::dvec3& point : input.points) point *= unit;
    return input;
}

scene::Camera cameraAt(double unit = 1.0) {
    return {.eye = unit * glm::dvec3{1.5, 1.1, 3.1},
            .center = glm::dvec3{0.0},
            .up = {0.1, 1.0, 0.0},
            .fovyDegrees = 38.0};
}

std::vector<scene::Layer> allModels(float extinction = 3.0F) {
    std::vector<scene::Layer> layers;
    for (const scene::RayModelRow& row : scene::rayModels()) {
        scene::Layer layer = layerOf(row.model, ramp(extinction));
        layer.headlight = true;
        layer.levels.values = {0.3F, 0.6F};
        layers.push_back(layer);
    }
    return layers;
}

double largestDifference(const Picture& a, const Picture& b) {
    double largest = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        for (int c = 0; c < 4; ++c) {
            largest = std::max(largest, std::abs(a.pixels[i][c] - b.pixels[i][c]));
        }
    }
    return largest;
}

TEST(Properties, TheOrderOfPointsAndCellsChangesNothing) {
    const data::Mesh mesh = built(tunnel());
    const data::Mesh other = built(support::shuffled(tunnel(), 5));
    for (scene::Layer& layer : allModels()) {
        for (const char* field : {"f", "cells", "corners"}) {
            if (layer.model == RayModel::kIsosurface && std::string{field} == "cells") continue;
            layer.field = field;
            const auto scene = sceneOf(cameraAt(), {layer});
            // The same numbers in another order: rounding alone.
            EXPECT_LE(largestDifference(drawn(scene, mesh, kSize), drawn(scene, other, kSize)),
                      1e-12)
                << scene::name(layer.model) << ' ' << field;
        }
    }
}

TEST(Properties, UnitsChangeNothing) {
    const data::Mesh small = built(tunnel(0x1p-20)), large = built(tunnel(0x1p20));
    const std::vector<scene::Layer> ofSmall = allModels(3.0F * 0x1p20F);
    const std::vector<scene::Layer> ofLarge = allModels(3.0F * 0x1p-20F);
    for (std::size_t i = 0; i < ofSmall.size(); ++i) {
        scene::Layer near = ofSmall[i], far = ofLarge[i];
        near.exposure = 20.0F;
        far.exposure = -20.0F;
        const Picture a = drawn(sceneOf(cameraAt(0x1p-20), {near}), small, kSize);
        const Picture b = drawn(sceneOf(cameraAt(0x1p20), {far}), large, kSize);
        EXPECT_LE(largestDifference(a, b), 1e-12) << scene::name(near.model);
    }
}

TEST(Properties, TwoHalvesMakeAWhole) {
    const data::Mesh mesh = built(tunnel());
    const glm::dvec3 normal{0.3, -0.2, 1.0};  // The camera is on its positive side.
    for (const RayModel model : {RayModel::kVolume, RayModel::kXray, RayModel::kSplat}) {
        auto scene = sceneOf(cameraAt(), {layerOf(model, ramp(3.0F))});
        const Picture whole = drawn(scene, mesh, kSize);
        scene.clipPlanes = {{.normal = normal, .offset = 0.13}};
        const Picture near = drawn(scene, mesh, kSize);
        scene.clipPlanes = {{.normal = -2.0 * normal, .offset = -0.26}};
        const Picture far = drawn(scene, mesh, kSize);
        for (std::size_t i = 0; i < whole.pixels.size(); ++i) {
            const glm::dvec4 &a = near.pixels[i], &b = far.pixels[i];
            glm::dvec4 joined = a + (1.0 - a.a) * b;
            if (model == RayModel::kXray) joined = {a.r * b.r, a.g * b.g, a.b * b.b, 1.0};
            for (int c = 0; c < 4; ++c) ASSERT_NEAR(whole.pixels[i][c], joined[c], 1e-13);
        }
    }
}

TEST(Properties, WhereTheWorldLiesChangesLittle) {
    const glm::dvec3 offset{1e6, -2e6, 3e6};  // Held exactly by double next to these points.
    data::MeshInput moved = tunnel();
    for (glm::dvec3& point : moved.points) point += offset;
    const data::Mesh mesh = built(tunnel()), other = built(std::move(moved));
    scene::Camera camera = cameraAt();
    camera.eye += offset;
    camera.center += offset;
    for (const scene::Layer& layer : allModels()) {
        const Picture here = drawn(sceneOf(cameraAt(), {layer}), mesh, kSize);
        const Picture there = drawn(sceneOf(camera, {layer}), other, kSize);
        // The eye is rounded to 2^-31 of a unit, 4.7e-10, the slopes of pictures are below 10 but
        // at edges.
        for (std::size_t i = 0; i < here.pixels.size(); ++i) {
            if (here.nearEdge[i] != 0) continue;
            for (int c = 0; c < 4; ++c) {
                ASSERT_NEAR(here.pixels[i][c], there.pixels[i][c], 1e-7)
                    << scene::name(layer.model);
            }
        }
    }
}

TEST(Properties, PixelsAndThreadsChangeNothing) {
    const data::Mesh mesh = built(tunnel());
    const auto scene = sceneOf(
        cameraAt(), {layerOf(RayModel::kVolume, ramp(3.0F)), layerOf(RayModel::kMip, ramp(3.0F))});
    const Picture whole = drawn(scene, mesh, kSize);
    const data::Dataset dataset{built(tunnel())};
    const auto threaded = draw(scene, Bodies{{"mesh", makeBody(dataset)}}, kSize, {}, 3);
    ASSERT_TRUE(threaded.has_value());
    EXPECT_EQ(whole.pixels, threaded->pixels);
    EXPECT_EQ(whole.nearEdge, threaded->nearEdge);
    EXPECT_EQ(whole.piecesVisited, threaded->piecesVisited);
    EXPECT_EQ(whole.rays, threaded->rays);
    EXPECT_GT(threaded->cpuSeconds, 0.0);
    const Picture some = drawn(scene, mesh, kSize, {{23, 0}, {12, 11}, {12, 11}, {0, 23}});
    ASSERT_EQ(some.pixels.size(), 4U);
    const std::size_t indices[] = {23, 11 * 24 + 12, 11 * 24 + 12, 23 * 24};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(some.pixels[i], whole.pixels[indices[i]]);
        EXPECT_EQ(some.nearEdge[i], whole.nearEdge[indices[i]]);
    }
}

}  // namespace
}  // namespace volcast::reference::test
