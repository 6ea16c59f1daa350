// What a client asks of views and of data.
#include <algorithm>
#include <utility>

#include <spdlog/spdlog.h>

#include "server/session/on_strand.h"
#include "server/session/session.h"
#include "server/session/shader_description.h"
#include "server/session/thumbnails.h"

namespace volcast::session {

void Session::openDataset(const v1::OpenDataset& message) {
    const auto info = shared_.catalogue.open(message.dataset());
    if (!info) return send(errorMessage(info.error(), {.dataset = message.dataset()}));
    v1::ServerMessage reply;
    *reply.mutable_dataset_info() = *info;
    send(reply);
}

void Session::drawDatasetThumbnail(const v1::DrawDatasetThumbnail& message) {
    const std::string& id = message.dataset();
    if (!shared_.catalogue.standing(id).loaded) {
        return send(errorMessage(v1::ERROR_CODE_NOT_FOUND,
                                 "dataset \"" + id + "\" is not loaded; open_dataset loads it",
                                 {.dataset = id}, "dataset"));
    }
    if (shared_.thumbnails != nullptr) shared_.thumbnails->draw(id);
}

void Session::openView(const v1::OpenView& message, TimePoint now) {
    const std::uint32_t number = message.view();
    const ErrorContext about{
        .view = number, .inputSeq = message.input_seq(), .dataset = message.dataset()};
    if (number == 0) {
        return send(errorMessage(v1::ERROR_CODE_INVALID_ARGUMENT, "view numbers begin at 1", about,
                                 "view"));
    }
    if (seats_.contains(number)) {
        return send(errorMessage(v1::ERROR_CODE_INVALID_ARGUMENT,
                                 "view " + std::to_string(number) + " is open already", about,
                                 "view"));
    }
    if (seats_.size() >= shared_.limits.maxViews) {
        return send(errorMessage(v1::ERROR_CODE_LIMIT_EXCEEDED,
                                 "this connection has " + std::to_string(seats_.size()) +
                                     " views, the most that it may have",
                                 about, "view"));
    }
    const auto size = sizeFrom(message.viewport(), shared_.limits.maxViewPixels);
    if (!size) return send(errorMessage(size.error(), about));
    if (!message.link().empty()) return joinView(message, *size, now);
    auto view = shared_.views.open(message);
    if (!view) return send(errorMessage(view.error(), about));
    const auto viewer =
        (*view)->join(viewerDesc(number, *size),
                      {.person = who_.person, .name = who_.name, .role = v1::ROLE_CONTROL}, now);
    if (!viewer) return send(errorMessage(viewer.error(), about));
    takeSeat(number, std::move(*view), *viewer);
}

Viewer::Desc Session::viewerDesc(std::uint32_t number, scene::PictureSize size) {
    return {
        .number = number, .codecs = codecs_, .size = size, .wake = onStrand([](const Session&) {})};
}

void Session::takeSeat(std::uint32_t number, std::shared_ptr<SharedView> view, ViewerId viewer) {
    spdlog::info("event=view_opened connection={} number={} view={} person={}", number_, number,
                 view->id(), who_.person);
    shared_.views.people().opened(who_.person, number, view->id());
    seats_[number] = {.view = std::move(view), .viewer = viewer};
}

void Session::updateView(const v1::Update& message, TimePoint now) {
    const Seat* seat = findOrRefuse(message.view(), message.input_seq());
    if (seat == nullptr) return;
    const auto updated = seat->view->update(seat->viewer, message, now);
    if (updated) return;
    send(errorMessage(updated.error(), {.view = message.view(), .inputSeq = message.input_seq()}));
}

void Session::closeView(std::uint32_t number) {
    const Seat* seat = findOrRefuse(number, 0);
    if (seat == nullptr) return;
    spdlog::info("event=view_closed connection={} view={} frames={}", number_, seat->view->id(),
                 seat->view->framesSent(seat->viewer));
    seat->view->leave(seat->viewer);
    shared_.views.left(seat->view);
    shared_.views.people().closed(who_.person, number);
    seats_.erase(number);
}

void Session::ack(const v1::Ack& message, TimePoint now) {
    const auto found = seats_.find(message.view());
    if (found == seats_.end()) return;  // Of a view that was just closed.
    const Seat& seat = found->second;
    const std::chrono::duration<double, std::milli> roundTrip =
        seat.view->acked(seat.viewer,
                         {.sequence = message.sequence(),
                          .hold = std::chrono::microseconds{message.hold_us()},
                          .queued = message.queue(),
                          .keyframe = message.keyframe(),
                          .path = path_.best().value_or(std::chrono::microseconds{0})},
                         now);
    shared_.metrics.frameAcked(roundTrip.count());
}

void Session::explain(const v1::Explain& message) {
    const Seat* seat = findOrRefuse(message.view(), 0);
    if (seat == nullptr) return;
    auto plan = seat->view->explain(seat->viewer);
    if (!plan) return send(errorMessage(plan.error(), {.view = message.view()}));
    v1::ServerMessage reply;
    *reply.mutable_plan() = std::move(*plan);
    send(reply);
}

void Session::measureAccuracy(const v1::MeasureAccuracy& message) {
    const Seat* seat = findOrRefuse(message.view(), 0);
    if (seat == nullptr) return;
    const auto begun = seat->view->measure(seat->viewer, message);
    if (!begun) send(errorMessage(begun.error(), {.view = message.view()}));
}

void Session::measureDifference(const v1::MeasureDifference& message) {
    const Seat* seat = findOrRefuse(message.view(), 0);
    if (seat == nullptr) return;
    const auto begun = seat->view->measureDifference(seat->viewer, message);
    if (!begun) send(errorMessage(begun.error(), {.view = message.view()}));
}

void Session::drawThumbnail(const v1::DrawThumbnail& message) {
    const Seat* seat = findOrRefuse(message.view(), 0);
    if (seat == nullptr) return;
    const auto asked = seat->view->drawThumbnail(seat->viewer, message);
    if (!asked) send(errorMessage(asked.error(), {.view = message.view()}));
}

void Session::pick(const v1::Pick& message) {
    const Seat* seat = findOrRefuse(message.view(), 0);
    if (seat == nullptr) return;
    const auto asked = seat->view->pick(seat->viewer, message);
    if (asked) return;
    send(errorMessage(asked.error(), {.view = message.view(), .inputSeq = message.input_seq()}));
}

void Session::describeShader(const v1::DescribeShader& message) {
    v1::ServerMessage reply;
    *reply.mutable_shader_description() =
        shaderDescription(message, shared_.catalogue.summaries({message.dataset()}));
    send(reply);
}

void Session::datasetChanged(const v1::DatasetInfo& info) {
    if (!greeted_ || closing_) return;
    // A client that reads slowly gets the newest state of a dataset, not its history.
    const auto older = std::ranges::find_if(waiting_, [&info](const v1::ServerMessage& message) {
        return message.has_dataset_info() && message.dataset_info().id() == info.id();
    });
    if (older != waiting_.end()) waiting_.erase(older);
    v1::ServerMessage message;
    *message.mutable_dataset_info() = info;
    send(message);
    if (info.state() != v1::DATASET_STATE_READY && info.state() != v1::DATASET_STATE_FAILED) return;
    for (const auto& [number, seat] : seats_) seat.view->datasetChanged(seat.viewer, info.id());
}

const Session::Seat* Session::findOrRefuse(std::uint32_t number, std::uint64_t inputSeq) {
    const auto found = seats_.find(number);
    if (found != seats_.end()) return &found->second;
    send(errorMessage(v1::ERROR_CODE_NOT_FOUND, "view " + std::to_string(number) + " is not open",
                      {.view = number, .inputSeq = inputSeq}, "view"));
    return nullptr;
}

}  // namespace volcast::session
