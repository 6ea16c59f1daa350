#pragma once

#include <string>

#include "renderer/base/result.h"
#include "renderer/scene/user_shader.h"
#include "volcast/v1/scene.pb.h"

namespace volcast::worker {

/// Errors: kInvalidArgument, with the field at fault beneath `path` (a control without a value).
Result<scene::UserShader> userShaderFrom(const v1::UserShader& message, const std::string& path);

v1::UserShader toMessage(const scene::UserShader& shader);

}  // namespace volcast::worker
