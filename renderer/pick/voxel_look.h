#pragma once

#include <optional>

#include "renderer/data/volume.h"
#include "renderer/pick/look.h"

namespace volcast::pick {

/// Where a march takes its samples: in equal steps of at most `world`, at `share` of each.
struct Steps {
    double world = 0.0;
    double share = 0.5;
};

/// What a layer of voxels shows on `ray` within `span`, by samples where the march takes them.
/// Nothing where it shows nothing.
std::optional<Look> lookAt(const data::Volume& volume, const scene::Layer& layer, Steps wanted,
                           const reference::Ray& ray, const reference::Span& span);

}  // namespace volcast::pick
