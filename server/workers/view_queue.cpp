#include "server/workers/view_queue.h"

#include <algorithm>
#include <utility>

namespace volcast::workers {

namespace {

constexpr int kLossesToGiveUp = 2;

bool samePicture(const RenderRequest& a, const RenderRequest& b) {
    return a.size == b.size && a.hurried == b.hurried && a.scene == b.scene;
}

/// Camera, size and hurry aside.
bool sameScene(const RenderRequest& a, const RenderRequest& b) {
    scene::Scene scene = b.scene;
    scene.camera = a.scene.camera;
    return a.scene == scene;
}

}  // namespace

void ViewQueue::wait(std::uint64_t id, View& view, TimedRequest request) {
    if (!view.waiting) turns_.push_back(id);
    view.waiting = std::move(request);
}

bool ViewQueue::holds(const RenderRequest& request) const {
    const auto view = views_.find(request.view);
    return view != views_.end() && std::ranges::any_of(view->second.held, [&](const Held& held) {
               return held.however ? sameScene(held.request, request)
                                   : samePicture(held.request, request);
           });
}

void ViewQueue::hold(View& view, const RenderRequest& request) {
    const bool drawnOtherwise = view.lastGood && sameScene(*view.lastGood, request);
    if (view.held.size() == kMostHeld) view.held.pop_front();
    view.held.push_back({.request = request, .however = !drawnOtherwise});
}

std::optional<ViewQueue::Pause> ViewQueue::pause(const RenderRequest& request,
                                                 Clock::time_point now) const {
    const auto found = views_.find(request.view);
    if (found == views_.end()) return std::nullopt;
    const View& view = found->second;
    const std::chrono::seconds left = view.trust.pause(now);
    if (left.count() == 0) return std::nullopt;
    const bool cameraMatters = !view.held.empty() && !view.held.back().however;
    const bool good = view.lastGood && (cameraMatters ? view.lastGood->scene == request.scene
                                                      : sameScene(*view.lastGood, request));
    if (good) return std::nullopt;
    return Pause{.left = left, .scenes = view.trust.scenes()};
}

void ViewQueue::forgive() {
    for (auto& [id, view] : views_) view.held.clear();
}

void ViewQueue::submit(RenderRequest request, Clock::time_point now) {
    const std::uint64_t id = request.view;
    wait(id, views_[id], {.request = std::move(request), .submitted = now});
}

void ViewQueue::drop(std::uint64_t view) {
    views_.erase(view);
    std::erase(turns_, view);
}

std::optional<TimedRequest> ViewQueue::next() {
    if (turns_.empty()) return std::nullopt;
    auto turn = std::ranges::find_if(
        turns_, [this](std::uint64_t id) { return !views_.at(id).waiting->request.background; });
    if (turn == turns_.end()) turn = turns_.begin();
    View& view = views_.at(*turn);
    turns_.erase(turn);
    return std::exchange(view.waiting, std::nullopt);
}

void ViewQueue::succeeded(RenderRequest drawn) {
    const auto found = views_.find(drawn.view);
    if (found == views_.end()) return;
    found->second.lossesInARow = 0;
    if (!drawn.background) lastDrawn_ = drawn.view;
    found->second.lastGood = std::move(drawn);
}

const RenderRequest* ViewQueue::lastDrawn() const {
    const auto view = views_.find(lastDrawn_);
    return view != views_.end() && view->second.lastGood ? &*view->second.lastGood : nullptr;
}

void ViewQueue::drawnInPart(TimedRequest request) {
    const std::uint64_t id = request.request.view;
    const auto found = views_.find(id);
    if (found == views_.end() || found->second.waiting) return;
    wait(id, found->second, std::move(request));
}

void ViewQueue::refused(std::uint64_t view) {
    const auto found = views_.find(view);
    if (found != views_.end()) found->second.lossesInARow = 0;
}

ViewQueue::Loss ViewQueue::lost(std::optional<RenderRequest> inFlight, Clock::time_point now) {
    Loss loss;
    const std::uint64_t suspect = inFlight ? inFlight->view : 0;
    for (auto& [id, view] : views_) {
        loss.views.push_back(id);
        const bool drawAgain = !view.waiting && view.lastGood && !(inFlight && id == suspect);
        if (drawAgain) wait(id, view, {.request = *view.lastGood, .submitted = now});
    }
    const auto found = inFlight ? views_.find(suspect) : views_.end();
    if (found == views_.end()) return loss;

    View& view = found->second;
    loss.proven = view.lastGood && samePicture(*view.lastGood, *inFlight);
    std::erase(turns_, suspect);
    if (++view.lossesInARow >= kLossesToGiveUp) {
        view.lossesInARow = kLossesToGiveUp - 1;
        if (!loss.proven) {
            hold(view, *inFlight);
            view.trust.tookDownWorkers(now);
        }
        loss.givenUp.push_back(*std::move(inFlight));
        const bool sameWaits = view.waiting && (loss.proven || holds(view.waiting->request));
        if (sameWaits) loss.givenUp.push_back(std::exchange(view.waiting, std::nullopt)->request);
        if (view.waiting) turns_.push_back(suspect);
        return loss;
    }
    if (!view.waiting) view.waiting = {.request = *std::move(inFlight), .submitted = now};
    turns_.push_back(suspect);
    return loss;
}

std::vector<RenderRequest> ViewQueue::takeAll() {
    std::vector<RenderRequest> taken;
    while (auto waiting = next()) taken.push_back(std::move(waiting->request));
    return taken;
}

}  // namespace volcast::workers
