#include "renderer/pick/look.h"

#include <algorithm>

namespace volcast::pick {

double weightOf(scene::RayModel model, const Place& place) {
    switch (model) {
        case scene::RayModel::kMip: return place.f;
        case scene::RayModel::kMinip: return -place.f;
        case scene::RayModel::kMipColour:
        case scene::RayModel::kSplat:
            return std::max({place.colour.r, place.colour.g, place.colour.b});
        case scene::RayModel::kXray: return place.extinction;
        default: return place.through * place.extinction;
    }
}

bool showsNothing(scene::RayModel model, double weight) {
    const bool extreme = model == scene::RayModel::kMip || model == scene::RayModel::kMinip ||
                         model == scene::RayModel::kMipColour;
    return !extreme && !(weight > 0.0);
}

}  // namespace volcast::pick
