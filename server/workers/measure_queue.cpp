#include "server/workers/measure_queue.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace volcast::workers {

void MeasureQueue::submit(MeasureRequest request) {
    stop(request.view);
    const std::uint64_t view = request.view;
    waiting_[view] = {.request = std::move(request)};
}

bool MeasureQueue::stop(std::uint64_t view) {
    if (inHand_ && inHand_->request.view == view) stopped_ = true;
    const auto found = waiting_.find(view);
    const bool begun = found != waiting_.end() && found->second.begun;
    if (found != waiting_.end()) waiting_.erase(found);
    return begun || (inHand_ && inHand_->request.view == view);
}

const MeasureRequest* MeasureQueue::next(Clock::time_point now) {
    if (waiting_.empty()) return nullptr;
    auto found = std::ranges::find_if(waiting_, [](const auto& one) { return one.second.begun; });
    if (found == waiting_.end()) found = waiting_.begin();
    inHand_ = std::move(found->second);
    waiting_.erase(found);
    inHand_->begun = true;
    since_ = now;
    stopped_ = false;
    return &inHand_->request;
}

std::optional<MeasureRequest> MeasureQueue::goOn(Clock::time_point now) {
    One one = *std::exchange(inHand_, std::nullopt);
    if (stopped_) return std::nullopt;
    one.spent += now - since_;
    if (one.spent >= limit_) return std::move(one.request);
    waiting_[one.request.view] = std::move(one);
    return std::nullopt;
}

MeasureRequest MeasureQueue::finish() {
    return std::exchange(inHand_, std::nullopt)->request;
}

std::vector<MeasureRequest> MeasureQueue::lost(Clock::time_point now) {
    if (inHand_ && !stopped_) {
        // It would take another worker as long.
        if (now - since_ >= partLimit_) inHand_->losses = 1;
        waiting_[inHand_->request.view] = std::move(*inHand_);
    }
    inHand_.reset();
    std::vector<MeasureRequest> givenUp;
    for (auto entry = waiting_.begin(); entry != waiting_.end();) {
        One& one = entry->second;
        const bool ends = one.begun && ++one.losses > 1;
        one.begun = false;
        one.spent = {};
        if (ends) givenUp.push_back(std::move(one.request));
        entry = ends ? waiting_.erase(entry) : std::next(entry);
    }
    return givenUp;
}

std::vector<MeasureRequest> MeasureQueue::takeAll() {
    std::vector<MeasureRequest> all;
    for (auto& [view, one] : waiting_) all.push_back(std::move(one.request));
    waiting_.clear();
    return all;
}

}  // namespace volcast::workers
