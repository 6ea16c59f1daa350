// A view's pictures: wanted -> at the render service -> encoded -> taken by each viewer.
#include <algorithm>
#include <utility>

#include <spdlog/spdlog.h>

#include "renderer/base/printable.h"
#include "server/session/explain.h"
#include "server/session/shared_view.h"
#include "server/session/wire.h"

namespace volcast::session {

void SharedView::place(Viewer& viewer) {
    viewer.limitDrawing(drawPace_.level(viewer.size()), drawPace_.reason(viewer.size()));
    const RenditionKey key = viewer.wanted();
    if (viewer.rendition && viewer.rendition->key() == key) return;
    const auto found =
        std::ranges::find(renditions_, key, [](const auto& one) { return one->key(); });
    const auto others = std::ranges::count_if(
        viewers_, [&viewer](const auto& one) { return one.second->rendition == viewer.rendition; });
    if (found != renditions_.end()) {
        viewer.moveTo(*found);
    } else if (viewer.rendition && others == 1) {
        viewer.rendition->change(key);  // Alone: what is being drawn for it is shown meanwhile.
    } else {
        viewer.moveTo(renditions_.emplace_back(std::make_shared<Rendition>(key)));
    }
    dropUnused();
}

void SharedView::dropUnused() {
    std::erase_if(renditions_, [this](const auto& rendition) {
        const bool used = std::ranges::any_of(
            viewers_, [&rendition](const auto& one) { return one.second->rendition == rendition; });
        if (!used) plans_.erase(rendition.get());
        return !used;
    });
}

void SharedView::advance(TimePoint now) {
    for (const auto& rendition : renditions_) {
        if (!mayDraw(rendition, now)) continue;
        draw(std::shared_ptr{rendition}, now);
        break;
    }
    for (const auto& [id, viewer] : viewers_) encodeFor(*viewer, now);
}

void SharedView::advance(Viewer& viewer, TimePoint now) {
    viewer.rest(now);
    place(viewer);
    encodeFor(viewer, now);
    if (mayDraw(viewer.rendition, now)) draw(viewer.rendition, now);
}

bool SharedView::isWanted(const std::shared_ptr<Rendition>& rendition, TimePoint now) const {
    return rendition->wants() && std::ranges::any_of(viewers_, [&](const auto& one) {
               return one.second->rendition == rendition && one.second->mayDraw(now);
           });
}

bool SharedView::isPatient(const std::shared_ptr<Rendition>& rendition) const {
    return std::ranges::all_of(viewers_, [&](const auto& one) {
        return one.second->rendition != rendition || one.second->resting();
    });
}

bool SharedView::mayDraw(const std::shared_ptr<Rendition>& rendition, TimePoint now) const {
    if (ended_ || !state_.scene || !isWanted(rendition, now)) return false;
    if (!drawing_) return true;
    if (drawsPatiently_ && !isPatient(rendition)) return true;
    // A newer state takes the place of the one that waits there, unless that would keep another
    // rendition from its turn for as long as inputs come.
    return drawing_ == rendition && std::ranges::none_of(renditions_, [&](const auto& other) {
               return other != rendition && isWanted(other, now);
           });
}

void SharedView::draw(const std::shared_ptr<Rendition>& rendition, TimePoint now) {
    const bool ends = drawing_ && drawing_ != rendition;  // The request of another that is patient.
    if (ends) drawing_->want();
    drawing_ = rendition;
    drawsPatiently_ = isPatient(rendition);
    rendition->asked(++lastTag_, state_, now);
    // The one that is drawn goes to the end, so that others have their turn.
    const auto isOther = [&rendition](const auto& one) { return one != rendition; };
    std::stable_partition(renditions_.begin(), renditions_.end(), isOther);
    ++counts_.drawsAsked;
    workers::RenderRequest request{.view = global_,
                                   .tag = lastTag_,
                                   .scene = *state_.scene,
                                   .size = rendition->key().size,
                                   .hurried = !rendition->key().fullAccuracy,
                                   .viewId = id_,
                                   .patient = drawsPatiently_};
    outbox_.put([&render = parts_.render, request = std::move(request)]() mutable {
        render.submit(std::move(request));
    });
}

void SharedView::settle(std::uint64_t tag) {
    if (tag == lastTag_) drawing_.reset();
}

void SharedView::rendered(const workers::RenderedFrame& frame) {
    const Turn turn{*this};
    if (ended_) return;
    settle(frame.tag);
    const auto now = Clock::now();
    const auto found = std::ranges::find_if(renditions_, [&](const auto& rendition) {
        return rendition->rendered(frame, lastPicture_ + 1);
    });
    if (found == renditions_.end()) return advance(now);
    const Rendition* drawn = found->get();
    ++lastPicture_;
    const std::uint64_t shows = drawn->picture()->header.input_seq();
    scene_.drawn(shows);
    plans_[drawn] = planMessage(frame, 0, shows);
    const bool waiting = scene_.waiting();
    for (const auto& [id, viewer] : viewers_) {
        if (viewer->rendition.get() != drawn) continue;
        if (viewer->state == v1::VIEW_STATE_RECOVERING && waiting) {
            setState(*viewer, v1::VIEW_STATE_WAITING, "its data is being imported");
        } else if (!waiting) {
            setState(*viewer, v1::VIEW_STATE_ACTIVE, "");
        }
        // Without a credit it sleeps until an ack, or until it may be probed.
        if (!encodeFor(*viewer, now)) wake(*viewer);
    }
    pacedBy(frame, drawn->picture()->key);
    advance(now);
}

void SharedView::pacedBy(const workers::RenderedFrame& frame, const RenditionKey& key) {
    if (!frame.drawn || !drawPace_.drawn(key.size, key.fullAccuracy, frame.drawMs)) return;
    // All together, so that no two levels are drawn for long.
    for (const auto& [id, viewer] : viewers_) place(*viewer);
}

void SharedView::failed(std::uint64_t tag, const Error& error) {
    const Turn turn{*this};
    if (ended_) return;
    settle(tag);
    const auto now = Clock::now();
    bool newest = false;
    const auto found = std::ranges::find_if(
        renditions_, [&](const auto& rendition) { return rendition->failed(tag, newest); });
    if (found == renditions_.end() || !newest) return advance(now);
    const std::shared_ptr<Rendition> refused = *found;
    Error told = error;
    if (told.field.starts_with("layers[")) told.field = "scene." + told.field;
    // Not where the worker alone is to blame: the scene is drawn once there is one again.
    const bool sceneIsToBlame = !error.field.empty() || error.code == ErrorCode::kOutOfGpuMemory;
    const auto reverted = sceneIsToBlame ? scene_.revert() : std::nullopt;
    if (reverted) {
        told.message += "; the scene of input " + std::to_string(*reverted) +
                        " is refused, the last one that was drawn stays";
    }
    for (const auto& [id, viewer] : viewers_) {
        if (!reverted) {
            if (viewer->rendition != refused) continue;
            refuse(*viewer, told, wireCode(error.code));
        } else {
            tell(*viewer,
                 errorMessage(told, {.view = viewer->number(), .inputSeq = scene_.shownSeq()}));
            setState(*viewer, v1::VIEW_STATE_ACTIVE, "");
        }
    }
    if (!reverted) return advance(now);
    apply(SceneChange::kDraw, now, find(author_) == nullptr ? 0 : author_);
}

void SharedView::recovering() {
    const Turn turn{*this};
    for (const auto& [id, viewer] : viewers_) {
        if (!viewer->opened) continue;
        setState(*viewer, v1::VIEW_STATE_RECOVERING, "the renderer was lost and is being replaced");
    }
}

bool SharedView::encodeFor(Viewer& viewer, TimePoint now) {
    if (ended_) return false;
    const auto encoding = viewer.takeEncode(now);
    if (!encoding) return false;
    if (encoding->done && encoding->error) {
        if (encodingFailed(viewer, *encoding->error)) return encodeFor(viewer, now);
    } else if (encoding->done) {
        wake(viewer);
    } else if (!std::exchange(encoding->begun, true)) {
        ++counts_.encodes;
        // A copy, as other viewers may look at it meanwhile.
        outbox_.put(
            [weak = weak_from_this(), encoding, what = *encoding, &encoders = parts_.encoders] {
                encoders.run([weak, encoding, what] {
                    Encoding done = encode(what);
                    if (const auto self = weak.lock()) self->encoded(encoding, std::move(done));
                });
            });
    }
    return true;
}

void SharedView::encoded(const std::shared_ptr<Encoding>& encoding, Encoding done) {
    const Turn turn{*this};
    *encoding = std::move(done);
    const auto now = Clock::now();
    for (const auto& [id, viewer] : viewers_) {
        if (!viewer->waitsFor(*encoding)) continue;
        wake(*viewer);
        if (!encoding->error) continue;
        encodingFailed(*viewer, *encoding->error);
        advance(*viewer, now);
    }
}

bool SharedView::encodingFailed(Viewer& viewer, const Error& error) {
    if (viewer.encoded()) {
        spdlog::warn(R"(event=video_failed view={} number={} message="{}")", id_, viewer.number(),
                     base::printable(error.message, 1000));
        return true;
    }
    refuse(viewer, error, v1::ERROR_CODE_RENDER_FAILED);
    return false;
}

std::optional<ReadyFrame> SharedView::takeFrame(ViewerId id, TimePoint now) {
    const Turn turn{*this};
    Viewer* viewer = find(id);
    auto frame = viewer == nullptr ? std::nullopt : viewer->takeFrame(now);
    if (frame) advance(*viewer, now);
    return frame;
}

void SharedView::tick(ViewerId id, TimePoint now) {
    const Turn turn{*this};
    expire(now);
    Viewer* viewer = find(id);
    if (viewer == nullptr) return;
    viewer->tick(now);
    advance(*viewer, now);
}

std::optional<TimePoint> SharedView::deadline(ViewerId id, TimePoint now) const {
    const Lock lock{mutex_};
    const Viewer* viewer = find(id);
    if (viewer == nullptr) return std::nullopt;
    const auto frames = viewer->deadline(now), expiry = people_.firstExpiry();
    return frames && expiry ? std::min(frames, expiry) : frames ? frames : expiry;
}

std::uint32_t SharedView::framesSent(ViewerId id) const {
    const Lock lock{mutex_};
    const Viewer* viewer = find(id);
    return viewer == nullptr ? 0 : viewer->framesSent();
}

SharedView::Counts SharedView::counts() const {
    const Lock lock{mutex_};
    return counts_;
}

}  // namespace volcast::session
