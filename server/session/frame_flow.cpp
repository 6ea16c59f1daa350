#include "server/session/frame_flow.h"

#include <algorithm>

namespace volcast::session {

namespace {

using std::chrono::microseconds;

}  // namespace

void FrameFlow::sent(std::uint32_t sequence, TimePoint now) {
    underWay_.push_back({sequence, now});
}

bool FrameFlow::acked(const FrameAck& ack, TimePoint now) {
    std::optional<TimePoint> sentAt;
    while (!underWay_.empty() && underWay_.front().sequence <= ack.sequence) {
        if (underWay_.front().sequence == ack.sequence) sentAt = underWay_.front().at;
        underWay_.pop_front();
    }
    if (!sentAt) return false;
    silent_ = false;
    const auto elapsed = std::chrono::duration_cast<microseconds>(now - *sentAt);
    measure(std::max(elapsed - ack.hold, microseconds{0}), now);
    const bool late = elapsed - ack.hold > minimum() + kSlowDelay;
    if (ack.queued >= 2 || ack.hold > kSlowDelay || late) slowUntil_ = now + kCalm;
    return true;
}

void FrameFlow::measure(microseconds roundTrip, TimePoint now) {
    roundTrip_ = roundTrip_.count() == 0 ? roundTrip : (roundTrip_ * 7 + roundTrip) / 8;
    if (now - windowStart_ > kMinimumWindow) {
        lastMinimum_ = thisMinimum_;
        thisMinimum_.reset();
        windowStart_ = now;
    }
    thisMinimum_ = std::min(thisMinimum_.value_or(roundTrip), roundTrip);
}

microseconds FrameFlow::minimum() const {
    const auto recent = thisMinimum_.value_or(microseconds{0});
    return std::min(recent, lastMinimum_.value_or(recent));
}

void FrameFlow::forgiveSilence(TimePoint now) {
    const auto due = probeAt();
    if (!due || now < *due) return;
    underWay_.clear();
    silent_ = true;
}

std::size_t FrameFlow::window(TimePoint now) const {
    return silent_ || now < slowUntil_ ? 1 : 2;
}

std::optional<TimePoint> FrameFlow::probeAt() const {
    if (underWay_.empty()) return std::nullopt;
    return underWay_.back().at + kProbeAfter;
}

}  // namespace volcast::session
