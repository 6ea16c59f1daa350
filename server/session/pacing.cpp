#include "server/session/pacing.h"

#include <algorithm>

namespace volcast::session {

namespace {

std::string ms(std::chrono::microseconds value) {
    return std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(value).count()) +
           " ms";
}

}  // namespace

void Pacing::sent(std::uint32_t sequence, std::size_t bytes, TimePoint now) {
    flow_.sent(sequence, bytes, now);
    lastSent_ = sequence;
}

void Pacing::acked(const FrameAck& ack, TimePoint now) {
    if (!flow_.acked(ack, now)) return;
    if (raisedAt_ && now - *raisedAt_ >= kProven) {
        raisedAt_.reset();
        calm_ = kBetweenSteps;
    }
    if (ack.sequence <= sentBeforeStep_) return;
    const auto delay = flow_.queueDelay();
    if (delay >= kUpUnder || ack.queued > 0) calmSince_.reset();
    if (delay < kUpUnder && ack.queued == 0 && !calmSince_) calmSince_ = now;
    if (steppedAt_ && now - *steppedAt_ < kBetweenSteps) return;
    if (ack.queued > 2) {
        stepDown(std::to_string(ack.queued) + " frames wait in the client", now);
    } else if (delay > kDownOver) {
        stepDown("queueing delay " + ms(delay) + " is over " + ms(kDownOver), now);
    } else if (calmSince_ && now - *calmSince_ >= calm_) {
        stepUp(now);
    }
}

void Pacing::stepDown(const std::string& why, TimePoint now) {
    const std::string change = ladder_.down();
    if (change.empty()) return;
    if (raisedAt_) {  // It was not right: the next try comes later.
        calm_ = std::min(calm_ * 2, kLongestCalm);
        raisedAt_.reset();
    }
    reason_ = change + ": " + why;
    stepped(now);
}

void Pacing::stepUp(TimePoint now) {
    const std::string change = ladder_.up();
    if (change.empty()) return;
    reason_ = change + ": queueing delay under " + ms(kUpUnder) + " for " + ms(calm_);
    raisedAt_ = now;
    stepped(now);
}

void Pacing::stepped(TimePoint now) {
    steppedAt_ = now;
    calmSince_.reset();
    sentBeforeStep_ = lastSent_;
    flow_.forgetDelay();
}

TimePoint Pacing::nextStart() const {
    const double framesPerS = ladder_.level().framesPerS;
    if (framesPerS == 0.0 || !startedAt_) return TimePoint{};
    const std::chrono::duration<double> apart{1.0 / framesPerS};
    return *startedAt_ + std::chrono::duration_cast<Clock::duration>(apart);
}

PaceReport Pacing::report(TimePoint now) const {
    return {.level = level(),
            .window = flow_.window(now),
            .underWay = flow_.underWay(),
            .roundTrip = flow_.roundTrip(),
            .shortestRoundTrip = flow_.shortestRoundTrip(),
            .queueDelay = flow_.queueDelay(),
            .bytesPerS = flow_.bytesPerS(),
            .reason = reason_};
}

}  // namespace volcast::session
