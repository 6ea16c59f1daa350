#pragma once

#include <cstdint>
#include <deque>

#include "renderer/accuracy/measurement.h"
#include "renderer/base/result.h"
#include "server/session/frame_flow.h"
#include "volcast/v1/session.pb.h"

namespace volcast::session {

/// The comparison of one view's picture with the reference: on grids from coarse to fine, each in
/// parts.
class ViewDifference {
public:
    static constexpr std::uint64_t kUsualPixels = 65'536;
    static constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 20;
    static constexpr std::uint64_t kPartPixels = 32'768;  ///< About as many; 64 KiB of a message.
    static constexpr std::chrono::milliseconds kUsualTime{20'000};
    static constexpr std::chrono::milliseconds kMostTime{120'000};
    static constexpr int kCoarsest = 16;
    /// Tags begin here, so that none is one of ViewAccuracy.
    static constexpr std::uint64_t kFirstTag = std::uint64_t{1} << 63U;

    /// Begins anew; `inputSeq`: of the picture that `scene` was last drawn as.
    void start(const scene::Scene& scene, scene::PictureSize size, std::uint64_t inputSeq,
               const v1::MeasureDifference& asked, TimePoint now);
    [[nodiscard]] bool running() const noexcept { return running_; }
    /// The job to measure now; needs running(). `tag` comes back with its result.
    [[nodiscard]] accuracy::Job job(std::uint64_t& tag) const;
    /// False for a result that nobody waits for any more.
    bool measured(std::uint64_t tag, const Result<accuracy::Measurement>& result, TimePoint now);
    /// Ends what runs before it is complete.
    void stop(const std::string& why);
    /// What the client is told after start(), measured() and stop().
    [[nodiscard]] v1::DifferenceReport report(std::uint32_t view) const;

private:
    void add(const accuracy::Errors& errors);

    bool running_ = false;
    std::uint64_t tag_ = kFirstTag;  ///< Of the job under way; never used twice.
    scene::Scene scene_;
    scene::PictureSize size_{1};
    TimePoint end_{};
    std::chrono::milliseconds limit_{0};
    std::deque<accuracy::Grid> parts_;  ///< The one under way first.
    std::uint64_t planned_ = 0;         ///< Pixels of all parts.
    double squares_ = 0.0;              ///< Mean over channels, summed over pixels.
    double over255_ = 0.0;              ///< Pixels.
    v1::DifferenceReport report_;
};

/// Grids whose pixels are those of `size`, from coarse to fine, each in parts of about
/// `partPixels`; as many whole grids as have `mostPixels` together, but at least the first.
std::deque<accuracy::Grid> refiningGrids(scene::PictureSize size, std::uint64_t mostPixels,
                                         std::uint64_t partPixels);

}  // namespace volcast::session
