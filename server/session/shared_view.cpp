// A view's scene and its viewers: what is done to it, and what they are told.
#include "server/session/shared_view.h"

#include <algorithm>
#include <utility>

#include <spdlog/spdlog.h>

#include "renderer/base/printable.h"
#include "renderer/worker/scene_message.h"
#include "server/session/wire.h"

namespace volcast::session {

namespace {

constexpr const char* kImporting = "its data is being imported";

}  // namespace

std::shared_ptr<SharedView> SharedView::create(const ViewParts& parts, std::string id) {
    std::shared_ptr<SharedView> made{new SharedView{parts, std::move(id)}};
    made->route();
    return made;
}

SharedView::SharedView(const ViewParts& parts, std::string id)
    : parts_{parts}, id_{std::move(id)}, global_{parts.router.reserve()}, scene_{parts.catalogue} {}

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
    emptySince_ = Clock::now();
    apply(*change, Clock::now(), 0);
    return boost::system::in_place_value;
}

void SharedView::end() {
    const Turn turn{*this};
    if (std::exchange(ended_, true)) return;
    parts_.router.remove(global_);
    dropThumbnails();
    if (viewers_.empty()) return;  // Was dropped when the last one left.
    outbox_.put([&render = parts_.render, view = global_] { render.dropView(view); });
}

Result<void> SharedView::update(ViewerId id, const v1::Update& message, TimePoint now) {
    const Turn turn{*this};
    Viewer* viewer = find(id);
    if (viewer == nullptr) return boost::system::in_place_value;
    scene::PictureSize size = viewer->size();
    if (message.has_viewport()) {
        const auto wanted = sizeFrom(message.viewport(), parts_.maxPixels);
        if (!wanted) return wanted.error();
        size = *wanted;
    }
    const std::uint64_t seq = message.input_seq();
    const bool steers = people_.steers(id);
    const bool changesScene = message.has_scene() || message.has_camera();
    SceneChange change = SceneChange::kNone;
    if (changesScene && !steers) {
        tellRefusal(id, people_.whyNotSteering(id), seq);
        // What the client shows may be ahead of the scene: control went while inputs were under
        // way.
        if (state_.scene && viewer->opened) tellScene(*viewer);
        return boost::system::in_place_value;
    }
    if (changesScene) {
        const SceneHistory::ScenePtr before = state_.scene;
        const auto accepted = scene_.update(message);
        if (!accepted) return accepted.error();
        change = *accepted;
        if (change == SceneChange::kNone) return boost::system::in_place_value;
        if (change == SceneChange::kSame && answerAgain(*viewer, size, 0, now)) {
            return boost::system::in_place_value;
        }
        if (change == SceneChange::kSame) {
            change = SceneChange::kDraw;
        } else {
            history_.changed(before, !message.has_scene(), now);
        }
        for (const auto& [other, one] : viewers_) one->input(now);
        stopMeasuring("the view changed");
    } else {
        const bool old = steers ? !scene_.advance(seq) : seq <= viewer->resizedBy();
        if (old || answerAgain(*viewer, size, steers ? 0 : seq, now)) {
            return boost::system::in_place_value;
        }
    }
    state_.inputAt = now;
    state_.inputSeq = scene_.shownSeq();
    if (measures_ == id) stopMeasuring("the view changed");
    viewer->input(now);
    viewer->resize(size, steers ? 0 : seq);
    people_.at(id).size = size;
    place(*viewer);
    viewer->rendition->want();
    if (change == SceneChange::kNone) changed();  // Its size is saved, too.
    apply(change, now, id, !message.has_scene());
    advance(*viewer, now);
    return boost::system::in_place_value;
}

/// An update that changed nothing, where the viewer's newest picture shows all there is: that one
/// is its answer, once more and as it was sent, with the newer number. False where there is
/// something to draw after all.
bool SharedView::answerAgain(Viewer& viewer, scene::PictureSize size, std::uint64_t resizedBy,
                             TimePoint now) {
    if (size != viewer.size() || !viewer.shows(state_.scene)) return false;
    state_.inputSeq = scene_.shownSeq();
    viewer.resize(size, resizedBy);
    for (const auto& [id, one] : viewers_) one->stays(state_.scene, state_.inputSeq);
    viewer.sendAgain();
    changed();
    advance(viewer, now);
    return true;
}

void SharedView::undo(ViewerId id, const v1::Undo& message, TimePoint now) {
    const Turn turn{*this};
    const Viewer* viewer = find(id);
    if (viewer == nullptr) return;
    const std::uint64_t seq =
        message.input_seq() == 0 ? scene_.inputSeq() + 1 : message.input_seq();
    if (!people_.steers(id)) return tellRefusal(id, people_.whyNotSteering(id), seq);
    if (seq <= scene_.inputSeq()) return;
    const auto target = !state_.scene    ? nullptr
                        : message.redo() ? history_.redo(state_.scene)
                                         : history_.undo(state_.scene);
    const ErrorContext about{.view = viewer->number(), .inputSeq = seq};
    if (!target) {
        return tell(*find(id), errorMessage(v1::ERROR_CODE_NOT_FOUND,
                                            message.redo() ? "there is nothing to redo"
                                                           : "there is nothing to undo",
                                            about));
    }
    const auto change = scene_.put(*target, seq);
    if (!change) {
        // The step is taken back, so that it may be asked for again.
        if (message.redo()) {
            history_.undo(target);
        } else {
            history_.redo(target);
        }
        return tell(*find(id), errorMessage(change.error(), about));
    }
    for (const auto& [other, one] : viewers_) one->input(now);
    stopMeasuring("the view changed");
    state_.inputAt = now;
    apply(*change, now, 0);
}

void SharedView::setPins(ViewerId id, const PacePins& pins, v1::Codec codec, TimePoint now) {
    const Turn turn{*this};
    Viewer* viewer = find(id);
    if (viewer == nullptr) return;
    viewer->setPins(pins, codec);
    advance(*viewer, now);
}

void SharedView::setCodecs(ViewerId id, const ClientCodecs& codecs) {
    const Turn turn{*this};
    if (Viewer* viewer = find(id)) viewer->setCodecs(codecs);
}

std::chrono::microseconds SharedView::acked(ViewerId id, const FrameAck& ack, TimePoint now) {
    const Turn turn{*this};
    Viewer* viewer = find(id);
    if (viewer == nullptr) return {};
    viewer->acked(ack, now);
    advance(*viewer, now);
    return viewer->roundTrip();
}

std::optional<v1::ServerMessage> SharedView::takeMail(ViewerId id) {
    const Lock lock{mutex_};
    Viewer* viewer = find(id);
    return viewer == nullptr ? std::nullopt : viewer->mail.take();
}

void SharedView::apply(SceneChange change, TimePoint now, ViewerId author, bool cameraOnly) {
    if (change == SceneChange::kNone) return;
    for (const auto& [id, viewer] : viewers_) {
        if (scene_.waiting()) {
            setState(*viewer, v1::VIEW_STATE_WAITING, kImporting);
        } else if (viewer->state == v1::VIEW_STATE_WAITING) {
            setState(*viewer, v1::VIEW_STATE_ACTIVE, "");
        }
    }
    if (change != SceneChange::kDraw || !scene_.scene()) return;
    const auto before =
        std::exchange(state_.scene, std::make_shared<const scene::Scene>(*scene_.scene()));
    state_.inputSeq = scene_.shownSeq();
    state_.dataVersion = scene_.dataVersion();
    author_ = author;
    if (before && *before != *state_.scene) tellScene(author, cameraOnly);
    for (const auto& [id, viewer] : viewers_) {
        if (!viewer->opened) tellOpened(id);
        wake(*viewer);
    }
    for (const auto& [id, viewer] : viewers_) place(*viewer);
    changed();
    for (const auto& rendition : renditions_) rendition->want();
    advance(now);
}

void SharedView::tellOpened(ViewerId id) {
    Viewer& viewer = *find(id);
    viewer.opened = true;
    v1::ServerMessage message;
    v1::ViewOpened& opened = *message.mutable_view_opened();
    opened.set_view(viewer.number());
    *opened.mutable_scene() = worker::toMessage(*state_.scene);
    opened.set_id(id_);
    opened.set_role(people_.at(id).role);
    opened.set_input_seq(state_.inputSeq);
    opened.set_can_undo(history_.canUndo());
    opened.set_can_redo(history_.canRedo());
    tell(viewer, std::move(message));
}

v1::ServerMessage SharedView::sceneMessage(ViewerId author, bool cameraOnly) const {
    v1::ServerMessage message;
    v1::SceneChanged& changed = *message.mutable_scene_changed();
    changed.set_input_seq(state_.inputSeq);
    changed.set_can_undo(history_.canUndo());
    changed.set_can_redo(history_.canRedo());
    if (author != 0) changed.set_person(people_.at(author).person);
    v1::Scene scene = worker::toMessage(*state_.scene);
    if (cameraOnly) {
        *changed.mutable_camera() = std::move(*scene.mutable_camera());
    } else {
        *changed.mutable_scene() = std::move(scene);
    }
    return message;
}

void SharedView::tellScene(ViewerId author, bool cameraOnly) {
    const bool alone = std::ranges::all_of(
        viewers_, [author](const auto& one) { return one.first == author || !one.second->opened; });
    if (alone) return;
    v1::ServerMessage message = sceneMessage(author, cameraOnly);
    for (const auto& [id, viewer] : viewers_) {
        if (id == author || !viewer->opened) continue;
        message.mutable_scene_changed()->set_view(viewer->number());
        tell(*viewer, message);
    }
}

void SharedView::tellScene(Viewer& viewer) {
    v1::ServerMessage message = sceneMessage(0, false);
    message.mutable_scene_changed()->set_view(viewer.number());
    message.mutable_scene_changed()->set_input_seq(scene_.inputSeq());
    tell(viewer, std::move(message));
}

void SharedView::datasetChanged(ViewerId viewer, const std::string& dataset) {
    const Turn turn{*this};
    if (!viewers_.empty() && viewers_.begin()->first == viewer) sceneNews(dataset, Clock::now());
}

void SharedView::refresh(TimePoint now) {
    for (const std::string& dataset : scene_.datasets()) sceneNews(dataset, now);
}

void SharedView::sceneNews(const std::string& dataset, TimePoint now) {
    const auto change = scene_.datasetChanged(dataset);
    if (change) {
        if (*change == SceneChange::kDraw) state_.inputAt = now;
        return apply(*change, now, 0);
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
    const auto of = std::ranges::find(
        viewers_, &viewer, [](const auto& one) -> const Viewer* { return one.second.get(); });
    spdlog::info(R"(event=view_state view={} person={} number={} state={} message="{}")", id_,
                 of == viewers_.end() ? 0 : people_.at(of->first).person, viewer.number(),
                 v1::ViewState_Name(state), base::printable(text, 1000));
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

Viewer* SharedView::find(ViewerId viewer) const {
    const auto found = viewers_.find(viewer);
    return found == viewers_.end() ? nullptr : found->second.get();
}

void SharedView::changed() {
    if (parts_.changed) outbox_.put([this] { parts_.changed(id_); });
}

void SharedView::wake(const Viewer& viewer) {
    if (viewer.wake()) outbox_.put(viewer.wake());
}

}  // namespace volcast::session
