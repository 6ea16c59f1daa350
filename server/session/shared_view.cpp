// A view's scene and its viewers: what is done to it, and what they are told.
#include "server/session/shared_view.h"

#include <utility>

#include <spdlog/spdlog.h>

#include "renderer/base/printable.h"
#include "renderer/worker/scene_message.h"
#include "server/session/wire.h"

namespace volcast::session {

namespace {

constexpr const char* kImporting = "its data is being imported";

}  // namespace

std::shared_ptr<SharedView> SharedView::create(const ViewParts& parts) {
    std::shared_ptr<SharedView> made{new SharedView{parts}};
    made->route();
    return made;
}

SharedView::SharedView(const ViewParts& parts)
    : parts_{parts},
      id_{std::to_string(parts.router.reserve())},
      global_{std::stoull(id_)},
      scene_{parts.catalogue} {}

/// Brings what the render service tells to act(view, arguments...), if the view still exists.
void SharedView::route() {
    const auto bring = [weak = weak_from_this()](auto act) {
        return [weak, act](auto&&... values) {
            if (const auto self = weak.lock()) (self.get()->*act)(values...);
        };
    };
    parts_.router.add(global_, {.rendered = bring(&SharedView::rendered),
                                .failed = bring(&SharedView::failed),
                                .measured = bring(&SharedView::measured),
                                .picked = bring(&SharedView::picked),
                                .recovering = bring(&SharedView::recovering)});
}

Result<void> SharedView::open(const v1::OpenView& message) {
    const Turn turn{*this};
    const auto change = scene_.open(message);
    if (!change) return change.error();
    apply(*change, Clock::now());
    return boost::system::in_place_value;
}

void SharedView::end() {
    const Turn turn{*this};
    if (std::exchange(ended_, true)) return;
    parts_.router.remove(global_);
    if (viewers_.empty()) return;  // Was dropped when the last one left.
    outbox_.put([&render = parts_.render, view = global_] { render.dropView(view); });
}

bool SharedView::empty() const {
    const Lock lock{mutex_};
    return viewers_.empty();
}

ViewerId SharedView::join(Viewer::Desc desc, TimePoint now) {
    const Turn turn{*this};
    const bool first = viewers_.empty();
    const ViewerId id = ++lastViewer_;
    Viewer& viewer = *(viewers_[id] = std::make_unique<Viewer>(std::move(desc)));
    viewer.input(now);
    place(viewer);
    if (first) refresh(now);
    if (scene_.waiting()) setState(viewer, v1::VIEW_STATE_WAITING, kImporting);
    if (state_.scene) tellOpened(viewer);
    advance(viewer, now);
    return id;
}

void SharedView::leave(ViewerId id) {
    const Turn turn{*this};
    if (measures_ == id) stopMeasuring("its viewer left");
    const bool first = viewers_.begin()->first == id;
    picks_.erase(id);
    if (picker_ == id) pickNext();
    viewers_.erase(id);
    dropUnused();
    if (viewers_.empty()) {
        drawing_.reset();
        outbox_.put([&render = parts_.render, view = global_] { render.dropView(view); });
    } else if (first) {
        refresh(Clock::now());  // News that it alone would have brought.
    }
}

Result<void> SharedView::update(ViewerId id, const v1::Update& message, TimePoint now) {
    const Turn turn{*this};
    Viewer& viewer = at(id);
    scene::PictureSize size = viewer.size();
    if (message.has_viewport()) {
        const auto wanted = sizeFrom(message.viewport(), parts_.maxPixels);
        if (!wanted) return wanted.error();
        size = *wanted;
    }
    const bool changesScene = message.has_scene() || message.has_camera();
    SceneChange change = SceneChange::kNone;
    if (changesScene) {
        const auto accepted = scene_.update(message);
        if (!accepted) return accepted.error();
        change = *accepted;
        if (change == SceneChange::kNone) return boost::system::in_place_value;
        for (const auto& [other, one] : viewers_) one->input(now);
    } else if (!scene_.advance(message.input_seq())) {
        return boost::system::in_place_value;
    }
    state_.inputAt = now;
    state_.inputSeq = scene_.shownSeq();
    if (changesScene || measures_ == id) stopMeasuring("the view changed");
    viewer.input(now);
    viewer.resize(size);
    place(viewer);
    viewer.rendition->want();
    apply(change, now);
    advance(viewer, now);
    return boost::system::in_place_value;
}

void SharedView::acked(ViewerId viewer, const FrameAck& ack, TimePoint now) {
    const Turn turn{*this};
    at(viewer).acked(ack, now);
    advance(at(viewer), now);
}

void SharedView::setPins(ViewerId viewer, const PacePins& pins, v1::Codec codec, TimePoint now) {
    const Turn turn{*this};
    at(viewer).setPins(pins, codec);
    advance(at(viewer), now);
}

void SharedView::setCodecs(ViewerId viewer, const ClientCodecs& codecs) {
    const Turn turn{*this};
    at(viewer).setCodecs(codecs);
}

std::optional<v1::ServerMessage> SharedView::takeMail(ViewerId viewer) {
    const Lock lock{mutex_};
    return at(viewer).mail.take();
}

void SharedView::apply(SceneChange change, TimePoint now) {
    if (change == SceneChange::kNone) return;
    for (const auto& [id, viewer] : viewers_) {
        if (scene_.waiting()) {
            setState(*viewer, v1::VIEW_STATE_WAITING, kImporting);
        } else if (viewer->state == v1::VIEW_STATE_WAITING) {
            setState(*viewer, v1::VIEW_STATE_ACTIVE, "");
        }
    }
    if (change != SceneChange::kDraw || !scene_.scene()) return;
    state_.scene = std::make_shared<const scene::Scene>(*scene_.scene());
    state_.inputSeq = scene_.shownSeq();
    state_.dataVersion = scene_.dataVersion();
    for (const auto& [id, viewer] : viewers_) {
        if (!viewer->opened) tellOpened(*viewer);
        wake(*viewer);
    }
    for (const auto& [id, viewer] : viewers_) place(*viewer);
    for (const auto& rendition : renditions_) rendition->want();
    advance(now);
}

void SharedView::tellOpened(Viewer& viewer) {
    viewer.opened = true;
    v1::ServerMessage message;
    v1::ViewOpened& opened = *message.mutable_view_opened();
    opened.set_view(viewer.number());
    *opened.mutable_scene() = worker::toMessage(*state_.scene);
    opened.set_id(id_);
    opened.set_input_seq(state_.inputSeq);
    tell(viewer, std::move(message));
}

void SharedView::datasetChanged(ViewerId viewer, const std::string& dataset) {
    const Turn turn{*this};
    if (viewers_.begin()->first == viewer) sceneNews(dataset, Clock::now());
}

void SharedView::refresh(TimePoint now) {
    for (const std::string& dataset : scene_.datasets()) sceneNews(dataset, now);
}

void SharedView::sceneNews(const std::string& dataset, TimePoint now) {
    const auto change = scene_.datasetChanged(dataset);
    if (change) {
        if (*change == SceneChange::kDraw) state_.inputAt = now;
        return apply(*change, now);
    }
    const bool importFailed = parts_.catalogue.standing(dataset).failed;
    for (const auto& [id, viewer] : viewers_) {
        refuse(*viewer, change.error(),
               importFailed ? v1::ERROR_CODE_IMPORT_FAILED : wireCode(change.error().code));
    }
}

void SharedView::setState(Viewer& viewer, v1::ViewState state, const std::string& text) {
    if (viewer.state == state) return;
    viewer.state = state;
    spdlog::info(R"(event=view_state view={} number={} state={} message="{}")", id_,
                 viewer.number(), v1::ViewState_Name(state), base::printable(text, 1000));
    tell(viewer, statusMessage(viewer.number(), state, text));
}

void SharedView::refuse(Viewer& viewer, const Error& error, v1::ErrorCode code) {
    tell(viewer,
         errorMessage(code, error.message, {.view = viewer.number(), .inputSeq = scene_.shownSeq()},
                      error.field));
    setState(viewer, v1::VIEW_STATE_FAILED, error.message);
}

void SharedView::tell(Viewer& viewer, v1::ServerMessage message) {
    viewer.mail.put(std::move(message));
    wake(viewer);
}

void SharedView::wake(const Viewer& viewer) {
    if (viewer.wake()) outbox_.put(viewer.wake());
}

}  // namespace volcast::session
