#include "server/session/person_book.h"

#include <algorithm>
#include <utility>

namespace volcast::session {

namespace {

constexpr std::size_t kTokenBytes = 24;

std::string nameOf(std::uint32_t person, std::string wanted) {
    return wanted.empty() ? "Guest " + std::to_string(person) : std::move(wanted);
}

}  // namespace

std::string PersonBook::hashOf(const std::string& token) const {
    const auto signature = key_.sign("resume", token);
    return base64Url({reinterpret_cast<const char*>(signature.data()), signature.size()});
}

Result<PersonBook::Arrival> PersonBook::enter(std::uint32_t person, Record& record,
                                              std::function<void()> replaced) {
    auto token = randomName(kTokenBytes);
    if (!token) return token.error();
    record.tokenHash = hashOf(*token);
    record.visit = ++lastVisit_;
    record.replaced = std::move(replaced);
    record.until = TimePoint::max();
    return Arrival{.person = person,
                   .name = record.name,
                   .token = std::move(*token),
                   .visit = record.visit,
                   .views = record.views};
}

Result<PersonBook::Arrival> PersonBook::arrive(std::string name, std::function<void()> replaced) {
    const std::lock_guard lock{mutex_};
    const std::uint32_t person = ++lastPerson_;
    Record& record = records_[person];
    record.name = nameOf(person, std::move(name));
    return enter(person, record, std::move(replaced));
}

Result<PersonBook::Arrival> PersonBook::resume(const std::string& token,
                                               std::function<void()> replaced, TimePoint now) {
    const std::lock_guard lock{mutex_};
    // Looked up by a keyed hash: how long that takes tells nothing of other tokens.
    const auto found = std::ranges::find(records_, hashOf(token),
                                         [](const auto& one) { return one.second.tokenHash; });
    if (found == records_.end() || found->second.until <= now) {
        return fail(ErrorCode::kInvalidArgument,
                    "the resume token is unknown, was used already, or is too old", "hello.resume");
    }
    if (found->second.replaced) found->second.replaced();
    return enter(found->first, found->second, std::move(replaced));
}

void PersonBook::lost(std::uint32_t person, std::uint64_t visit, TimePoint until) {
    const std::lock_guard lock{mutex_};
    const auto found = records_.find(person);
    if (found == records_.end() || found->second.visit != visit) return;  // Went on elsewhere.
    found->second.replaced = nullptr;
    found->second.until = until;
}

std::string PersonBook::rename(std::uint32_t person, std::string name) {
    const std::lock_guard lock{mutex_};
    std::string taken = nameOf(person, std::move(name));
    const auto found = records_.find(person);
    if (found != records_.end()) found->second.name = taken;
    return taken;
}

void PersonBook::opened(std::uint32_t person, std::uint32_t number, const std::string& view) {
    const std::lock_guard lock{mutex_};
    const auto found = records_.find(person);
    if (found != records_.end()) found->second.views[number] = view;
}

void PersonBook::closed(std::uint32_t person, std::uint32_t number) {
    const std::lock_guard lock{mutex_};
    const auto found = records_.find(person);
    if (found != records_.end()) found->second.views.erase(number);
}

std::string PersonBook::tokenHash(std::uint32_t person) const {
    const std::lock_guard lock{mutex_};
    const auto found = records_.find(person);
    return found == records_.end() ? std::string{} : found->second.tokenHash;
}

void PersonBook::restore(std::uint32_t person, const std::string& name,
                         const std::string& tokenHash, std::uint32_t number,
                         const std::string& view, TimePoint until) {
    const std::lock_guard lock{mutex_};
    lastPerson_ = std::max(lastPerson_, person);
    Record& record = records_[person];
    record.name = name;
    record.tokenHash = tokenHash;
    record.views[number] = view;
    record.until = until;
}

void PersonBook::expire(TimePoint now) {
    const std::lock_guard lock{mutex_};
    std::erase_if(records_, [now](const auto& one) { return one.second.until <= now; });
}

}  // namespace volcast::session
