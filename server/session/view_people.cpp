#include "server/session/view_people.h"

#include <algorithm>
#include <utility>

namespace volcast::session {

void ViewPeople::add(ViewerId id, Member member) {
    const std::uint32_t person = member.person;
    members_.insert_or_assign(id, std::move(member));
    // Who has the view open twice may do the same in both, whichever came first.
    const bool controls = std::ranges::any_of(members_, [person](const auto& one) {
        return one.second.person == person && one.second.role == v1::ROLE_CONTROL;
    });
    if (controls) letControl(person);
    fill();
}

void ViewPeople::letControl(std::uint32_t person) {
    for (auto& [id, member] : members_) {
        if (member.person == person) member.role = v1::ROLE_CONTROL;
    }
}

void ViewPeople::remove(ViewerId id) {
    members_.erase(id);
    if (steers_ == id) steers_ = 0;
    fill();
}

void ViewPeople::fill() {
    if (steers_ != 0) return;
    const auto next = std::ranges::find_if(members_, [](const auto& one) {
        return one.second.role == v1::ROLE_CONTROL && !one.second.awayUntil;
    });
    if (next != members_.end()) giveTo(next->first);
}

void ViewPeople::giveTo(ViewerId id) {
    steers_ = id;
    askNoMore(members_.at(id).person);
}

void ViewPeople::askNoMore(std::uint32_t person) {
    for (auto& [id, member] : members_) {
        if (member.person == person) member.asks = false;
    }
}

std::optional<ViewerId> ViewPeople::find(std::uint32_t person, std::uint32_t number) const {
    for (const auto& [id, member] : members_) {
        if (member.person == person && member.number == number) return id;
    }
    return std::nullopt;
}

void ViewPeople::comeBack(ViewerId before, ViewerId id) {
    Member member = std::move(members_.at(before));
    member.awayUntil.reset();
    members_.erase(before);
    members_.emplace(id, std::move(member));
    if (steers_ == before) steers_ = id;
    fill();
}

bool ViewPeople::expire(TimePoint now) {
    const std::size_t before = members_.size();
    std::erase_if(members_, [&](const auto& one) {
        return one.second.awayUntil && *one.second.awayUntil <= now;
    });
    if (members_.size() == before) return false;
    if (!members_.contains(steers_)) steers_ = 0;
    fill();
    return true;
}

std::optional<TimePoint> ViewPeople::firstExpiry() const {
    std::optional<TimePoint> first;
    for (const auto& [id, member] : members_) {
        if (member.awayUntil && (!first || *member.awayUntil < *first)) first = member.awayUntil;
    }
    return first;
}

bool ViewPeople::removeOneAway() {
    auto first = members_.end();
    for (auto one = members_.begin(); one != members_.end(); ++one) {
        if (!one->second.awayUntil || steers(one->first)) continue;
        if (first == members_.end() || *one->second.awayUntil < *first->second.awayUntil) {
            first = one;
        }
    }
    if (first == members_.end()) return false;
    members_.erase(first);
    return true;
}

std::string ViewPeople::take(ViewerId id) {
    if (members_.at(id).role != v1::ROLE_CONTROL) {
        return "you may watch this view but not steer it; somebody who steers may hand over to you";
    }
    giveTo(id);
    return {};
}

std::string ViewPeople::ask(ViewerId id, bool withdraw) {
    const std::uint32_t person = members_.at(id).person;
    if (withdraw) {
        askNoMore(person);
        return {};
    }
    const auto steers = members_.find(steers_);
    if (steers != members_.end() && steers->second.person == person) {
        return "you steer this view already";
    }
    members_.at(id).asks = true;
    return {};
}

std::string ViewPeople::handOver(ViewerId from, std::uint32_t person) {
    if (std::string why = whyNotSteering(from); !why.empty()) return why;
    const Member* away = nullptr;
    for (const auto& [id, member] : members_) {
        if (member.person != person) continue;
        if (member.awayUntil) {
            away = &member;
            continue;
        }
        letControl(person);
        giveTo(id);
        return {};
    }
    if (away != nullptr) return away->name + " is away";
    return "nobody in this view has the number " + std::to_string(person);
}

std::string ViewPeople::whyNotSteering(ViewerId id) const {
    if (steers_ == id) return {};
    if (members_.at(id).role != v1::ROLE_CONTROL) return "you may watch this view but not steer it";
    const auto steers = members_.find(steers_);
    const std::string name = steers == members_.end() ? "nobody" : steers->second.name;
    return name + " steers this view; take control first";
}

v1::People ViewPeople::message(std::uint32_t number) const {
    v1::People message;
    message.set_view(number);
    for (const auto& [id, member] : members_) {
        v1::Person& person = *message.add_people();
        person.set_id(member.person);
        person.set_name(member.name);
        person.set_role(member.role);
        person.set_steers(id == steers_);
        person.set_away(member.awayUntil.has_value());
        person.set_asks(member.asks);
    }
    return message;
}

}  // namespace volcast::session
