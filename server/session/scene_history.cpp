#include "server/session/scene_history.h"

#include <utility>

namespace volcast::session {

void SceneHistory::changed(ScenePtr before, bool cameraOnly, TimePoint now) {
    const bool goesOn = open_ && cameraOnly == cameraOnly_ && now - lastChange_ < kPause;
    open_ = true;
    cameraOnly_ = cameraOnly;
    lastChange_ = now;
    redo_.clear();
    if (goesOn || !before) return;
    if (undo_.size() >= kMostSteps) undo_.pop_front();
    undo_.push_back(std::move(before));
}

SceneHistory::ScenePtr SceneHistory::step(std::deque<ScenePtr>& from, std::deque<ScenePtr>& to,
                                          ScenePtr current) {
    open_ = false;
    while (!from.empty()) {
        ScenePtr taken = std::move(from.back());
        from.pop_back();
        if (*taken == *current) continue;  // A change that was taken back by itself.
        to.push_back(std::move(current));
        return taken;
    }
    return nullptr;
}

}  // namespace volcast::session
