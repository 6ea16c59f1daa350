#pragma once

#include <optional>

#include "renderer/pick/look.h"

namespace volcast::pick {

/// What a layer of a mesh shows on `ray` within `span`; nothing where it shows nothing.
std::optional<Look> lookAt(const reference::LayerData& data, const reference::Ray& ray,
                           const reference::Span& span, reference::Scratch& scratch);

}  // namespace volcast::pick
