#pragma once

#include <string>

#include "renderer/base/result.h"
#include "renderer/scene/user_shader.h"
#include "renderer/user_shader/control.h"

namespace volcast::scene {

/// `control` with `state` as its initial value.
///
/// Errors: kInvalidArgument (another kind, or outside of what the control allows), with `path`.
Result<user_shader::Control> withState(const user_shader::Control& control,
                                       const ControlState& state, const std::string& path);

}  // namespace volcast::scene
