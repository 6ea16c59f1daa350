#pragma once

#include "renderer/data/dataset.h"
#include "renderer/plan/plan.h"
#include "renderer/scene/scene.h"
#include "renderer/volume/brick_tree.h"

namespace volcast::scene {

/// How a picture of `scene` samples the volume of `layer`, and which of its values can show.
volume::BrickView brickView(const Scene& scene, PictureSize size, const Layer& layer,
                            const plan::LayerPlan& plan, const data::Volume& volume,
                            const data::DatasetSummary& summary);

}  // namespace volcast::scene
