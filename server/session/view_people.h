#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "renderer/scene/scene.h"
#include "server/session/frame_flow.h"
#include "volcast/v1/session.pb.h"

namespace volcast::session {

/// Names a viewer in its view.
using ViewerId = std::uint64_t;

/// Somebody in a view.
struct Member {
    std::uint32_t person = 0;  ///< In the whole server.
    std::string name = {};
    v1::Role role = v1::ROLE_WATCH;
    std::uint32_t number = 0;                 ///< The client's own for the view.
    scene::PictureSize size{512, 512};        ///< Of the client's pictures.
    std::optional<TimePoint> awayUntil = {};  ///< The connection was lost; forgotten then.
    bool asks = false;                        ///< Would like to steer.
};

/// Who is in a view, and who of them steers: one at a time, as long as somebody may.
///
/// Not thread-safe; the view's lock guards it.
class ViewPeople {
public:
    void add(ViewerId id, Member member);
    void remove(ViewerId id);
    void steer(ViewerId id) { steers_ = id; }
    void away(ViewerId id, TimePoint until) { members_.at(id).awayUntil = until; }
    /// The connection that was lost came back as `id`; the one it was before, or nothing.
    std::optional<ViewerId> find(std::uint32_t person, std::uint32_t number) const;
    void comeBack(ViewerId before, ViewerId id);
    /// Removes who is away for too long; true where somebody was.
    bool expire(TimePoint now);
    [[nodiscard]] std::optional<TimePoint> firstExpiry() const;
    /// Removes who is away for longest and does not steer; false where nobody is.
    bool removeOneAway();

    [[nodiscard]] bool steers(ViewerId id) const noexcept { return id == steers_; }
    /// 0: nobody.
    [[nodiscard]] ViewerId steering() const noexcept { return steers_; }
    [[nodiscard]] Member& at(ViewerId id) { return members_.at(id); }
    [[nodiscard]] const Member& at(ViewerId id) const { return members_.at(id); }
    [[nodiscard]] const std::map<ViewerId, Member>& all() const noexcept { return members_; }
    /// Empty where `id` may take control, else why not.
    std::string take(ViewerId id);
    /// Empty where control went to `person`, else why not.
    std::string handOver(ViewerId from, std::uint32_t person);
    /// Empty where `id` asks to steer from now on, or no more; else why not.
    std::string ask(ViewerId id, bool withdraw);
    /// Why `id` may not change the scene; empty where it steers.
    [[nodiscard]] std::string whyNotSteering(ViewerId id) const;

    [[nodiscard]] v1::People message(std::uint32_t number) const;

private:
    /// Somebody who is here and may steer does, where nobody does.
    void fill();
    void giveTo(ViewerId id);
    // In all places of the person.
    void letControl(std::uint32_t person);
    void askNoMore(std::uint32_t person);

    std::map<ViewerId, Member> members_;
    ViewerId steers_ = 0;  ///< 0: nobody.
};

}  // namespace volcast::session
