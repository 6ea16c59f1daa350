#pragma once

#include <utility>

#include "server/session/session.h"

namespace volcast::session {

/// A function for other threads: brings its arguments to the session's strand and calls
/// act(session, arguments...) there, if the session still exists.
template <class Act>
auto Session::onStrand(Act act) {
    return [weak = weak_from_this(), post = hooks_.post, act](auto&&... values) {
        post([weak, act, ... values = std::forward<decltype(values)>(values)]() mutable {
            const auto self = weak.lock();
            if (!self) return;
            act(*self, std::move(values)...);
            self->hooks_.wake();
        });
    };
}

}  // namespace volcast::session
