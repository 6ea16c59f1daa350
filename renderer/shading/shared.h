#pragma once

#include <glm/glm.hpp>

/// What C++ and GLSL both read: structs of uniform blocks, binding numbers, constants.
namespace volcast::shading::shared {

using glm::mat4;
using glm::vec4;

#include "shaders/shared/bindings.glsl"
#include "shaders/shared/brick_pool.glsl"
#include "shaders/shared/layer_block.glsl"
#include "shaders/shared/psi_table.glsl"
#include "shaders/shared/slice_block.glsl"

}  // namespace volcast::shading::shared
