#pragma once

#include <glm/glm.hpp>

/// What C++ and GLSL both read: structs of uniform blocks and binding numbers.
namespace volcast::shading::shared {

using glm::mat4;
using glm::vec4;

#include "shaders/shared/bindings.glsl"
#include "shaders/shared/layer_block.glsl"

}  // namespace volcast::shading::shared
