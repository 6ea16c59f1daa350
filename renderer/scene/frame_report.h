#pragma once

#include <vector>

#include "renderer/scene/frame.h"
#include "renderer/scene/render.h"

namespace volcast::scene {

/// The orders of layers that need one, as last drawn.
std::vector<LayerOrder> ordersOf(const Frame& frame);

/// What the draws of meshes took; the frame must count steps.
std::vector<LayerSteps> stepsOf(const Frame& frame);

/// The bricks of layers that are drawn from them, as last drawn.
std::vector<LayerBricks> bricksOf(const Frame& frame);

/// Which bricks are drawn becomes a part of why there are any.
void tellBricks(const LayerBricks& bricks, plan::FramePlan& frame);

/// How cells were put in order becomes a part of why they were.
void tellOrder(const LayerOrder& order, plan::FramePlan& frame);

}  // namespace volcast::scene
