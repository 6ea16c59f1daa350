#include "server/session/frame_flow.h"

#include <algorithm>
#include <cmath>

namespace volcast::session {

namespace {

using std::chrono::microseconds;

double seconds(Clock::duration duration) {
    return std::chrono::duration<double>(duration).count();
}

}  // namespace

void FrameFlow::sent(std::uint32_t sequence, std::size_t bytes, TimePoint now) {
    if (underWay_.empty()) heardAt_ = std::max(heardAt_, now);
    underWay_.push_back(
        {.sequence = sequence,
         .bytes = bytes,
         .at = now,
         .since = underWay_.empty() ? now : std::max(shownAt_, underWay_.front().at),
         .bytesBefore = bytesShown_,
         .framesBefore = framesShown_});
    bytesUnderWay_ += bytes;
    lastBytes_ = bytes;
    lastSequence_ = sequence;
}

bool FrameFlow::acked(const FrameAck& ack, TimePoint now) {
    std::optional<Sent> sent;
    while (!underWay_.empty() && underWay_.front().sequence <= ack.sequence) {
        const Sent& front = underWay_.front();
        if (front.sequence == ack.sequence) sent = front;
        bytesUnderWay_ -= front.bytes;
        bytesShown_ += front.bytes;
        ++framesShown_;
        underWay_.pop_front();
    }
    // Of a frame that was given up it is a sign of life all the same.
    const bool alive = sent || (silence_ != Silence::kNone && ack.sequence <= lastSequence_);
    if (alive) {
        silence_ = Silence::kNone;
        heardAt_ = now;
    }
    if (!sent) return false;
    path_ = ack.path;
    const auto elapsed = std::chrono::duration_cast<microseconds>(now - sent->at);
    shownAt_ = now - std::min(ack.hold, elapsed);
    measure(std::max(elapsed - ack.hold, microseconds{0}), now);
    if (const double took = seconds(shownAt_ - sent->since); took > 0.0) {
        bytesPerS_.see(static_cast<double>(bytesShown_ - sent->bytesBefore) / took, now);
        framesPerS_.see(static_cast<double>(framesShown_ - sent->framesBefore) / took, now);
    }
    if (ack.queued >= 2 || ack.hold > kSlowDelay || queueDelay_ > kSlowDelay) {
        slowUntil_ = now + kCalm;
    }
    return true;
}

void FrameFlow::measure(microseconds roundTrip, TimePoint now) {
    shortest_.see(roundTrip, now);
    const microseconds delay = roundTrip - shortestRoundTrip();
    roundTrip_ = roundTrip_.count() == 0 ? roundTrip : (roundTrip_ * 7 + roundTrip) / 8;
    // A quarter: one late frame in a calm row is not yet a queue.
    queueDelay_ = measured_ ? (queueDelay_ * 3 + delay) / 4 : delay;
    measured_ = true;
}

microseconds FrameFlow::shortestRoundTrip() const {
    return shortest_.best().value_or(microseconds{0});
}

microseconds FrameFlow::transferDelay() const {
    if (path_.count() == 0) return microseconds{0};
    return std::max(shortestRoundTrip() - path_, microseconds{0});
}

std::optional<std::size_t> FrameFlow::byteCap() const {
    const double rate = bytesPerS();
    if (rate == 0.0) return std::nullopt;
    return static_cast<std::size_t>(2.0 * rate * seconds(shortestRoundTrip()));
}

std::optional<TimePoint> FrameFlow::probeAt() const {
    if (underWay_.empty() || stopped()) return std::nullopt;
    const double rate = bytesPerS();
    const std::chrono::duration<double> transfer{
        rate > 0.0 ? static_cast<double>(bytesUnderWay_) / rate : 0.0};
    const auto bounded = std::chrono::duration_cast<Clock::duration>(
        std::min<std::chrono::duration<double>>(transfer, std::chrono::minutes{1}));
    return std::max(heardAt_, underWay_.back().at) + kProbeAfter + bounded;
}

void FrameFlow::forgiveSilence(TimePoint now) {
    const auto due = probeAt();
    if (!due || now < *due) return;
    underWay_.clear();
    bytesUnderWay_ = 0;
    silence_ = silence_ == Silence::kNone ? Silence::kProbing : Silence::kStopped;
}

std::size_t FrameFlow::window(TimePoint now) const {
    if (stopped()) return 0;
    if (silence_ == Silence::kProbing || now < slowUntil_) return 1;
    // One more than fits is what makes more fit be seen; where a queue is, no more fit.
    const double more = queueDelay_ > kShortQueue ? 0.0 : 1.0;
    const double pipe = std::ceil(framesPerS() * seconds(shortestRoundTrip())) + more;
    return static_cast<std::size_t>(std::clamp(pipe, 2.0, static_cast<double>(kMostFrames)));
}

bool FrameFlow::credit(std::size_t committed, TimePoint now) const {
    const std::size_t ahead = underWay_.size() + committed;
    if (ahead >= window(now)) return false;
    const auto cap = byteCap();
    return ahead == 0 || !cap || bytesUnderWay_ + committed * lastBytes_ < *cap;
}

}  // namespace volcast::session
