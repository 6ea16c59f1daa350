#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>

namespace volcast::session {

using Clock = std::chrono::steady_clock;
using TimePoint = Clock::time_point;

/// What one ack says.
struct FrameAck {
    std::uint32_t sequence = 0;
    std::chrono::microseconds hold{0};  ///< Received -> shown.
    std::uint32_t queued = 0;           ///< Frames waiting in the client.
};

/// How many frames of one view may be under way to its client.
///
/// Two, or one where the consumer is slow: by its own queue, by how long it holds frames, or by
/// queueing delay (round trip over its windowed minimum, so that distance is no punishment).
/// A client that is silent for 2 s gets one probe each 2 s.
class FrameFlow {
public:
    static constexpr std::chrono::milliseconds kProbeAfter{2000};
    static constexpr std::chrono::milliseconds kSlowDelay{50};
    static constexpr std::chrono::milliseconds kCalm{1000};  ///< Calm time before two again.
    static constexpr std::chrono::milliseconds kMinimumWindow{5000};

    /// A frame was handed to the socket.
    void sent(std::uint32_t sequence, TimePoint now);

    /// Takes frames up to `ack.sequence` as shown; false where no such frame is under way.
    bool acked(const FrameAck& ack, TimePoint now);

    /// Gives up waiting for what is under way where the client has been silent for kProbeAfter.
    void forgiveSilence(TimePoint now);

    [[nodiscard]] std::size_t window(TimePoint now) const;
    [[nodiscard]] std::size_t underWay() const noexcept { return underWay_.size(); }
    /// When forgiveSilence() will free credits; empty where nothing is under way.
    [[nodiscard]] std::optional<TimePoint> probeAt() const;
    /// Smoothed, without the client's holding time; 0 before the first ack.
    [[nodiscard]] std::chrono::microseconds roundTrip() const noexcept { return roundTrip_; }

private:
    struct Sent {
        std::uint32_t sequence;
        TimePoint at;
    };
    void measure(std::chrono::microseconds roundTrip, TimePoint now);
    [[nodiscard]] std::chrono::microseconds minimum() const;

    std::deque<Sent> underWay_;
    TimePoint slowUntil_{};
    bool silent_ = false;  ///< Frames were given up since the last ack.
    std::chrono::microseconds roundTrip_{0};
    TimePoint windowStart_{};
    std::optional<std::chrono::microseconds> thisMinimum_, lastMinimum_;
};

}  // namespace volcast::session
