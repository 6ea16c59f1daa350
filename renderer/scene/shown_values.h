#pragma once

#include "renderer/data/dataset.h"
#include "renderer/plan/plan.h"
#include "renderer/scene/scene.h"
#include "renderer/volume/empty_space.h"

namespace volcast::scene {

/// The values between which `map` has extinction; those of its points are of the last of equal
/// ones.
volume::ShownValues absorbingValues(const data::TransferFunction& map);

/// The values of a voxel layer's field that can show, as rays see them: those with extinction
/// (volume, xray), levels (isosurface), all (others), as far as they are in the layer's interval.
volume::ShownValues shownValues(const Layer& layer, const plan::LayerPlan& plan,
                                const data::DatasetSummary& summary);

}  // namespace volcast::scene
