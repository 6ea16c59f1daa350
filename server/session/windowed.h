#pragma once

#include <chrono>
#include <optional>

namespace volcast::session {

/// The best of what was seen lately, by `Better` (std::less keeps the smallest): over the last
/// whole window and the one that runs, so a value is remembered for one to two windows.
template <class T, class Better>
class Windowed {
public:
    using Time = std::chrono::steady_clock::time_point;
    explicit Windowed(std::chrono::milliseconds window) : window_{window} {}

    void see(T value, Time now) {
        if (now - start_ > window_) {
            last_ = now - start_ > 2 * window_ ? std::nullopt : current_;
            current_.reset();
            start_ = now;
        }
        if (!current_ || Better{}(value, *current_)) current_ = value;
    }
    [[nodiscard]] std::optional<T> best() const {
        if (!last_) return current_;
        return !current_ || Better{}(*last_, *current_) ? last_ : current_;
    }

private:
    std::chrono::milliseconds window_;
    Time start_{};
    std::optional<T> current_, last_;
};

}  // namespace volcast::session
