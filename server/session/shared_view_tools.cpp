// What a view tells on request: plans, what accuracy costs, what single pixels show.
#include <algorithm>
#include <set>
#include <utility>

#include "renderer/scene/user_controls.h"
#include "renderer/worker/pick_message.h"
#include "server/session/shared_view.h"
#include "server/session/wire.h"

namespace volcast::session {

namespace {

Error notThere() {
    return fail(ErrorCode::kNotFound, "the view is not open", "view");
}

}  // namespace

Result<v1::Plan> SharedView::explain(ViewerId id) const {
    const Lock lock{mutex_};
    const Viewer* viewer = find(id);
    if (viewer == nullptr) return notThere();
    const auto plan = plans_.find(viewer->rendition.get());
    if (plan == plans_.end()) {
        return fail(ErrorCode::kNotFound,
                    "view " + std::to_string(viewer->number()) +
                        " has no picture yet that could be explained",
                    "view");
    }
    v1::Plan message = plan->second;
    message.set_view(viewer->number());
    return message;
}

/// Errors: kNotFound where there is nothing to measure.
Result<void> SharedView::mayMeasure(ViewerId id) const {
    const Viewer* viewer = find(id);
    if (viewer == nullptr) return notThere();
    if (state_.scene && plans_.contains(viewer->rendition.get())) return {};
    return fail(
        ErrorCode::kNotFound,
        "view " + std::to_string(viewer->number()) + " has no picture yet that could be measured",
        "view");
}

Result<void> SharedView::measure(ViewerId id, const v1::MeasureAccuracy& message) {
    const Turn turn{*this};
    if (message.stop()) {
        if (find(id) == nullptr) return notThere();
        if (measures_ == id && accuracy_.running()) stopMeasuring("stopped by the client");
        return boost::system::in_place_value;
    }
    if (auto may = mayMeasure(id); !may) return may;
    const Viewer& viewer = *find(id);
    const std::string name = "view " + std::to_string(viewer.number());
    stopMeasuring("measured anew");
    std::set<std::string> volumes;
    for (const auto& [dataset, summary] : parts_.catalogue.summaries(scene_.datasets())) {
        if (!summary.isMesh) volumes.insert(dataset);
    }
    if (message.estimate()) {
        accuracy_.startEstimates(*state_.scene, viewer.size());
    } else if (message.effects()) {
        accuracy_.startEffects(*state_.scene, viewer.size(), plans_.at(viewer.rendition.get()));
    } else {
        accuracy_.start(*state_.scene, viewer.size(), message.max_pixels(), volumes);
    }
    if (!accuracy_.running()) {
        return fail(ErrorCode::kUnsupported, name + " has no visible layer to measure", "view");
    }
    measures_ = id;
    measureNext();
    return boost::system::in_place_value;
}

Result<void> SharedView::measureDifference(ViewerId id, const v1::MeasureDifference& message) {
    const Turn turn{*this};
    if (message.stop()) {
        if (find(id) == nullptr) return notThere();
        if (measures_ == id && difference_.running()) stopMeasuring("stopped by the client");
        return boost::system::in_place_value;
    }
    if (auto may = mayMeasure(id); !may) return may;
    for (std::size_t i = 0; i < state_.scene->layers.size(); ++i) {
        const scene::Layer& layer = state_.scene->layers[i];
        if (!layer.visible || !scene::runsUserCode(layer)) continue;
        return fail(ErrorCode::kUnsupported,
                    "layer " + layer.id + " is drawn by code, for which there is no reference",
                    "scene.layers[" + std::to_string(i) + "].shader");
    }
    stopMeasuring("measured anew");
    difference_.start(*state_.scene, find(id)->size(), state_.inputSeq, message, Clock::now());
    measures_ = id;
    measureNext();
    return boost::system::in_place_value;
}

v1::ServerMessage SharedView::measureReport(bool ofAccuracy) const {
    const std::uint32_t number = find(measures_)->number();  // Nothing runs for one that left.
    v1::ServerMessage message;
    if (ofAccuracy) {
        *message.mutable_accuracy_report() = accuracy_.report(number);
    } else {
        *message.mutable_difference_report() = difference_.report(number);
    }
    return message;
}

void SharedView::measured(std::uint64_t tag, const Result<accuracy::Measurement>& result) {
    const Turn turn{*this};
    const bool ofAccuracy = accuracy_.measured(tag, result);
    if (!ofAccuracy && !difference_.measured(tag, result, Clock::now())) return;
    tell(*find(measures_), measureReport(ofAccuracy));
    if (accuracy_.running() || difference_.running()) return measureNext();
    measures_ = 0;
}

void SharedView::measureNext() {
    std::uint64_t tag = 0;
    accuracy::Job job = accuracy_.running() ? accuracy_.job(tag) : difference_.job(tag);
    outbox_.put([this, tag, job = std::move(job)]() mutable {
        parts_.render.measure({.view = global_, .tag = tag, .job = std::move(job)});
    });
}

void SharedView::stopMeasuring(const std::string& why) {
    const bool ofAccuracy = accuracy_.running();
    if (!ofAccuracy && !difference_.running()) return;
    if (ofAccuracy) accuracy_.stop();
    if (!ofAccuracy) difference_.stop(why);
    outbox_.put([this] { parts_.render.stopMeasuring(global_); });
    v1::ServerMessage message = measureReport(ofAccuracy);
    if (ofAccuracy) message.mutable_accuracy_report()->set_stopped(why);
    tell(*find(std::exchange(measures_, 0)), std::move(message));
}

Result<void> SharedView::pick(ViewerId id, const v1::Pick& message) {
    const Turn turn{*this};
    if (find(id) == nullptr) return notThere();
    const Viewer& viewer = *find(id);
    const auto newest = viewer.sent().rbegin();
    const auto found = message.input_seq() == 0
                           ? newest
                           : std::find_if(newest, viewer.sent().rend(), [&](const auto& sent) {
                                 return sent.inputSeq == message.input_seq();
                             });
    if (found == viewer.sent().rend()) {
        return fail(ErrorCode::kNotFound,
                    "input_seq " + std::to_string(message.input_seq()) + " is none of the newest " +
                        std::to_string(Viewer::kSentKept) + " pictures of view " +
                        std::to_string(viewer.number()),
                    "input_seq");
    }
    const scene::PictureSize size = found->size;
    const bool xOut = message.x() >= static_cast<std::uint32_t>(size.x);
    if (xOut || message.y() >= static_cast<std::uint32_t>(size.y)) {
        return fail(ErrorCode::kInvalidArgument,
                    "pixel " + std::to_string(message.x()) + ", " + std::to_string(message.y()) +
                        " lies outside of a picture of " + std::to_string(size.x) + " x " +
                        std::to_string(size.y),
                    xOut ? "x" : "y");
    }
    Picking& picking = picks_[id] = {.asked = message, .of = *found};
    picking.asked.set_input_seq(found->inputSeq);
    // The render service keeps one of a view: a newer one of the same viewer may replace it.
    if (picker_ == 0 || picker_ == id) askPick(id);
    return boost::system::in_place_value;
}

/// Viewers take turns.
void SharedView::pickNext() {
    auto next = picks_.upper_bound(picker_);
    if (next == picks_.end()) next = picks_.begin();
    picker_ = 0;
    if (next != picks_.end()) askPick(next->first);
}

void SharedView::askPick(ViewerId viewer) {
    picker_ = viewer;
    const Picking& picking = picks_.at(viewer);
    workers::PickRequest request{.view = global_,
                                 .tag = ++pickTag_,
                                 .job = {.scene = *picking.of.scene,
                                         .size = picking.of.size,
                                         .pixel = {static_cast<int>(picking.asked.x()),
                                                   static_cast<int>(picking.asked.y())}}};
    outbox_.put([&render = parts_.render, request = std::move(request)]() mutable {
        render.pick(std::move(request));
    });
}

void SharedView::picked(std::uint64_t tag, const Result<std::optional<scene::Picked>>& result) {
    const Turn turn{*this};
    if (tag != pickTag_ || picker_ == 0) return;  // A newer one is on its way.
    const v1::Pick asked = picks_.at(picker_).asked;
    picks_.erase(picker_);
    Viewer& viewer = *find(picker_);  // A pick goes with its viewer.
    v1::ServerMessage message;
    if (result) {
        v1::Picked& reply = *message.mutable_picked() = worker::toMessage(*result);
        reply.set_view(viewer.number());
        reply.set_input_seq(asked.input_seq());
        reply.set_x(asked.x());
        reply.set_y(asked.y());
    } else {
        message =
            errorMessage(result.error(), {.view = viewer.number(), .inputSeq = asked.input_seq()});
    }
    tell(viewer, std::move(message));
    pickNext();
}

}  // namespace volcast::session
