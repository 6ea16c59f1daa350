#pragma once

#include "renderer/base/result.h"
#include "renderer/scene/render.h"

namespace volcast::worker {

/// Draws a tiny mesh and a tiny volume once with each ray model and forgets them again: shaders
/// are built, the driver's compiler is loaded, and the first real frame waits for none of it.
///
/// Errors: as scene::Renderer::render; a device that fails here cannot draw at all.
Result<void> warmUp(scene::Renderer& renderer);

}  // namespace volcast::worker
