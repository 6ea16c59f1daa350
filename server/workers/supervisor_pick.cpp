// What is under pixels: asked of the worker between pictures, the newest pixel of each view.
#include <utility>

#include "renderer/worker/pick_message.h"
#include "server/workers/supervisor.h"

namespace volcast::workers {

bool Supervisor::dispatchPick() {
    if (picks_.empty()) return false;
    PickRequest request = std::move(picks_.begin()->second);
    picks_.erase(picks_.begin());
    const std::uint64_t number = nextNumber_++;
    auto asked = main_->pick(number, request.job, settings_.frameDeadline);
    if (!asked) {
        tell(request, asked.error());
        return false;
    }
    pickInHand_ = {.request = std::move(request), .number = number};
    static_cast<void>(main_->flush());
    return true;
}

void Supervisor::finishPick(std::uint64_t number,
                            const Result<std::optional<scene::Picked>>& result) {
    if (!pickInHand_ || number != pickInHand_->number) {
        return lose(main_, "picked what nobody asked for");
    }
    const PickRequest request = std::exchange(pickInHand_, std::nullopt)->request;
    justPicked_ = true;
    tell(request, result);
}

void Supervisor::tell(const PickRequest& request,
                      const Result<std::optional<scene::Picked>>& result) const {
    if (events_.picked) events_.picked(request.view, request.tag, result);
}

}  // namespace volcast::workers
