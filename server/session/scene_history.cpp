#include "server/session/scene_history.h"

#include <algorithm>
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

SceneHistory::Saved SceneHistory::save() const {
    const auto newest = [](const std::deque<ScenePtr>& steps) {
        const auto count = std::min(steps.size(), kMostSaved);
        return std::vector<ScenePtr>(steps.end() - static_cast<std::ptrdiff_t>(count), steps.end());
    };
    return {.undo = newest(undo_), .redo = newest(redo_)};
}

void SceneHistory::restore(const Saved& saved) {
    undo_.assign(saved.undo.begin(), saved.undo.end());
    redo_.assign(saved.redo.begin(), saved.redo.end());
    open_ = false;
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
