#include "server/session/pacing.h"

#include <algorithm>

namespace volcast::session {

namespace {

std::string ms(std::chrono::microseconds value) {
    return std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(value).count()) +
           " ms";
}

/// The further off, the more at once: the way there is a second a step.
int stepsFor(std::chrono::microseconds delay) {
    if (delay > 4 * Pacing::kDownOver) return 3;
    return delay > 2 * Pacing::kDownOver ? 2 : 1;
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
    const auto transfer = flow_.transferDelay();
    // Fewer frames a second of the same bytes would be as long on their way.
    const auto shrinks = ladder_.downShrinks() ? transfer : std::chrono::microseconds{0};
    const auto delay = flow_.queueDelay() + shrinks;
    const bool calm = flow_.queueDelay() < kUpUnder && ack.queued == 0 &&
                      (transfer < kUpTransfer || !ladder_.upGrows());
    if (!calm) calmSince_.reset();
    if (calm && !calmSince_) calmSince_ = now;
    if (steppedAt_ && now - *steppedAt_ < kBetweenSteps) return;
    if (ack.queued > 2) {
        stepDown(1, std::to_string(ack.queued) + " frames wait in the client", now);
    } else if (delay > kDownOver) {
        const char* what = shrinks.count() > 0 ? "transfer and queueing delay " : "queueing delay ";
        stepDown(stepsFor(delay), what + ms(delay) + " is over " + ms(kDownOver), now);
    } else if (calmSince_ && now - *calmSince_ >= calm_) {
        stepUp(now);
    }
}

void Pacing::stepDown(int steps, const std::string& why, TimePoint now) {
    std::string change = ladder_.down();
    if (change.empty()) return;
    if (!raisedAt_) {  // A try that was not right is taken back, and no more.
        for (; steps > 1 && ladder_.downShrinks(); --steps) change += ", " + ladder_.down();
    } else {  // The next try comes later.
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
