#pragma once

#include <optional>

#include "renderer/mesh/locate.h"
#include "renderer/mesh/mesh_buffers.h"
#include "renderer/mesh/shared.h"
#include "renderer/scene/camera.h"

namespace volcast::mesh {

/// The block of a camera that sees a mesh; see shaders/shared/mesh_block.glsl.
///
/// `origin` is the mesh's; `planeDepth` in world units; `start` where the eye is inside a cell.
shared::MeshBlock viewBlock(const MeshBuffers& mesh, const glm::dvec3& origin,
                            const scene::Camera& camera, double planeDepth, glm::ivec2 size,
                            const std::optional<Place>& start, const glm::ivec4& startVertices);

}  // namespace volcast::mesh
