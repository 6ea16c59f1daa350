#pragma once

#include <chrono>
#include <deque>
#include <memory>
#include <vector>

#include "renderer/scene/scene.h"
#include "server/session/frame_flow.h"

namespace volcast::session {

/// The scenes that a view showed before, and those that were gone back from; the oldest are
/// forgotten.
///
/// Changes of one kind that follow each other within kPause are one step: a drag of the mouse, or
/// of a point of a transfer function.
class SceneHistory {
public:
    using ScenePtr = std::shared_ptr<const scene::Scene>;
    static constexpr std::size_t kMostSteps = 100;
    static constexpr std::chrono::milliseconds kPause{500};

    /// An update replaced `before`.
    void changed(ScenePtr before, bool cameraOnly, TimePoint now);
    [[nodiscard]] bool canUndo() const noexcept { return !undo_.empty(); }
    [[nodiscard]] bool canRedo() const noexcept { return !redo_.empty(); }
    /// The newest kMostSaved steps of each, the next one last.
    struct Saved {
        std::vector<ScenePtr> undo, redo;
    };
    static constexpr std::size_t kMostSaved = 20;
    [[nodiscard]] Saved save() const;
    void restore(const Saved& saved);
    /// The scene to go back to, or forward to, from `current`; null where there is none.
    ScenePtr undo(ScenePtr current) { return step(undo_, redo_, std::move(current)); }
    ScenePtr redo(ScenePtr current) { return step(redo_, undo_, std::move(current)); }

private:
    ScenePtr step(std::deque<ScenePtr>& from, std::deque<ScenePtr>& to, ScenePtr current);

    std::deque<ScenePtr> undo_, redo_;
    bool open_ = false;  ///< The newest step may go on.
    bool cameraOnly_ = false;
    TimePoint lastChange_{};
};

}  // namespace volcast::session
