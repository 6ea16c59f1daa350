#pragma once

#include <algorithm>
#include <chrono>

namespace volcast::workers {

/// How long to wait before the next worker is started: not at all, then 100 ms, doubled with each
/// worker that dies before it is ready, up to 30 s.
class BackOff {
public:
    void failed() noexcept { ++failures_; }
    void succeeded() noexcept { failures_ = 0; }
    [[nodiscard]] int failures() const noexcept { return failures_; }

    [[nodiscard]] std::chrono::milliseconds delay() const noexcept {
        if (failures_ == 0) return std::chrono::milliseconds{0};
        return std::min(kFirst * (1 << std::min(failures_ - 1, kDoublings)), kLongest);
    }

private:
    static constexpr std::chrono::milliseconds kFirst{100};
    static constexpr std::chrono::milliseconds kLongest{30'000};
    static constexpr int kDoublings = 12;

    int failures_ = 0;
};

}  // namespace volcast::workers
