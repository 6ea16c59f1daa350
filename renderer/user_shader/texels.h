#pragma once

#include <vector>

#include "renderer/user_shader/control.h"
#include "renderer/user_shader/generate.h"

namespace volcast::user_shader {

/// Numbers of a program that are no controls.
struct ProgramNumbers {
    double referencesAWorldUnit = 1.0;  ///< Reference distances, times e^gain.
    double intervalShift = 0.0;         ///< What the layer's interval has been shifted by.
};

/// What shaders/user/controls.glsl reads: the controls as they are now, laid out as it says.
std::vector<glm::vec4> controlTexels(const std::vector<Control>& controls, ValueType type,
                                     const ProgramNumbers& numbers);

}  // namespace volcast::user_shader
