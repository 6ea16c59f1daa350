#include "renderer/reference/voxel_layer.h"

#include <algorithm>
#include <cmath>

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
    switch (layer.model) {
        case scene::RayModel::kVolume: {
            LightAt light;
            if (layer.light) light = lightOn(*data.grid, ray, *layer.light);
            return volume(pieces, {.colour = &data.colour, .extinction = &data.extinction}, light);
        }
        case scene::RayModel::kXray: {
            const double depth = opticalDepth(pieces, data.extinction);
            return {glm::dvec3{std::exp(-layer.extinctionScale * depth)}, 1.0};
        }
        case scene::RayModel::kSplat:
            return {std::exp2(static_cast<double>(layer.exposure)) *
                        colourIntegral(pieces, data.colour),
                    0.0};
        case scene::RayModel::kMipColour: {
            const auto largest = largestColour(pieces, data.colour);
            return largest ? glm::dvec4{*largest, 1.0} : glm::dvec4{0.0};
        }
        case scene::RayModel::kMip:
        case scene::RayModel::kMinip: {
            const auto found = extremes(pieces);
            if (!found) return glm::dvec4{0.0};
            const bool max = layer.model == scene::RayModel::kMip;
            return {glm::dvec3{data.colour.at(max ? found->max : found->min)}, 1.0};
        }
        case scene::RayModel::kCrossSections:
        case scene::RayModel::kSurface:
        case scene::RayModel::kWireframe:
        case scene::RayModel::kIsosurface: break;
    }
    return glm::dvec4{0.0};
}

}  // namespace volcast::reference
