#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>

namespace volcast::workers {

/// Tells when a GPU has lost so many workers that the software device serves better.
///
/// A loss counts against the GPU unless the picture that was being drawn is to blame. That shows
/// later: drawn by the next worker, the GPU was; given up after a second loss, the picture was.
class GpuTrust {
public:
    using Clock = std::chrono::steady_clock;
    static constexpr std::size_t kMostLosses = 3;
    static constexpr std::chrono::minutes kForgivenAfter{10};

    /// A worker was lost while it drew nothing, or what it had drawn before.
    void lost(Clock::time_point now) {
        losses_.push_back(now);
        while (losses_.size() > kMostLosses) losses_.pop_front();
    }
    /// A worker was lost over a new picture of `view`.
    void lostOver(std::uint64_t view, Clock::time_point now) { open_[view].push_back(now); }
    /// A picture of `view` was drawn: it was not what the workers were lost over.
    void drew(std::uint64_t view) {
        const auto found = open_.find(view);
        if (found == open_.end()) return;
        for (const Clock::time_point at : found->second) lost(at);
        open_.erase(found);
    }
    /// The picture was given up, or the view is gone.
    void forget(std::uint64_t view) { open_.erase(view); }

    /// kMostLosses within kForgivenAfter.
    [[nodiscard]] bool isLost(Clock::time_point now) const {
        return losses_.size() == kMostLosses && now - losses_.front() <= kForgivenAfter;
    }

private:
    std::deque<Clock::time_point> losses_;                         ///< The newest kMostLosses.
    std::map<std::uint64_t, std::deque<Clock::time_point>> open_;  ///< Not decided yet, by view.
};

}  // namespace volcast::workers
