#pragma once

#include <cmath>

#include "renderer/reference/gather.h"
#include "renderer/reference/layer_data.h"
#include "renderer/reference/voxel_gather.h"

namespace volcast::reference {

/// What a layer that ends no rays shows of the pieces of a ray, in any model but volume. `scratch`:
/// what the functions that gather from such pieces take besides.
template <class Pieces, class... Scratch>
glm::dvec4 shownWithoutVolume(const LayerData& data, const Pieces& pieces, Scratch&... scratch) {
    const scene::Layer& layer = *data.layer;
    switch (layer.model) {
        case scene::RayModel::kXray: {
            const double depth = opticalDepth(pieces, data.extinction, scratch...);
            return {glm::dvec3{std::exp(-layer.extinctionScale * depth)}, 1.0};
        }
        case scene::RayModel::kSplat:
            return {std::exp2(static_cast<double>(layer.exposure)) *
                        colourIntegral(pieces, data.colour, scratch...),
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
        case scene::RayModel::kVolume:
        case scene::RayModel::kCrossSections:
        case scene::RayModel::kSurface:
        case scene::RayModel::kWireframe:
        case scene::RayModel::kIsosurface: break;
    }
    return glm::dvec4{0.0};
}

}  // namespace volcast::reference
