#pragma once

#include <cstdint>

#include "renderer/base/result.h"
#include "renderer/scene/render.h"

namespace volcast::worker {

/// Ray models that are warmed up one after the other.
inline constexpr std::uint32_t kWarmUpSteps = 5;

/// Draws a tiny mesh or volume once with the ray model of `step` and forgets it again: its shaders
/// are built and in the driver's cache, and no real frame waits for them.
///
/// Errors: as scene::Renderer::render.
Result<void> warmUp(scene::Renderer& renderer, std::uint32_t step);

}  // namespace volcast::worker
