#include "server/session/person_book.h"

#include <algorithm>
#include <iterator>
#include <tuple>
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
    byHash_[record.tokenHash] = person;
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
    if (records_.size() >= mostPeople_) makeRoom();
    const std::uint32_t person = ++lastPerson_;
    Record& record = records_[person];
    record.name = nameOf(person, std::move(name));
    auto arrival = enter(person, record, std::move(replaced));
    if (!arrival) records_.erase(person);
    return arrival;
}

Result<PersonBook::Arrival> PersonBook::resume(const std::string& token,
                                               std::function<void()> replaced, TimePoint now) {
    const std::lock_guard lock{mutex_};
    // Looked up by a keyed hash: how long that takes tells nothing of other tokens.
    const std::string hash = hashOf(token);
    const auto known = byHash_.find(hash);
    const auto found = known == byHash_.end() ? records_.end() : records_.find(known->second);
    if (found == records_.end() || found->second.until <= now) {
        return fail(ErrorCode::kInvalidArgument,
                    "the resume token is unknown, was used already, or is too old", "hello.resume");
    }
    Record& record = found->second;
    // Only the token that came back and the one that is made now are good from here on.
    const std::string other = hash == record.tokenHash ? record.usedHash : record.tokenHash;
    const auto replacedBefore = record.replaced;
    auto arrival = enter(found->first, record, std::move(replaced));
    if (!arrival) return arrival;
    byHash_.erase(other);
    record.usedHash = hash;
    if (replacedBefore) replacedBefore();
    return arrival;
}

void PersonBook::welcomed(std::uint32_t person, std::uint64_t visit) {
    const std::lock_guard lock{mutex_};
    const auto found = records_.find(person);
    if (found == records_.end() || found->second.visit != visit) return;  // Went on elsewhere.
    byHash_.erase(std::exchange(found->second.usedHash, {}));
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
    byHash_.erase(record.tokenHash);
    record.tokenHash = tokenHash;
    byHash_[tokenHash] = person;
    record.views[number] = view;
    record.until = until;
}

std::size_t PersonBook::size() const {
    const std::lock_guard lock{mutex_};
    return records_.size();
}

void PersonBook::expire(TimePoint now) {
    const std::lock_guard lock{mutex_};
    for (auto one = records_.begin(); one != records_.end();) {
        one = one->second.until <= now ? erase(one) : std::next(one);
    }
}

void PersonBook::makeRoom() {
    // Who is connected has no `until` yet and is never less.
    const auto first = std::ranges::min_element(records_, {}, [](const auto& one) {
        const bool away = one.second.until != TimePoint::max();
        return std::tuple{!away, !one.second.views.empty(), one.second.until};
    });
    if (first != records_.end() && first->second.until != TimePoint::max()) erase(first);
}

PersonBook::Records::iterator PersonBook::erase(Records::iterator record) {
    byHash_.erase(record->second.tokenHash);
    byHash_.erase(record->second.usedHash);
    return records_.erase(record);
}

}  // namespace volcast::session
