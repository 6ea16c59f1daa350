#include "server/session/view_difference.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "renderer/worker/measure_message.h"

namespace volcast::session {
namespace {

/// A first grid of fewer pixels says little.
constexpr std::uint64_t kLeastFirst = 64;

std::uint64_t count(int side, int step) {
    return static_cast<std::uint64_t>((side + step - 1) / step);
}

std::uint64_t onGrid(scene::PictureSize size, int step) {
    return count(size.x, step) * count(size.y, step);
}

}  // namespace

std::deque<accuracy::Grid> refiningGrids(scene::PictureSize size, std::uint64_t mostPixels,
                                         std::uint64_t partPixels) {
    int coarsest = ViewDifference::kCoarsest;
    while (coarsest > 1 && onGrid(size, coarsest) < kLeastFirst) coarsest /= 2;
    std::deque<accuracy::Grid> grids;
    for (int step = coarsest; step >= 1; step /= 2) {
        if (step < coarsest && onGrid(size, step) > mostPixels) break;
        const std::uint64_t rowsAPart =
            std::max(std::uint64_t{1}, partPixels / count(size.x, step));
        const int rows = static_cast<int>(std::min(rowsAPart, count(size.y, step))) * step;
        for (int row = 0; row < size.y; row += rows) {
            const accuracy::Grid part{.step = step,
                                      .refines = step < coarsest,
                                      .firstRow = row,
                                      .endRow = std::min(row + rows, size.y)};
            if (!accuracy::gridPixels(size, part).empty()) grids.push_back(part);
        }
    }
    return grids;
}

void ViewDifference::start(const scene::Scene& scene, scene::PictureSize size,
                           std::uint64_t inputSeq, const v1::MeasureDifference& asked,
                           TimePoint now) {
    const std::uint64_t most = asked.max_pixels() == 0 ? kUsualPixels : asked.max_pixels();
    limit_ = asked.max_ms() == 0 ? kUsualTime
                                 : std::min<std::chrono::milliseconds>(
                                       std::chrono::milliseconds{asked.max_ms()}, kMostTime);
    scene_ = scene;
    size_ = size;
    end_ = now + limit_;
    parts_ = refiningGrids(size, std::min(most, kMostPixels), kPartPixels);
    planned_ = 0;
    for (const accuracy::Grid& part : parts_) planned_ += gridPixels(size, part).size();
    squares_ = over255_ = 0.0;
    report_.Clear();
    report_.set_input_seq(inputSeq);
    report_.set_width(static_cast<std::uint32_t>(size.x));
    report_.set_height(static_cast<std::uint32_t>(size.y));
    ++tag_;
    running_ = true;
}

accuracy::Job ViewDifference::job(std::uint64_t& tag) const {
    tag = tag_;
    return {.scene = scene_, .size = size_, .aim = accuracy::Aim::kPicture, .grid = parts_.front()};
}

void ViewDifference::add(const accuracy::Errors& errors) {
    const auto pixels = static_cast<double>(errors.pixels);
    squares_ += errors.rms * errors.rms * pixels;
    over255_ += errors.share255 * pixels;
    report_.set_pixels(report_.pixels() + errors.pixels);
    const auto all = static_cast<double>(report_.pixels());
    report_.set_max_error(std::max(report_.max_error(), errors.max));
    report_.set_rms_error(std::sqrt(squares_ / all));
    report_.set_share_over_255(over255_ / all);
    report_.set_progress(all / static_cast<double>(planned_));
}

bool ViewDifference::measured(std::uint64_t tag, const Result<accuracy::Measurement>& result,
                              TimePoint now) {
    if (!running_ || tag != tag_) return false;
    ++tag_;
    if (!result) {
        stop(result.error().message);
        return true;
    }
    const accuracy::Grid part = parts_.front();
    parts_.pop_front();
    report_.set_step(static_cast<std::uint32_t>(part.step));
    report_.set_refines(part.refines);
    report_.set_first_row(static_cast<std::uint32_t>(part.firstRow));
    report_.set_off(worker::halves(result->off));
    add(result->all);
    running_ = !parts_.empty() && now < end_;
    if (!parts_.empty() && !running_) {
        report_.set_stopped("its time of " + std::to_string(limit_.count()) + " ms is over");
    }
    return true;
}

void ViewDifference::stop(const std::string& why) {
    running_ = false;
    report_.clear_off();
    report_.set_stopped(why);
}

v1::DifferenceReport ViewDifference::report(std::uint32_t view) const {
    v1::DifferenceReport report = report_;
    report.set_view(view);
    report.set_done(!running_);
    return report;
}

}  // namespace volcast::session
