#pragma once

#include "renderer/plan/plan.h"

namespace volcast::plan {

/// Finds layers of one mesh that one walk can draw, and says so in their plans: isosurfaces of one
/// field join each other, or the only layer that is not opaque where that is a volume of the same
/// field. A joined layer's `drawnWith` names the layer that draws it.
void shareWalks(const scene::Scene& scene, FramePlan& frame);

}  // namespace volcast::plan
