#include "renderer/scene/cover.h"

#include <limits>

#include "renderer/scene/layer_block.h"

namespace volcast::scene {

PixelBox coverOf(const Camera& camera, PictureSize size, const data::Volume& volume,
                 const std::array<glm::vec3, 2>& box) {
    if (glm::any(glm::greaterThan(box[0], box[1]))) return {};
    const glm::dvec2 pixels{size.x, size.y};
    const CameraFrame axes = frame(camera);
    const bool perspective = camera.projection == Projection::kPerspective;
    const glm::dvec2 half = halfExtent(camera, size);
    glm::dvec2 low{std::numeric_limits<double>::infinity()}, high = -low;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 grid{box[corner & 1].x, box[corner >> 1 & 1].y, box[corner >> 2].z};
        const glm::dvec3 arm =
            volume.origin - camera.eye + volume.direction * (volume.spacing * grid);
        const double depth = perspective ? glm::dot(arm, axes.forward) : 1.0;
        if (!(depth > 0.0)) return {.low = {0, 0}, .size = {size.x, size.y}};
        const glm::dvec2 at{glm::dot(arm, axes.right), -glm::dot(arm, axes.up)};
        const glm::dvec2 pixel = (at / (depth * half) + 1.0) * 0.5 * pixels;
        low = glm::min(low, pixel);
        high = glm::max(high, pixel);
    }
    // One more to each side: shaders round. Corners close to the eye's plane lie far away.
    const glm::dvec2 first = glm::clamp(glm::floor(low) - 1.0, glm::dvec2{0.0}, pixels);
    const glm::dvec2 last = glm::clamp(glm::ceil(high) + 1.0, first, pixels);
    return {.low = first, .size = last - first};
}

}  // namespace volcast::scene
