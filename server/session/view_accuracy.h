#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "renderer/accuracy/measurement.h"
#include "renderer/accuracy/measurement_effects.h"
#include "renderer/base/result.h"
#include "volcast/v1/session.pb.h"

namespace volcast::session {

/// The measurement that runs for one view: which candidate is next, and what was found so far.
class ViewAccuracy {
public:
    static constexpr std::uint64_t kUsualPixels = 1000;
    static constexpr std::uint64_t kMostPixels = 65'536;
    static constexpr int kFrames = 3;        ///< Timed, for each candidate.
    static constexpr int kEffectFrames = 7;  ///< The same of pictures without an effect.

    /// Begins anew with all candidates of `scene`.
    /// `volumes`: ids of its datasets that are voxels.
    void start(const scene::Scene& scene, scene::PictureSize size, std::uint64_t pixels,
               const std::set<std::string>& volumes);
    /// Begins anew, with what each effect takes that is on in `plan`.
    void startEffects(const scene::Scene& scene, scene::PictureSize size, const v1::Plan& plan);
    /// Begins anew, with what plans with bounds go by.
    void startEstimates(const scene::Scene& scene, scene::PictureSize size);
    [[nodiscard]] bool running() const noexcept { return running_; }
    /// The job to measure now; needs running(). `tag` comes back with its result.
    [[nodiscard]] accuracy::Job job(std::uint64_t& tag) const;
    /// False for a result that nobody waits for any more.
    bool measured(std::uint64_t tag, const Result<accuracy::Measurement>& result);
    /// Ends what runs before it is complete.
    void stop() noexcept { running_ = false; }
    /// What the client is told; rows on the front are marked.
    [[nodiscard]] v1::AccuracyReport report(std::uint32_t view) const;

private:
    void takeEstimates(const plan::SceneEvidence& estimates);
    void takeTime(const Result<accuracy::Measurement>& result);
    void take(const Result<accuracy::Measurement>& result);
    [[nodiscard]] double progress() const;

    bool running_ = false;
    accuracy::Aim aim_ = accuracy::Aim::kCandidate;
    std::string refusal_;    ///< Why there are no estimates.
    std::uint64_t tag_ = 0;  ///< Of the job under way; never used twice.
    scene::Scene scene_;
    scene::PictureSize size_{1};
    std::uint64_t pixels_ = kUsualPixels;
    std::vector<accuracy::Candidate> candidates_;
    std::vector<v1::AccuracyRow> rows_;
    std::vector<accuracy::WithoutEffect> without_;
    std::optional<double> pictureMs_;  ///< With all effects.
    std::vector<v1::EffectTime> times_;
};

}  // namespace volcast::session
