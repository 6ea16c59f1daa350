#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>

#include "server/session/windowed.h"

namespace volcast::session {

using Clock = std::chrono::steady_clock;
using TimePoint = Clock::time_point;

/// What one ack says.
struct FrameAck {
    std::uint32_t sequence = 0;
    std::chrono::microseconds hold{0};  ///< Received -> shown.
    std::uint32_t queued = 0;           ///< Frames waiting in the client.
    bool keyframe = false;              ///< It could not decode its video: a keyframe is needed.
    std::chrono::microseconds path{0};  ///< Shortest round trip of a ping lately; 0: none came.
};

/// What acks tell about the way to a client and back, and so how much may be under way.
///
/// A window of ceil(frames/s * shortest round trip) + 1 frames in [2, 8] (without the 1 where
/// queueing delay is over 15 ms), while less than two bandwidth-delay products are under way; one
/// frame where the consumer is slow: by its own queue, by how long it holds frames, or by queueing
/// delay (round trip over its windowed minimum, so that distance is no punishment). A client that
/// is silent for 2 s, and the time that what is under way needs, gets one probe; 2 s later it gets
/// nothing until it acks something.
class FrameFlow {
public:
    static constexpr std::chrono::milliseconds kProbeAfter{2000};
    static constexpr std::chrono::milliseconds kSlowDelay{50};
    static constexpr std::chrono::milliseconds kShortQueue{15};
    static constexpr std::chrono::milliseconds kCalm{1000};  ///< Calm time before two again.
    static constexpr std::chrono::milliseconds kMinimumWindow{15'000};
    static constexpr std::chrono::milliseconds kRateWindow{3000};
    static constexpr std::size_t kMostFrames = 8;

    /// A frame of so many bytes was handed to the socket.
    void sent(std::uint32_t sequence, std::size_t bytes, TimePoint now);

    /// Takes frames up to `ack.sequence` as shown; false where no such frame is under way.
    bool acked(const FrameAck& ack, TimePoint now);

    /// Gives up waiting for what is under way where the client has been silent for too long.
    void forgiveSilence(TimePoint now);

    [[nodiscard]] std::size_t window(TimePoint now) const;
    /// With `committed` frames on their way to the socket besides those under way, one more may
    /// follow.
    [[nodiscard]] bool credit(std::size_t committed, TimePoint now) const;
    [[nodiscard]] std::size_t underWay() const noexcept { return underWay_.size(); }
    [[nodiscard]] std::size_t bytesUnderWay() const noexcept { return bytesUnderWay_; }
    /// Two bandwidth-delay products; empty before the first ack.
    [[nodiscard]] std::optional<std::size_t> byteCap() const;
    /// When forgiveSilence() will do something; empty where nothing is under way.
    [[nodiscard]] std::optional<TimePoint> probeAt() const;
    /// Nothing more is sent, as nothing was acked for too long.
    [[nodiscard]] bool stopped() const noexcept { return silence_ == Silence::kStopped; }

    /// Smoothed, without the client's holding time; 0 before the first ack.
    [[nodiscard]] std::chrono::microseconds roundTrip() const noexcept { return roundTrip_; }
    [[nodiscard]] std::chrono::microseconds shortestRoundTrip() const;
    /// Smoothed excess of round trips over the shortest.
    [[nodiscard]] std::chrono::microseconds queueDelay() const noexcept { return queueDelay_; }
    /// What even the quickest of the latest frames took longer than a ping: its bytes' own time on
    /// a thin way. 0 where no ping was answered.
    [[nodiscard]] std::chrono::microseconds transferDelay() const;
    /// Most that the client was seen to take lately; 0 before the first ack.
    [[nodiscard]] double bytesPerS() const { return bytesPerS_.best().value_or(0.0); }
    [[nodiscard]] double framesPerS() const { return framesPerS_.best().value_or(0.0); }
    /// What was measured of frames of another kind says little about the next: the queueing delay
    /// begins anew with the next round trip.
    void forgetDelay() { measured_ = false; }

private:
    struct Sent {
        std::uint32_t sequence;
        std::size_t bytes;
        TimePoint at;
        // When the bytes that were shown until then were shown: a rate needs both ends.
        TimePoint since;
        std::uint64_t bytesBefore, framesBefore;
    };
    enum class Silence { kNone, kProbing, kStopped };
    void measure(std::chrono::microseconds roundTrip, TimePoint now);

    std::deque<Sent> underWay_;
    std::size_t bytesUnderWay_ = 0;
    std::size_t lastBytes_ = 0;  ///< Of the newest frame: what the next one is likely to have.
    std::uint32_t lastSequence_ = 0;
    std::uint64_t bytesShown_ = 0, framesShown_ = 0;
    TimePoint shownAt_{};
    TimePoint heardAt_{};
    TimePoint slowUntil_{};
    Silence silence_ = Silence::kNone;
    std::chrono::microseconds roundTrip_{0}, queueDelay_{0}, path_{0};
    bool measured_ = false;
    Windowed<std::chrono::microseconds, std::less<>> shortest_{kMinimumWindow};
    Windowed<double, std::greater<>> bytesPerS_{kRateWindow}, framesPerS_{kRateWindow};
};

}  // namespace volcast::session
