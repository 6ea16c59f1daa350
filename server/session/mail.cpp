#include "server/session/mail.h"

#include <algorithm>
#include <utility>

namespace volcast::session {

namespace {

bool supersedesOlder(v1::ServerMessage::BodyCase body) {
    return body == v1::ServerMessage::kSceneChanged || body == v1::ServerMessage::kPeople ||
           body == v1::ServerMessage::kAccuracyReport || body == v1::ServerMessage::kPicked;
}

/// A camera that follows a scene which was not read yet becomes that scene's.
void keepScene(v1::ServerMessage& older, v1::SceneChanged& newer) {
    if (newer.has_scene() || !older.scene_changed().has_scene()) return;
    *newer.mutable_scene() = std::move(*older.mutable_scene_changed()->mutable_scene());
    *newer.mutable_scene()->mutable_camera() = newer.camera();
    newer.clear_camera();
}

}  // namespace

void Mail::put(v1::ServerMessage message) {
    if (supersedesOlder(message.body_case())) {
        const auto older = std::ranges::find(waiting_, message.body_case(),
                                             [](const auto& one) { return one.body_case(); });
        if (older != waiting_.end()) {
            if (message.has_scene_changed()) keepScene(*older, *message.mutable_scene_changed());
            waiting_.erase(older);
        }
    }
    if (waiting_.size() >= kMost) waiting_.pop_front();
    waiting_.push_back(std::move(message));
}

std::optional<v1::ServerMessage> Mail::take() {
    if (waiting_.empty()) return std::nullopt;
    v1::ServerMessage first = std::move(waiting_.front());
    waiting_.pop_front();
    return first;
}

}  // namespace volcast::session
