// Measurements at once and in parts, and what they keep.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "renderer/accuracy/meter.h"
#include "tests/support/mesh_scenes.h"

namespace volcast::accuracy {
namespace {

using support::must;

class MeterTest : public support::MeshTest {
protected:
    MeterTest() {
        auto input = support::latticeMesh({.cubes = {4, 4, 4}});
        support::addField(input, "f", data::Association::kVertex,
                          [](const glm::dvec3& p) { return p.x + 0.5 * std::sin(4.0 * p.y); });
        use(std::move(input));
        job_ = {.scene = sceneOf(support::perspective({2.1, 1.7, 2.9}, glm::dvec3{0.5}),
                                 scene::RayModel::kVolume, support::ruler(0.1F, 0.9F), "f"),
                .size = {48, 40},
                .candidate = {.integrator = scene::Integrator::kAverage,
                              .evaluator = scene::MeshEvaluator::kWalk},
                .frames = 2,
                .pixels = 300,
                .countsSteps = true};
    }

    /// All parts; 0 frames or 1 are drawn in each.
    Result<Measurement> inParts(const Job& job) {
        for (;;) {
            const std::uint64_t before = renderer_->counters().framesDrawn;
            auto part = meter_.advance(job);
            EXPECT_LE(renderer_->counters().framesDrawn, before + 1);
            if (!part) return std::move(part).error();
            if (*part) return **part;
        }
    }

    Job job_;
    Meter meter_{*renderer_};
};

TEST_F(MeterTest, PartsComeToTheSameAsAllAtOnce) {
    const Measurement once = must(Meter{*renderer_}.measure(job_));
    EXPECT_EQ(once.all.pixels, 300U);
    EXPECT_GT(once.all.max, 0.0);
    EXPECT_EQ(once.frames, 2);
    EXPECT_GT(once.walkSteps, 0U);
    const Measurement parts = must(inParts(job_));
    EXPECT_EQ(parts.all.max, once.all.max);
    EXPECT_EQ(parts.inner.rms, once.inner.rms);
    EXPECT_EQ(parts.cellsPerRay, once.cellsPerRay);
    EXPECT_EQ(parts.walkSteps, once.walkSteps);
    EXPECT_EQ(parts.integrator, once.integrator);
    EXPECT_EQ(parts.frames, 2);
    EXPECT_LE(parts.minMs, parts.medianMs);
}

TEST_F(MeterTest, TheReferenceIsAskedOnceForAllCandidatesOfAPicture) {
    const Measurement first = must(inParts(job_));
    EXPECT_GE(first.reference.rays, 300U);
    EXPECT_GT(first.reference.raySeconds, 0.0);
    EXPECT_GT(first.reference.treeSeconds, 0.0);
    job_.candidate.integrator = scene::Integrator::kExact;
    const Measurement second = must(inParts(job_));
    EXPECT_EQ(second.reference.rays, 0U);
    EXPECT_LT(second.all.max, first.all.max);
    // Another picture of the same mesh: its tree is there.
    job_.pixels = 200;
    const Measurement third = must(inParts(job_));
    EXPECT_GE(third.reference.rays, 200U);
    EXPECT_LT(third.reference.treeSeconds, first.reference.treeSeconds);
}

TEST_F(MeterTest, ADatasetMayGoWhileTheReferenceIsAsked) {
    job_.size = {512, 512};
    job_.pixels = 0;
    for (int part = 0; part < 2; ++part) ASSERT_FALSE(must(meter_.advance(job_)).has_value());
    meter_.forget("mesh");
    renderer_->removeDataset("mesh");
    const auto gone = inParts(job_);
    ASSERT_FALSE(gone.has_value());
    EXPECT_EQ(gone.error().code, ErrorCode::kNotFound);
}

TEST_F(MeterTest, APictureOnRefiningGridsComesToTheSameAsACandidateOverAllPixels) {
    Job candidate = job_;
    candidate.pixels = 0;
    candidate.frames = 0;
    candidate.countsSteps = false;
    const Measurement all = must(Meter{*renderer_}.measure(candidate));
    Job picture{.scene = withCandidate(job_.scene, job_.candidate),
                .size = job_.size,
                .aim = Aim::kPicture};
    double largest = 0.0;
    double squares = 0.0;
    std::uint64_t pixels = 0;
    for (const int step : {4, 2, 1}) {
        picture.grid = {.step = step, .refines = step < 4, .endRow = job_.size.y};
        const Measurement part = must(inParts(picture));
        EXPECT_EQ(part.off.size(), part.all.pixels);
        for (const float off : part.off) largest = std::max<double>(largest, off);
        squares += part.all.rms * part.all.rms * static_cast<double>(part.all.pixels);
        pixels += part.all.pixels;
    }
    EXPECT_EQ(pixels, all.all.pixels);
    EXPECT_EQ(static_cast<float>(largest), static_cast<float>(all.all.max));
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(pixels)), all.all.rms, 1e-15);
    EXPECT_GT(all.all.max, 0.0);
    // Another way to draw: the reference is known.
    picture.grid = {.step = 4, .refines = false, .endRow = job_.size.y};
    picture.scene.layers[0].integrator = scene::Integrator::kExact;
    EXPECT_EQ(must(inParts(picture)).reference.rays, 0U);
}

TEST_F(MeterTest, AGridWithoutPixelsIsRefused) {
    Job picture{
        .scene = job_.scene, .size = job_.size, .aim = Aim::kPicture, .grid = {.endRow = 0}};
    EXPECT_EQ(inParts(picture).error().code, ErrorCode::kInvalidArgument);
}

TEST_F(MeterTest, AnotherJobBeginsAnew) {
    ASSERT_FALSE(must(meter_.advance(job_)).has_value());
    job_.candidate.integrator = scene::Integrator::kExact;
    EXPECT_EQ(must(inParts(job_)).integrator, "exact");
}

}  // namespace
}  // namespace volcast::accuracy
