#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "server/session/frame_flow.h"
#include "server/session/link.h"

namespace volcast::session {

/// Who is connected, or was and may come back: a person has a number, a name, open views, and a
/// secret token that lets the next connection go on where this one ended. Tokens are good once: one
/// that was used stays good only until its connection shows that the next one reached it.
///
/// Any thread.
class PersonBook {
public:
    static constexpr std::size_t kMostPeople = 10'000;

    /// Of more than `mostPeople`, those who are away go: first those without a view, and of these
    /// who is away for longest.
    explicit PersonBook(LinkKey key, std::size_t mostPeople = kMostPeople)
        : key_{key}, mostPeople_{mostPeople} {}

    /// A connection as the book knows it.
    struct Arrival {
        std::uint32_t person = 0;
        std::string name = {};
        std::string token = {};   ///< For the next connection.
        std::uint64_t visit = 0;  ///< Unique to this connection.
        std::map<std::uint32_t, std::string> views =
            {};  ///< Ids of open ones by the client's numbers.
    };
    /// Somebody new. `replaced` is called, under a lock, when another connection goes on instead.
    Result<Arrival> arrive(std::string name, std::function<void()> replaced);
    /// Somebody who was here. Errors: kInvalidArgument for a token that is unknown, was used, or
    /// is too old.
    Result<Arrival> resume(const std::string& token, std::function<void()> replaced, TimePoint now);
    /// The connection of `visit` has its new token: the one that it came with is good no more.
    void welcomed(std::uint32_t person, std::uint64_t visit);
    /// The connection of `visit` ended; its token is good until `until`.
    void lost(std::uint32_t person, std::uint64_t visit, TimePoint until);

    /// The name that the person has from now on; `name`, or that of a guest where it is empty.
    std::string rename(std::uint32_t person, std::string name);
    void opened(std::uint32_t person, std::uint32_t number, const std::string& view);
    void closed(std::uint32_t person, std::uint32_t number);

    /// What to save of a person: a hash of the token, useless without the key. Empty: unknown.
    [[nodiscard]] std::string tokenHash(std::uint32_t person) const;
    [[nodiscard]] std::size_t size() const;
    /// Somebody of a run of the server before this one. `person` is not given to others.
    void restore(std::uint32_t person, const std::string& name, const std::string& tokenHash,
                 std::uint32_t number, const std::string& view, TimePoint until);
    /// Forgets those who did not come back.
    void expire(TimePoint now);

private:
    struct Record {
        std::string name;
        std::string tokenHash;
        std::string usedHash = {};  ///< Of the token that it came with; empty once welcomed().
        std::map<std::uint32_t, std::string> views;
        std::uint64_t visit = 0;
        std::function<void()> replaced = {};  ///< Empty: not connected.
        TimePoint until = TimePoint::max();
    };
    [[nodiscard]] std::string hashOf(const std::string& token) const;
    using Records = std::map<std::uint32_t, Record>;
    Result<Arrival> enter(std::uint32_t person, Record& record, std::function<void()> replaced);
    void makeRoom();
    Records::iterator erase(Records::iterator record);

    const LinkKey key_;
    const std::size_t mostPeople_;
    mutable std::mutex mutex_;
    Records records_;
    std::map<std::string, std::uint32_t> byHash_;  ///< Of all tokens that are good, whose they are.
    std::uint32_t lastPerson_ = 0;
    std::uint64_t lastVisit_ = 0;
};

}  // namespace volcast::session
