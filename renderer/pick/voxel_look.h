#pragma once

#include <optional>

#include "renderer/data/volume.h"
#include "renderer/pick/look.h"

namespace volcast::pick {

/// What a layer of voxels shows on `ray` within `span`, by samples where the march takes them:
/// equal steps of at most `stepWorld`. Nothing where it shows nothing.
std::optional<Look> lookAt(const data::Volume& volume, const scene::Layer& layer, double stepWorld,
                           const reference::Ray& ray, const reference::Span& span);

}  // namespace volcast::pick
