#pragma once

#include <functional>
#include <string_view>

#include "renderer/base/result.h"
#include "renderer/scene/scene.h"

namespace volcast::worker {

/// Reads a scene document (protobuf JSON of volcast.v1.Scene), as clients save it.
///
/// `defaults` yields, for a field name (may be empty), the layer whose dataset and, where the
/// document has none, transfer function are used.
/// Errors: kInvalidArgument (no JSON, unknown keys; says where), and as sceneFrom().
Result<scene::Scene> sceneFromJson(
    std::string_view text, const std::function<scene::Layer(const std::string& field)>& defaults);

}  // namespace volcast::worker
