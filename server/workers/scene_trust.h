#pragma once

#include <algorithm>
#include <chrono>

namespace volcast::workers {

/// For how long a view keeps to its last good scene after several others took down workers: each
/// new one would cost everybody two deadlines, however little it differs.
///
/// Not at all after the first, then 30 s, doubled with each scene up to 10 min. All is forgiven ten
/// minutes after the last one and its pause.
class SceneTrust {
public:
    using Clock = std::chrono::steady_clock;

    void tookDownWorkers(Clock::time_point now) noexcept {
        if (now >= forgiven_) scenes_ = 0;
        ++scenes_;
        const int doublings = std::min(scenes_ - kScenesToPause, kDoublings);
        until_ = doublings < 0 ? now : now + std::min(kFirst * (1 << doublings), kLongest);
        forgiven_ = until_ + kForgivenAfter;
    }

    /// What is left of the pause, rounded up; 0: there is none.
    [[nodiscard]] std::chrono::seconds pause(Clock::time_point now) const noexcept {
        return std::max(std::chrono::ceil<std::chrono::seconds>(until_ - now),
                        std::chrono::seconds{0});
    }
    /// That took down workers and are not forgiven.
    [[nodiscard]] int scenes() const noexcept { return scenes_; }

private:
    static constexpr int kScenesToPause = 2;
    static constexpr int kDoublings = 12;
    static constexpr std::chrono::seconds kFirst{30};
    static constexpr std::chrono::seconds kLongest{600};
    static constexpr std::chrono::minutes kForgivenAfter{10};

    int scenes_ = 0;
    Clock::time_point until_;
    Clock::time_point forgiven_;
};

}  // namespace volcast::workers
