#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/session/frame_flow.h"
#include "server/session/pace_ladder.h"

namespace volcast::session {

/// What was decided about a client's frames, and from what; the header of each frame says it.
struct PaceReport {
    PaceLevel level;
    std::size_t window = 0, underWay = 0;
    std::chrono::microseconds roundTrip{0}, shortestRoundTrip{0}, queueDelay{0};
    double bytesPerS = 0.0;
    std::string reason;  ///< Of the last step; empty before the first.
};

/// Decides how many frames of a view are under way to one client, and how they are made.
///
/// Transfer and queueing delay over 50 ms together, or more than two frames waiting in the client:
/// a step down the PaceLadder, two over 100 ms and three over 200 ms; transfer counts only as long
/// as steps make pictures of fewer bytes. Queueing delay under 15 ms, and transfer under 33 ms
/// where pictures would get larger, for a second, or longer where the last steps up had to be taken
/// back: one step up. At least a second lies between steps, and what was sent before a step does
/// not count towards the next. Has no clock and no socket.
class Pacing {
public:
    static constexpr std::chrono::milliseconds kDownOver{50};
    static constexpr std::chrono::milliseconds kUpUnder{15};
    /// Of transfer: a step up that makes half as many bytes more stays below kDownOver.
    static constexpr std::chrono::milliseconds kUpTransfer{33};
    static constexpr std::chrono::milliseconds kBetweenSteps{1000};
    static constexpr std::chrono::milliseconds kLongestCalm{32'000};
    /// A step up that holds for so long was right.
    static constexpr std::chrono::milliseconds kProven{10'000};

    void setPins(const PacePins& pins) { ladder_.setPins(pins); }
    /// The client shows a video codec in right colours, or does not.
    void allowVideo(bool hasVideo) { ladder_.allowVideo(hasVideo); }

    /// A picture begins to be made; starts are as far apart as the rate asks.
    void started(TimePoint now) { startedAt_ = now; }
    void sent(std::uint32_t sequence, std::size_t bytes, TimePoint now);
    void acked(const FrameAck& ack, TimePoint now);
    void forgiveSilence(TimePoint now) { flow_.forgiveSilence(now); }

    /// One more picture may be encoded, with `committed` on their way to the socket.
    [[nodiscard]] bool credit(std::size_t committed, TimePoint now) const {
        return flow_.credit(committed, now);
    }
    /// When the rate allows the next picture to begin.
    [[nodiscard]] TimePoint nextStart() const;
    [[nodiscard]] PaceLevel level() const { return ladder_.level(); }
    /// The level with no step taken.
    [[nodiscard]] PaceLevel best() const { return ladder_.best(); }
    [[nodiscard]] const FrameFlow& flow() const noexcept { return flow_; }
    [[nodiscard]] PaceReport report(TimePoint now) const;

private:
    void stepDown(int steps, const std::string& why, TimePoint now);
    void stepUp(TimePoint now);
    void stepped(TimePoint now);

    FrameFlow flow_;
    PaceLadder ladder_;
    std::string reason_;
    std::optional<TimePoint> startedAt_, steppedAt_;
    std::optional<TimePoint> calmSince_;
    std::optional<TimePoint> raisedAt_;              ///< Of the last step up, until it is proven.
    std::chrono::milliseconds calm_{kBetweenSteps};  ///< Before the next step up.
    std::uint32_t lastSent_ = 0;
    std::uint32_t sentBeforeStep_ = 0;  ///< The newest frame that was made before the last step.
};

}  // namespace volcast::session
