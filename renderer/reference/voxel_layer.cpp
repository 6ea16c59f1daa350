#include "renderer/reference/voxel_layer.h"

#include <algorithm>
#include <cmath>

#include "renderer/reference/shown.h"

namespace volcast::reference {
namespace {

/// C (ambient + diffuse |n.l|) + specular |n.h|^exponent, as scene::Light has it.
LightAt lightOn(const VoxelGrid& grid, const Ray& ray, const scene::Light& light) {
    return [&grid, &ray, &light](double distance) {
        const glm::dvec3 at = ray.origin + distance * ray.direction;
        const glm::dvec3 normal = grid.normalAt(at);
        if (normal == glm::dvec3{0.0}) {
            return glm::dvec2{static_cast<double>(light.ambient) + light.diffuse, 0.0};
        }
        const glm::dvec3 towards =
            light.position ? glm::normalize(*light.position - at) : -ray.direction;
        const glm::dvec3 half = glm::normalize(towards - ray.direction);
        const double shine = std::min(std::abs(glm::dot(normal, half)), 1.0);
        return glm::dvec2{light.ambient + light.diffuse * std::abs(glm::dot(normal, towards)),
                          light.specular * std::pow(shine, light.exponent)};
    };
}

}  // namespace

double facingSlope(const VoxelGrid& grid, const Ray& ray, double distance) {
    const glm::dvec3 normal = grid.normalAt(ray.origin + distance * ray.direction);
    if (normal == glm::dvec3{0.0}) return 1.0;
    return std::min(std::abs(glm::dot(normal, ray.direction)), 1.0);
}

glm::dvec4 gathered(const LayerData& data, const Ray& ray, std::span<const VoxelPiece> pieces) {
    const scene::Layer& layer = *data.layer;
    if (layer.model != scene::RayModel::kVolume) return shownWithoutVolume(data, pieces);
    LightAt light;
    if (layer.light) light = lightOn(*data.grid, ray, *layer.light);
    return volume(pieces, {.colour = &data.colour, .extinction = &data.extinction}, light);
}

}  // namespace volcast::reference
