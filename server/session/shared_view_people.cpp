// Who is in a view: coming, going, coming back, and who steers.
#include <iterator>
#include <utility>

#include <spdlog/spdlog.h>

#include "server/session/shared_view.h"
#include "server/session/wire.h"

namespace volcast::session {

namespace {

/// Moves the entry at `own` before others of the same person, so that one finds one's own place.
void putFirst(v1::People& people, int own) {
    auto& list = *people.mutable_people();
    for (int i = 0; i < own; ++i) {
        if (list[i].id() == list[own].id()) return list.SwapElements(i, own);
    }
}

}  // namespace

Result<ViewerId> SharedView::join(Viewer::Desc desc, Member member, TimePoint now) {
    const Turn turn{*this};
    if (ended_) return fail(ErrorCode::kNotFound, "the view has ended", "link");
    expire(now);
    if (people_.all().size() >= parts_.maxPeople && !people_.removeOneAway()) {
        return fail(ErrorCode::kLimitExceeded,
                    "this view has " + std::to_string(parts_.maxPeople) +
                        " people, the most that may be in one (--max-people)",
                    "link");
    }
    const ViewerId id = ++lastViewer_;
    member.number = desc.number;
    member.size = desc.size;
    people_.add(id, std::move(member));
    seat(id, std::move(desc), now);
    return id;
}

std::optional<ViewerId> SharedView::comeBack(Viewer::Desc desc, std::uint32_t person,
                                             TimePoint now) {
    const Turn turn{*this};
    const auto before = people_.find(person, desc.number);
    if (!before || ended_) return std::nullopt;
    unseat(*before);  // Still there where its connection was not seen to end.
    const ViewerId id = ++lastViewer_;
    people_.comeBack(*before, id);
    desc.size = people_.at(id).size;
    seat(id, std::move(desc), now);
    return id;
}

void SharedView::seat(ViewerId id, Viewer::Desc desc, TimePoint now) {
    const bool first = viewers_.empty();
    emptySince_.reset();
    Viewer& viewer = *(viewers_[id] = std::make_unique<Viewer>(std::move(desc)));
    viewer.input(now);
    place(viewer);
    openRestored(now);
    if (first) refresh(now);
    if (scene_.waiting()) setState(viewer, v1::VIEW_STATE_WAITING, "its data is being imported");
    if (state_.scene && !viewer.opened) tellOpened(id);
    tellPeople();
    changed();
    advance(viewer, now);
}

/// Takes a viewer away; the person stays.
void SharedView::unseat(ViewerId id) {
    if (find(id) == nullptr) return;
    if (measures_ == id) stopMeasuring("its viewer left");
    const bool first = viewers_.begin()->first == id;
    picks_.erase(id);
    if (picker_ == id) pickNext();
    forgetThumbnails(id);
    viewers_.erase(id);
    dropUnused();
    if (viewers_.empty()) {
        emptySince_ = Clock::now();
        drawing_.reset();
        outbox_.put([&render = parts_.render, view = global_] { render.dropView(view); });
        dropThumbnails();
    } else if (first) {
        refresh(Clock::now());  // News that it alone would have brought.
    }
}

void SharedView::leave(ViewerId id) {
    const Turn turn{*this};
    if (find(id) == nullptr) return;
    unseat(id);
    const ViewerId steered = people_.steering();
    people_.remove(id);
    peopleChanged(steered);
}

void SharedView::lose(ViewerId id, TimePoint until) {
    const Turn turn{*this};
    if (find(id) == nullptr) return;
    unseat(id);
    people_.away(id, until);
    tellPeople();
    for (const auto& [other, viewer] : viewers_) wake(*viewer);  // One of them sees to the expiry.
}

void SharedView::takeControl(ViewerId id) {
    const Turn turn{*this};
    Viewer* viewer = find(id);
    if (viewer == nullptr || people_.steers(id)) return;
    if (const std::string why = people_.take(id); !why.empty()) return tellRefusal(id, why, 0);
    peopleChanged(0);
}

void SharedView::handOver(ViewerId id, std::uint32_t person) {
    const Turn turn{*this};
    if (find(id) == nullptr) return;
    const std::string why = people_.handOver(id, person);
    if (!why.empty()) return tellRefusal(id, why, 0);
    peopleChanged(id);
}

void SharedView::askControl(ViewerId id, bool withdraw) {
    const Turn turn{*this};
    if (find(id) == nullptr) return;
    if (const std::string why = people_.ask(id, withdraw); !why.empty()) {
        return tellRefusal(id, why, 0);
    }
    tellPeople();
}

void SharedView::rename(ViewerId id, const std::string& name) {
    const Turn turn{*this};
    if (find(id) == nullptr) return;
    people_.at(id).name = name;
    tellPeople();
    changed();
}

/// Tells everybody; first the one who steers now and did not: `steered` did. They count from the
/// newest input, which they must know before they steer.
void SharedView::peopleChanged(ViewerId steered) {
    Viewer* viewer = people_.steers(steered) ? nullptr : find(people_.steering());
    if (viewer != nullptr) {
        spdlog::info(R"(event=control_taken view={} person={})", id_,
                     people_.at(people_.steering()).person);
        viewer->resize(viewer->size(), 0);
        if (state_.scene && viewer->opened) tellScene(*viewer);
    }
    tellPeople();
    changed();
}

std::string SharedView::whyNotSharing(ViewerId id) const {
    const Lock lock{mutex_};
    if (find(id) == nullptr) return "the view is not open";
    if (people_.at(id).role == v1::ROLE_CONTROL) return {};
    return "you may watch this view but not share it";
}

void SharedView::tellRefusal(ViewerId id, const std::string& why, std::uint64_t inputSeq) {
    Viewer& viewer = *find(id);
    tell(viewer, errorMessage(v1::ERROR_CODE_NOT_PERMITTED, why,
                              {.view = viewer.number(), .inputSeq = inputSeq}));
}

void SharedView::tellPeople() {
    for (const auto& [id, viewer] : viewers_) {
        v1::ServerMessage message;
        *message.mutable_people() = people_.message(viewer->number());
        const auto own = std::distance(people_.all().begin(), people_.all().find(id));
        putFirst(*message.mutable_people(), static_cast<int>(own));
        tell(*viewer, std::move(message));
    }
}

void SharedView::expire(TimePoint now) {
    const ViewerId steered = people_.steering();
    if (people_.expire(now)) peopleChanged(steered);
}

void SharedView::restore(const SavedView& saved, TimePoint until) {
    const Turn turn{*this};
    restored_ = saved;
    emptySince_ = Clock::now();
    for (const SavedView::Person& person : saved.people) {
        const ViewerId id = ++lastViewer_;
        people_.add(id, person.member);
        people_.away(id, until);
        if (person.steers) people_.steer(id);
    }
}

void SharedView::openRestored(TimePoint now) {
    if (!restored_) return;
    const SavedView saved = *std::exchange(restored_, std::nullopt);
    const auto change = scene_.put(saved.scene, saved.inputSeq);
    history_.restore(saved.history);
    state_.inputAt = now;
    if (change) return apply(*change, now, 0);
    for (const auto& [id, viewer] : viewers_) {
        refuse(*viewer, change.error(), wireCode(change.error().code));
    }
}

std::optional<SavedView> SharedView::save() const {
    const Lock lock{mutex_};
    if (ended_ || (!restored_ && !state_.scene)) return std::nullopt;
    SavedView saved{.id = id_,
                    .inputSeq = restored_ ? restored_->inputSeq : scene_.shownSeq(),
                    .scene = restored_ ? restored_->scene : *state_.scene,
                    .history = restored_ ? restored_->history : history_.save()};
    for (const auto& [id, member] : people_.all()) {
        saved.people.push_back({.member = member, .steers = people_.steers(id)});
    }
    return saved;
}

bool SharedView::abandoned(TimePoint now) {
    const Turn turn{*this};
    expire(now);
    return people_.all().empty();
}

std::optional<TimePoint> SharedView::emptySince() const {
    const Lock lock{mutex_};
    return emptySince_;
}

}  // namespace volcast::session
