#pragma once

#include "renderer/base/result.h"
#include "renderer/scene/picked.h"
#include "renderer/scene/scene.h"
#include "volcast/internal/v1/worker.pb.h"
#include "volcast/v1/session.pb.h"

namespace volcast::worker {

/// A pixel of a picture of a scene, to be picked.
struct PickJob {
    scene::Scene scene;
    scene::PictureSize size{0};
    glm::ivec2 pixel{0};
};

/// All but the request's number.
internal::v1::Pick toMessage(const PickJob& job);
/// Errors: as sceneFrom().
Result<PickJob> jobFrom(const internal::v1::Pick& message);

/// The place alone; without one the message is empty.
v1::Picked toMessage(const std::optional<scene::Picked>& picked);
std::optional<scene::Picked> pickedFrom(const v1::Picked& message);

}  // namespace volcast::worker
