#include "renderer/scene/layer_block.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/scene/layer_fields.h"
#include "renderer/scene/scale.h"

namespace volcast::scene {
namespace {

constexpr double kPi = 3.14159265358979323846;

glm::vec4 vector(const glm::dvec3& v, double w = 0.0) {
    return {glm::vec3(v), w};
}

/// Rows of a matrix, turned into GL's columns.
glm::mat4 fromRows(const glm::dvec4& x, const glm::dvec4& y, const glm::dvec4& z,
                   const glm::dvec4& w) {
    const glm::dmat4 matrix = glm::transpose(glm::dmat4(x, y, z, w));
    return {matrix};
}

glm::mat4 clipFromData(const Camera& camera, const CameraFrame& axes, const glm::dvec2& half,
                       const DepthRange& depths, const glm::dvec3& eye) {
    const auto row = [&](const glm::dvec3& axis, double scale) {
        return glm::dvec4(axis * scale, -glm::dot(axis, eye) * scale);
    };
    const glm::dvec4 right = row(axes.right, 1.0 / half.x), up = row(axes.up, 1.0 / half.y);
    const glm::dvec4 depth = row(axes.forward, 1.0);
    if (camera.projection == Projection::kPerspective) {
        // Infinite and reversed: clip z / w = near / depth.
        const double near = std::max(depths.nearest * 0.99, depths.farthest * 1e-6);
        return fromRows(right, up, {0.0, 0.0, 0.0, near}, depth);
    }
    const double span = depths.farthest - depths.nearest;
    const glm::dvec4 reversed = (glm::dvec4(0.0, 0.0, 0.0, depths.farthest) - depth) / span;
    return fromRows(right, up, reversed, {0.0, 0.0, 0.0, 1.0});
}

glm::mat4 gridFromData(const data::Volume& volume) {
    const glm::dmat3 axes = volume.direction;
    glm::dmat4 matrix{1.0};
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < 3; ++i) matrix[i][axis] = axes[axis][i] / volume.spacing[axis];
    }
    return {matrix};
}

/// Numbers of single ray models, and the interval in the values that rays carry.
glm::vec4 gather(const Layer& layer, const data::DatasetSummary& summary) {
    glm::vec4 numbers{layer.extinctionScale, std::exp2(layer.exposure), 0.0F, 0.0F};
    const data::FieldSummary* field = findField(summary, layer.field);
    if (!layer.interval || field == nullptr) return numbers;
    const ScaleFunction scale{layer.scale, field->range};
    numbers.z = scale.ofPoint(layer.interval->min);
    numbers.w = scale.ofPoint(layer.interval->max);
    return numbers;
}

/// Where the planes meet, in grid coordinates, and which of them are shown.
glm::vec4 sections(const CrossSections& planes, const data::Volume& volume) {
    const int shown =
        (planes.shown.x ? 1 : 0) + (planes.shown.y ? 2 : 0) + (planes.shown.z ? 4 : 0);
    return vector(meetingPoint(planes, volume), shown);
}

}  // namespace

glm::dvec2 halfExtent(const Camera& camera, PictureSize size) {
    const double half = camera.projection == Projection::kPerspective
                            ? std::tan(0.5 * camera.fovyDegrees * kPi / 180.0)
                            : 0.5 * camera.orthographicHeight;
    return {half * size.x / size.y, half};
}

glm::dvec3 meetingPoint(const CrossSections& planes, const data::Volume& volume) {
    const glm::dvec3 last(volume.size - 1);
    const glm::dvec3 meet =
        planes.point
            ? (glm::transpose(volume.direction) * (*planes.point - volume.origin)) / volume.spacing
            : 0.5 * last;
    return glm::clamp(meet, glm::dvec3(0.0), last);
}

DepthRange depthRange(const Camera& camera, std::span<const data::Box> boxes) {
    const CameraFrame axes = frame(camera);
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
    for (const data::Box& box : boxes) {
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 point((corner & 1) != 0 ? box.max.x : box.min.x,
                                   (corner & 2) != 0 ? box.max.y : box.min.y,
                                   (corner & 4) != 0 ? box.max.z : box.min.z);
            const double depth = glm::dot(point - camera.eye, axes.forward);
            nearest = std::min(nearest, depth);
            farthest = std::max(farthest, depth);
        }
    }
    if (!(farthest > 0.0)) return {};
    // A hair before the first corner, so that its own rounding is no hole.
    const double margin = 1e-6 * (farthest - std::max(nearest, 0.0)) + 1e-12 * farthest;
    nearest = std::max(nearest - margin, 0.0);
    return {.nearest = nearest, .farthest = std::max(farthest + margin, nearest + margin)};
}

LayerBlock layerBlock(PictureSize size, const DepthRange& depths, const Scene& scene,
                      const Layer& layer, const data::Dataset& dataset,
                      const data::DatasetSummary& summary, double stepWorld) {
    const Camera& camera = scene.camera;
    const data::Volume* volume = std::get_if<data::Volume>(&dataset);
    const glm::dvec3 origin =
        volume != nullptr ? volume->origin : std::get<data::Mesh>(dataset).origin;
    const CameraFrame axes = frame(camera);
    const glm::dvec2 half = halfExtent(camera, size);
    const glm::dvec3 eye = camera.eye - origin;
    const bool perspective = camera.projection == Projection::kPerspective;
    const double startScale = perspective ? depths.nearest : 1.0;
    const double directionScale = perspective ? 1.0 : 0.0;
    LayerBlock block{};
    block.rayStart = vector(eye + depths.nearest * axes.forward, depths.nearest);
    block.rayStartRight = vector(axes.right * (half.x * startScale));
    block.rayStartUp = vector(axes.up * (half.y * startScale));
    block.rayDirection = vector(axes.forward, perspective ? 1.0 : 0.0);
    block.rayDirectionRight = vector(axes.right * (half.x * directionScale));
    block.rayDirectionUp = vector(axes.up * (half.y * directionScale));
    block.viewport = {size.x, size.y, 1.0F / static_cast<float>(size.x),
                      1.0F / static_cast<float>(size.y)};
    block.clipFromData = clipFromData(camera, axes, half, depths, eye);
    block.gridFromData = volume != nullptr ? gridFromData(*volume) : glm::mat4(1.0F);
    block.grid = glm::vec4(volume != nullptr ? glm::vec3(volume->size) : glm::vec3(0), stepWorld);
    if (volume != nullptr) block.sections = sections(layer.crossSections, *volume);
    block.surfaceColour = glm::vec4(layer.surfaceColour, 1.0F);
    block.edge = glm::vec4(layer.edgeColour, layer.edgeWidth);
    block.gather = gather(layer, summary);
    for (std::size_t i = 0; i < scene.clipPlanes.size(); ++i) {
        const ClipPlane& plane = scene.clipPlanes[i];
        const double length = glm::length(plane.normal);
        const glm::dvec3 normal = plane.normal / length;
        block.clipPlanes[i] = vector(normal, plane.offset / length - glm::dot(normal, origin));
    }
    const Light light = layer.light.value_or(Light{});
    block.light = light.position ? vector(*light.position - origin, 1.0) : glm::vec4(0.0F);
    const std::uint32_t seed = layer.jitter.value_or(0);
    block.jitter = {seed & 0xFFFFU, seed >> 16U, 0.0F, 0.0F};
    block.reflection = {light.ambient, light.diffuse, light.specular, light.exponent};
    return block;
}

}  // namespace volcast::scene
