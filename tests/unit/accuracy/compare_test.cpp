#include "renderer/accuracy/compare.h"

#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "renderer/scene/ray_models.h"

namespace volcast::accuracy {
namespace {

/// Four pixels in a row of a picture two pixels wide, all black, the third near an edge.
reference::Picture blackTruth() {
    reference::Picture truth;
    truth.size = {2, 2};
    truth.pixels.assign(4, glm::dvec4(0.0));
    truth.nearEdge = {0, 0, 1, 0};
    return truth;
}

TEST(Compare, CountsEveryPixelAndThoseAwayFromEdges) {
    const std::vector<glm::ivec2> pixels{{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    std::vector<float> rgba(16, 0.0F);
    rgba[4 + 1] = 0.25F;      // Pixel (1, 0), green.
    rgba[8 + 3] = -0.5F;      // Pixel (0, 1), near an edge.
    rgba[12 + 0] = 0x1p-10F;  // Between 1/65535 and 1/255.
    const Difference off = compare(blackTruth(), pixels, rgba, 2);
    // All sums are of powers of two: exact in double.
    EXPECT_EQ(off.all.max, 0.5);
    EXPECT_EQ(off.all.rms, std::sqrt((0.0625 + 0.25 + 0x1p-20) / 16.0));
    EXPECT_EQ(off.all.share255, 0.5);
    EXPECT_EQ(off.all.share65535, 0.75);
    EXPECT_EQ(off.all.pixels, 4U);
    EXPECT_EQ(off.inner.max, 0.25);
    EXPECT_EQ(off.inner.share255, 1.0 / 3.0);
    EXPECT_EQ(off.inner.pixels, 3U);
}

TEST(Compare, FindsThePixelsOfASampleInThePicture) {
    reference::Picture truth = blackTruth();
    truth.pixels.assign(1, glm::dvec4(0.5));
    truth.nearEdge = {0};
    std::vector<float> rgba(16, 0.0F);
    std::fill(rgba.begin() + 8, rgba.begin() + 12, 0.5F);  // (0, 1).
    const std::vector<glm::ivec2> pixels{{0, 1}};
    EXPECT_EQ(compare(truth, pixels, rgba, 2).all.max, 0.0);
}

TEST(Compare, WhatIsNoNumberIsInfinitelyOff) {
    const std::vector<glm::ivec2> pixels{{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    std::vector<float> rgba(16, 0.0F);
    rgba[2] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(compare(blackTruth(), pixels, rgba, 2).all.max,
              std::numeric_limits<double>::infinity());
}

TEST(SamplePixels, AreDifferentInsideAndAsManyAsAskedFor) {
    const scene::PictureSize size{40, 30};
    const std::vector<glm::ivec2> pixels = samplePixels(size, 500);
    std::set<std::pair<int, int>> seen;
    std::size_t left = 0;
    for (const glm::ivec2& pixel : pixels) {
        EXPECT_TRUE(pixel.x >= 0 && pixel.x < 40 && pixel.y >= 0 && pixel.y < 30);
        seen.emplace(pixel.x, pixel.y);
        if (pixel.x < 20) ++left;
    }
    EXPECT_EQ(seen.size(), 500U);
    EXPECT_NEAR(static_cast<double>(left), 250.0, 15.0);  // Evenly: chance alone spreads by 11.
    EXPECT_EQ(samplePixels(size, 500), pixels);
    EXPECT_EQ(samplePixels(size, 0).size(), 1200U);
    EXPECT_EQ(samplePixels(size, 9999).size(), 1200U);
}

TEST(Candidates, AreAllThatTheRegistryHasForVisibleLayers) {
    scene::Scene scene;
    for (const scene::RayModel model :
         {scene::RayModel::kSurface, scene::RayModel::kMip, scene::RayModel::kXray}) {
        scene::Layer& layer = scene.layers.emplace_back();
        layer.model = model;
    }
    scene.layers[1].visible = false;
    const std::vector<Candidate> found = candidates(scene);
    // The surface in its one way, xray by three integrators with two evaluators each.
    ASSERT_EQ(found.size(), 7U);
    EXPECT_EQ(found[0], (Candidate{.layer = 0, .integrator = scene::Integrator::kExact}));
    EXPECT_EQ(found[1], (Candidate{.layer = 2,
                                   .integrator = scene::Integrator::kFront,
                                   .evaluator = scene::MeshEvaluator::kWalk}));
    EXPECT_EQ(found.back(), (Candidate{.layer = 2,
                                       .integrator = scene::Integrator::kExact,
                                       .evaluator = scene::MeshEvaluator::kProjection}));
    // Of voxels xray has four integrators of its own.
    scene.layers[2].dataset = "voxels";
    const std::vector<Candidate> more = candidates(scene, {"voxels"});
    ASSERT_EQ(more.size(), 5U);
    EXPECT_EQ(more.back(), (Candidate{.layer = 2, .integrator = scene::Integrator::kAdaptive}));
}

}  // namespace
}  // namespace volcast::accuracy
