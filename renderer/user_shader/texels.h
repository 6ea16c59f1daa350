#pragma once

#include <vector>

#include "renderer/user_shader/control.h"
#include "renderer/user_shader/generate.h"

namespace volcast::user_shader {

/// What shaders/user/controls.glsl reads: the controls as they are now, laid out as it says.
/// `referencesAWorldUnit`: reference distances a world unit, times e^gain.
std::vector<glm::vec4> controlTexels(const std::vector<Control>& controls, ValueType type,
                                     double referencesAWorldUnit);

}  // namespace volcast::user_shader
