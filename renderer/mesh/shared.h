#pragma once

#include <glm/glm.hpp>

/// What C++ and the mesh shaders both read.
namespace volcast::mesh::shared {

using glm::dvec4;
using glm::ivec4;
using glm::vec4;

#include "shaders/shared/mesh_bindings.glsl"
#include "shaders/shared/mesh_block.glsl"

}  // namespace volcast::mesh::shared
