#include "server/session/views.h"

#include <utility>

#include <spdlog/spdlog.h>

namespace volcast::session {

namespace {

constexpr std::size_t kIdBytes = 16;

}  // namespace

Views::Views(ViewsDesc desc) : desc_{std::move(desc)}, people_{desc_.key} {
    if (!desc_.state) return;
    desc_.parts.changed = [this](const std::string& id) { desc_.state->changed(id); };
    restore();
    desc_.state->begin([this](const std::string& id) { return saved(id); });
}

Views::~Views() {
    clear();
}

void Views::restore() {
    const TimePoint until = Clock::now() + desc_.keep;
    for (const SavedView& saved : desc_.state->load()) {
        auto view = SharedView::create(desc_.parts, saved.id);
        view->restore(saved, until);
        for (const auto& [member, steers, tokenHash] : saved.people) {
            people_.restore(member.person, member.name, tokenHash, member.number, saved.id, until);
        }
        spdlog::info("event=view_restored view={} people={}", saved.id, saved.people.size());
        views_[saved.id] = {.view = std::move(view), .shared = saved.shared};
    }
}

std::optional<SavedView> Views::saved(const std::string& id) {
    Entry entry;
    {
        const std::lock_guard lock{mutex_};
        const auto found = views_.find(id);
        if (found == views_.end()) return std::nullopt;
        entry = found->second;
    }
    auto saved = entry.view->save();
    if (!saved) return std::nullopt;
    saved->shared = entry.shared;
    for (SavedView::Person& person : saved->people) {
        person.tokenHash = people_.tokenHash(person.member.person);
    }
    return saved;
}

Result<std::shared_ptr<SharedView>> Views::open(const v1::OpenView& message) {
    auto id = randomName(kIdBytes);
    if (!id) return id.error();
    const std::lock_guard lock{mutex_};
    sweep(Clock::now());
    if (views_.size() >= desc_.maxViews && !makeRoom()) {
        return fail(ErrorCode::kLimitExceeded,
                    "this server has " + std::to_string(views_.size()) +
                        " views, the most that it takes (--max-open-views)",
                    "view");
    }
    auto view = SharedView::create(desc_.parts, std::move(*id));
    if (const auto opened = view->open(message); !opened) {
        view->end();
        return opened.error();
    }
    views_[view->id()] = {.view = view};
    return view;
}

Result<std::string> Views::share(const SharedView& view, v1::Role role,
                                 std::chrono::system_clock::time_point expires) {
    {
        const std::lock_guard lock{mutex_};
        const auto found = views_.find(view.id());
        if (found != views_.end()) found->second.shared = true;
        if (desc_.state) desc_.state->changed(view.id());
    }
    return signLink({.view = view.id(), .role = role, .expires = expires}, desc_.key);
}

Result<Link> Views::link(const std::string& text) const {
    return readLink(text, desc_.key, std::chrono::system_clock::now());
}

Result<Access> Views::access(const std::string& token) const {
    return readAccess(token, desc_.key, std::chrono::system_clock::now());
}

std::shared_ptr<SharedView> Views::find(const std::string& id) {
    const std::lock_guard lock{mutex_};
    sweep(Clock::now());
    const auto found = views_.find(id);
    return found == views_.end() ? nullptr : found->second.view;
}

void Views::left(const std::shared_ptr<SharedView>& view) {
    const std::lock_guard lock{mutex_};
    const auto now = Clock::now();
    sweep(now);
    const auto found = views_.find(view->id());
    if (found == views_.end() || found->second.shared) return;
    if (view->abandoned(now)) erase(found);
}

void Views::tidy() {
    const std::lock_guard lock{mutex_};
    sweep(Clock::now());
}

std::size_t Views::size() {
    const std::lock_guard lock{mutex_};
    return views_.size();
}

std::size_t Views::picturesToEncode() {
    return desc_.parts.encoders.waiting();
}

void Views::sweep(TimePoint now) {
    people_.expire(now);
    for (auto entry = views_.begin(); entry != views_.end();) {
        const auto since = entry->second.view->emptySince();
        entry = since && now - *since >= desc_.keep ? erase(entry) : std::next(entry);
    }
}

/// Ends the view that nobody has looked at for longest; false where all are being looked at.
bool Views::makeRoom() {
    auto oldest = views_.end();
    std::optional<TimePoint> since;
    for (auto entry = views_.begin(); entry != views_.end(); ++entry) {
        const auto empty = entry->second.view->emptySince();
        if (!empty || (since && *since <= *empty)) continue;
        oldest = entry;
        since = empty;
    }
    if (oldest == views_.end()) return false;
    erase(oldest);
    return true;
}

Views::Entries::iterator Views::erase(Entries::iterator entry) {
    spdlog::info("event=view_ended view={}", entry->first);
    entry->second.view->end();
    if (desc_.state) desc_.state->changed(entry->first);
    return views_.erase(entry);
}

void Views::clear() {
    if (desc_.state) desc_.state->finish();  // That a view ends now is not to be saved.
    Entries all;
    {
        const std::lock_guard lock{mutex_};
        all.swap(views_);
    }
    for (const auto& [id, entry] : all) entry.view->end();
}

}  // namespace volcast::session
