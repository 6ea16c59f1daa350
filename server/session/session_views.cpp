// What happens to a session's views: news of data and pictures, and the next step of each.
#include <algorithm>
#include <utility>

#include <spdlog/spdlog.h>

#include "renderer/base/printable.h"
#include "renderer/worker/scene_message.h"
#include "server/session/explain.h"
#include "server/session/on_strand.h"
#include "server/session/session.h"

namespace volcast::session {

void Session::apply(View& view, SceneChange change) {
    if (change == SceneChange::kNone) return;
    if (view.scene.waiting()) {
        setState(view, v1::VIEW_STATE_WAITING, "its data is being imported");
    } else if (view.state == v1::VIEW_STATE_WAITING) {
        setState(view, v1::VIEW_STATE_ACTIVE, "");
    }
    if (change != SceneChange::kDraw || !view.scene.scene()) return;
    if (!view.opened) {
        view.opened = true;
        v1::ServerMessage message;
        message.mutable_view_opened()->set_view(view.number);
        *message.mutable_view_opened()->mutable_scene() = worker::toMessage(*view.scene.scene());
        send(message);
    }
    view.frames.want({.scene = *view.scene.scene(),
                      .size = view.scene.size(),
                      .inputSeq = view.scene.shownSeq(),
                      .dataVersion = view.scene.dataVersion(),
                      .inputAt = view.inputAt});
    advance(view, Clock::now());
}

void Session::setState(View& view, v1::ViewState state, const std::string& text) {
    if (view.state == state) return;
    view.state = state;
    spdlog::info(R"(event=view_state connection={} view={} state={} message="{}")", number_,
                 view.number, v1::ViewState_Name(state), base::printable(text, 1000));
    send(statusMessage(view.number, state, text));
}

void Session::refuse(View& view, const Error& error, v1::ErrorCode code) {
    send(errorMessage(code, error.message, {.view = view.number, .inputSeq = view.scene.shownSeq()},
                      error.field));
    setState(view, v1::VIEW_STATE_FAILED, error.message);
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
    for (const auto& [number, view] : views_) {
        const auto change = view->scene.datasetChanged(info.id());
        if (change) {
            if (*change == SceneChange::kDraw) view->inputAt = Clock::now();
            apply(*view, *change);
        } else {
            const bool imported = info.state() == v1::DATASET_STATE_READY;
            refuse(*view, change.error(),
                   imported ? wireCode(change.error().code) : v1::ERROR_CODE_IMPORT_FAILED);
        }
    }
}

void Session::rendered(const workers::RenderedFrame& frame) {
    View* view = findGlobal(frame.view);
    const auto now = Clock::now();
    if (view == nullptr || !view->frames.rendered(frame)) return;
    view->scene.drawn(view->frames.shownSeq());
    view->plan = planMessage(frame, view->number, view->frames.shownSeq());
    const bool waiting = view->scene.waiting();
    if (view->state == v1::VIEW_STATE_RECOVERING && waiting) {
        setState(*view, v1::VIEW_STATE_WAITING, "its data is being imported");
    } else if (!waiting) {
        setState(*view, v1::VIEW_STATE_ACTIVE, "");
    }
    advance(*view, now);
}

void Session::failed(std::uint64_t global, std::uint64_t tag, const Error& error) {
    View* view = findGlobal(global);
    if (view == nullptr || !view->frames.failed(tag)) return;
    Error told = error;
    if (told.field.starts_with("layers[")) told.field = "scene." + told.field;
    // Not where the worker alone is to blame: the scene is drawn once there is one again.
    const bool sceneIsToBlame = !error.field.empty() || error.code == ErrorCode::kOutOfGpuMemory;
    const auto failedSeq = sceneIsToBlame ? view->scene.revert() : std::nullopt;
    if (!failedSeq) {
        refuse(*view, told, wireCode(error.code));
        return advance(*view, Clock::now());
    }
    told.message = "the scene of input " + std::to_string(*failedSeq) +
                   " is refused, the last one that was drawn stays: " + told.message;
    send(errorMessage(told, {.view = view->number, .inputSeq = view->scene.shownSeq()}));
    setState(*view, v1::VIEW_STATE_ACTIVE, "");
    apply(*view, SceneChange::kDraw);
}

void Session::recovering(std::uint64_t global) {
    View* view = findGlobal(global);
    if (view == nullptr || !view->opened) return;
    setState(*view, v1::VIEW_STATE_RECOVERING, "the renderer was lost and is being replaced");
}

void Session::encoded(std::uint64_t global, EncodedPicture picture) {
    View* view = findGlobal(global);
    if (view == nullptr) return;
    if (const auto error = view->frames.encoded(std::move(picture))) {
        refuse(*view, *error, v1::ERROR_CODE_RENDER_FAILED);
    }
    advance(*view, Clock::now());
}

void Session::advance(View& view, TimePoint now) {
    std::uint64_t tag = 0;
    if (auto state = view.frames.takeDraw(now, tag)) {
        remember(view, *state);
        shared_.render.submit({.view = view.global,
                               .tag = tag,
                               .scene = std::move(state->scene),
                               .size = state->size});
    }
    if (auto task = view.frames.takeEncode(now)) startEncode(view, std::move(*task));
}

void Session::startEncode(View& view, EncodeTask task) {
    auto bring = onStrand([global = view.global](Session& self, EncodedPicture picture) {
        self.encoded(global, std::move(picture));
    });
    shared_.encoders.run(
        [bring = std::move(bring), task = std::move(task)] { bring(encode(task)); });
}

Session::View* Session::findGlobal(std::uint64_t global) {
    for (const auto& [number, view] : views_) {
        if (view->global == global) return view.get();
    }
    return nullptr;
}

}  // namespace volcast::session
