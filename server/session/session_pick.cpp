// What a session tells of single pixels of its views.
#include <algorithm>

#include "renderer/worker/pick_message.h"
#include "server/session/session.h"

namespace volcast::session {

void Session::pick(const v1::Pick& message) {
    View* view = findOrRefuse(message.view(), 0);
    if (view == nullptr) return;
    const ErrorContext about{.view = view->number, .inputSeq = message.input_seq()};
    const auto& drawn = view->drawn;
    const auto found = message.input_seq() == 0
                           ? drawn.end() - (drawn.empty() ? 0 : 1)
                           : std::ranges::find(drawn, message.input_seq(), &Drawn::inputSeq);
    if (found == drawn.end()) {
        return send(errorMessage(v1::ERROR_CODE_NOT_FOUND,
                                 "input_seq " + std::to_string(message.input_seq()) +
                                     " is none of the newest " + std::to_string(kDrawnKept) +
                                     " pictures of view " + std::to_string(view->number),
                                 about, "input_seq"));
    }
    const scene::PictureSize size = found->size;
    if (message.x() >= static_cast<std::uint32_t>(size.x) ||
        message.y() >= static_cast<std::uint32_t>(size.y)) {
        return send(
            errorMessage(v1::ERROR_CODE_INVALID_ARGUMENT,
                         "pixel " + std::to_string(message.x()) + ", " +
                             std::to_string(message.y()) + " lies outside of a picture of " +
                             std::to_string(size.x) + " x " + std::to_string(size.y),
                         about, message.x() >= static_cast<std::uint32_t>(size.x) ? "x" : "y"));
    }
    view->picking = message;
    view->picking.set_input_seq(found->inputSeq);
    shared_.render.pick(
        {.view = view->global,
         .tag = ++view->pickTag,
         .job = {.scene = found->scene,
                 .size = size,
                 .pixel = {static_cast<int>(message.x()), static_cast<int>(message.y())}}});
}

void Session::picked(std::uint64_t global, std::uint64_t tag,
                     const Result<std::optional<scene::Picked>>& result) {
    const View* view = findGlobal(global);
    if (view == nullptr || tag != view->pickTag) return;  // A newer one is on its way.
    const v1::Pick& asked = view->picking;
    if (!result) {
        return send(
            errorMessage(result.error(), {.view = view->number, .inputSeq = asked.input_seq()}));
    }
    v1::ServerMessage message;
    v1::Picked& reply = *message.mutable_picked() = worker::toMessage(*result);
    reply.set_view(view->number);
    reply.set_input_seq(asked.input_seq());
    reply.set_x(asked.x());
    reply.set_y(asked.y());
    send(message);
}

void Session::remember(View& view, const DrawState& state) {
    if (view.drawn.size() >= kDrawnKept) view.drawn.pop_front();
    view.drawn.push_back({.inputSeq = state.inputSeq, .scene = state.scene, .size = state.size});
}

}  // namespace volcast::session
