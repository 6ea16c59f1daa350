#pragma once

#include <string>
#include <vector>

#include "renderer/base/result.h"
#include "renderer/scene/user_shader.h"

namespace volcast::commands {

/// The code in `file` and the states that `controls` gives, each as NAME=VALUE:
///   slider 0.5; color red or #rrggbb; checkbox true; select an option's label or value;
///   invlerp [FROM, TO]; transferFunction [[VALUE, "#rrggbb", OPACITY], ...].
///
/// Errors: kIo; kInvalidArgument with the lines of `file`; kNotFound, kInvalidArgument for a
/// control.
Result<scene::UserShader> shaderFrom(const std::string& file,
                                     const std::vector<std::string>& controls);

}  // namespace volcast::commands
