#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace volcast::session {

/// Counts a client's messages against a limit: `perSecond` on average, as many at once.
class MessageRate {
public:
    using TimePoint = std::chrono::steady_clock::time_point;

    explicit MessageRate(std::uint32_t perSecond)
        : perSecond_{static_cast<double>(perSecond)}, left_{perSecond_} {}

    /// False where this message is one too many.
    bool take(TimePoint now) {
        const std::chrono::duration<double> gone = now - last_;
        last_ = now;
        left_ = std::min(perSecond_, left_ + std::max(gone.count(), 0.0) * perSecond_);
        if (left_ < 1) return false;
        left_ -= 1;
        return true;
    }

private:
    double perSecond_;
    double left_;
    TimePoint last_{};
};

}  // namespace volcast::session
