#pragma once

#include <string>
#include <string_view>

#include "renderer/scene/camera.h"

namespace volcast::commands {

/// Reads {"eye": [x, y, z], "center": [...], "up": [...], "fovy": degrees, "near": n, "far": f}.
///
/// `near` and `far` are accepted and have no effect: nothing is clipped. Optional are also
/// "projection" ("perspective" or "orthographic") and "orthographic_height" in world units.
/// Errors: kInvalidArgument naming the key.
Result<scene::Camera> parseCamera(std::string_view json);

}  // namespace volcast::commands
