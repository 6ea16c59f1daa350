#include "renderer/mesh/view_block.h"

#include <cmath>
#include <numbers>

namespace volcast::mesh {

shared::MeshBlock viewBlock(const MeshBuffers& mesh, const glm::dvec3& origin,
                            const scene::Camera& camera, double planeDepth, glm::ivec2 size,
                            const std::optional<Place>& start, const glm::ivec4& startVertices) {
    const bool perspective = camera.projection == scene::Projection::kPerspective;
    const scene::CameraFrame axes = scene::frame(camera);
    const glm::dvec3 eye = start ? start->point : camera.eye - origin;
    const double scale = mesh.scale;
    const auto axis = [&](const glm::dvec3& direction, double before) {
        return glm::dvec4{direction * scale, (-glm::dot(direction, eye) - before) * scale};
    };
    const double halfHeight = perspective ? std::tan(camera.fovyDegrees * std::numbers::pi / 360.0)
                                          : 0.5 * camera.orthographicHeight * scale;
    const glm::dvec2 half{halfHeight * size.x / size.y, halfHeight};
    const double plane = planeDepth * scale;

    shared::MeshBlock block{};
    block.right = axis(axes.right, 0.0);
    block.up = axis(axes.up, 0.0);
    block.forward = axis(axes.forward, planeDepth);
    const double worldPerDepth = 1.0 / scale;
    if (perspective) {
        block.raySlope = glm::vec4{half, worldPerDepth, 0.0};
        block.rayOffset = glm::vec4{half * plane, 0.0, 0.0};
        block.raster = glm::vec4{1.0 / half, 1.0, plane};
    } else {
        block.raySlope = glm::vec4{0.0, 0.0, worldPerDepth, 0.0};
        block.rayOffset = glm::vec4{half, 0.0, 0.0};
        block.raster = glm::vec4{1.0 / half, 0.0, 1.0};
    }
    block.startVertices = startVertices;
    block.start = {start ? start->cell : -1, mesh.vertexCount, 0, 0};
    return block;
}

}  // namespace volcast::mesh
