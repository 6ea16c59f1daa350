// Which pixels a picture is compared at, in which order, and what is told of it.
#include "server/session/view_difference.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace volcast::session {
namespace {

using std::chrono::milliseconds;

std::size_t pixelsOf(scene::PictureSize size, const std::deque<accuracy::Grid>& grids) {
    std::set<std::pair<int, int>> pixels;
    for (const accuracy::Grid& grid : grids) {
        for (const glm::ivec2& pixel : accuracy::gridPixels(size, grid)) {
            EXPECT_TRUE(pixels.emplace(pixel.x, pixel.y).second) << pixel.x << ", " << pixel.y;
        }
    }
    return pixels.size();
}

TEST(RefiningGrids, HaveEveryPixelOnceWhereThatManyMayBeCompared) {
    for (const scene::PictureSize size : {scene::PictureSize{1, 1}, {1, 9}, {40, 31}, {301, 200}}) {
        const std::size_t all = static_cast<std::size_t>(size.x) * size.y;
        EXPECT_EQ(pixelsOf(size, refiningGrids(size, all, 1000)), all) << size.x << " x " << size.y;
    }
}

TEST(RefiningGrids, GoFromCoarseToFineInPartsOfAboutTheSizeThatIsAskedFor) {
    const scene::PictureSize size{640, 480};
    const auto grids = refiningGrids(size, 640 * 480, 5000);
    EXPECT_EQ(grids.front().step, ViewDifference::kCoarsest);
    int step = grids.front().step;
    for (const accuracy::Grid& grid : grids) {
        EXPECT_TRUE(grid.step == step || 2 * grid.step == step) << grid.step;
        step = grid.step;
        EXPECT_LE(accuracy::gridPixels(size, grid).size(), 5000U);
    }
    EXPECT_EQ(step, 1);
}

TEST(RefiningGrids, LeaveOutAGridThatGoesBeyondTheLimitButNotTheFirst) {
    const auto grids = refiningGrids({640, 480}, 320 * 240, 1 << 20);
    EXPECT_EQ(grids.back().step, 2);
    EXPECT_EQ(pixelsOf({640, 480}, grids), 320U * 240U);
    EXPECT_EQ(refiningGrids({8192, 8192}, 1, 1 << 20).back().step, ViewDifference::kCoarsest);
}

class ViewDifferenceTest : public testing::Test {
protected:
    void start(v1::MeasureDifference asked = {}) {
        asked.set_max_pixels(1 << 20);
        difference.start({}, {20, 16}, 7, asked, now);
    }
    accuracy::Job job() {
        const accuracy::Job job = difference.job(tag);
        EXPECT_EQ(job.aim, accuracy::Aim::kPicture);
        return job;
    }
    /// As many pixels as the part has, all off by so much.
    static accuracy::Measurement found(const accuracy::Job& job, double off) {
        const auto pixels = accuracy::gridPixels(job.size, job.grid).size();
        accuracy::Measurement found;
        found.off.assign(pixels, static_cast<float>(off));
        found.all = {.max = off, .rms = off, .share255 = off > 1 / 255.0 ? 1.0 : 0.0};
        found.all.pixels = pixels;
        return found;
    }

    TimePoint now{};
    std::uint64_t tag = 0;
    ViewDifference difference;
};

TEST_F(ViewDifferenceTest, FiguresAreThoseOfAllPartsTogether) {
    start();
    std::uint64_t pixels = 0;
    double squares = 0.0;
    double off = 0.25;
    while (difference.running()) {
        const accuracy::Job part = job();
        const accuracy::Measurement result = found(part, off);
        pixels += result.all.pixels;
        squares += off * off * static_cast<double>(result.all.pixels);
        ASSERT_TRUE(difference.measured(tag, result, now));
        const v1::DifferenceReport report = difference.report(3);
        EXPECT_EQ(report.view(), 3U);
        EXPECT_EQ(report.input_seq(), 7U);
        EXPECT_EQ(report.step(), static_cast<std::uint32_t>(part.grid.step));
        EXPECT_EQ(report.off().size(), 2 * result.all.pixels) << "float16";
        EXPECT_EQ(report.pixels(), pixels);
        EXPECT_EQ(report.max_error(), 0.25);
        EXPECT_NEAR(report.rms_error(), std::sqrt(squares / static_cast<double>(pixels)), 1e-15);
        off /= 128.0;
    }
    const v1::DifferenceReport last = difference.report(3);
    EXPECT_EQ(pixels, 320U);
    EXPECT_TRUE(last.done());
    EXPECT_EQ(last.stopped(), "");
    EXPECT_EQ(last.progress(), 1.0);
    EXPECT_NEAR(last.share_over_255(), 80.0 / 320.0, 1e-15) << "the first grid alone";
}

TEST_F(ViewDifferenceTest, NothingBeginsAfterItsTime) {
    v1::MeasureDifference asked;
    asked.set_max_ms(50);
    start(asked);
    const accuracy::Measurement result = found(job(), 0.0);
    ASSERT_TRUE(difference.measured(tag, result, now + milliseconds{50}));
    EXPECT_FALSE(difference.running());
    EXPECT_EQ(difference.report(1).stopped(), "its time of 50 ms is over");
    EXPECT_EQ(difference.report(1).off().size(), 2 * result.all.pixels) << "what is known is told";
}

TEST_F(ViewDifferenceTest, WhatFailsOrComesLateIsNotMistakenForAPart) {
    start();
    static_cast<void>(job());
    const std::uint64_t old = tag;
    start();
    static_cast<void>(job());
    EXPECT_FALSE(difference.measured(old, accuracy::Measurement{}, now));
    ASSERT_TRUE(difference.measured(tag, fail(ErrorCode::kNotFound, "no mesh"), now));
    EXPECT_FALSE(difference.running());
    EXPECT_EQ(difference.report(1).stopped(), "no mesh");
    EXPECT_EQ(difference.report(1).off(), "");
}

}  // namespace
}  // namespace volcast::session
