#pragma once

#include <deque>
#include <optional>

#include "volcast/v1/session.pb.h"

namespace volcast::session {

/// What a viewer is to be told and has not read. Of news that supersede older ones the newest
/// alone is kept, so that a slow reader gets the state of things and not their history.
class Mail {
public:
    static constexpr std::size_t kMost = 64;  ///< Then the oldest go.

    void put(v1::ServerMessage message);
    std::optional<v1::ServerMessage> take();
    [[nodiscard]] bool empty() const noexcept { return waiting_.empty(); }

private:
    std::deque<v1::ServerMessage> waiting_;
};

}  // namespace volcast::session
