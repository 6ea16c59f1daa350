#pragma once

#include <limits>

#include "renderer/data/dataset.h"
#include "renderer/plan/plan.h"
#include "renderer/scene/channel_table.h"
#include "renderer/scene/scene.h"
#include "renderer/volume/empty_space.h"

namespace volcast::scene {

/// What layers show of which nothing is known.
inline const volume::ShownValues kAllValues{
    glm::vec2{-std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity()}};

/// The values between which `map` has extinction; those of its points are of the last of equal
/// ones.
volume::ShownValues absorbingValues(const data::TransferFunction& map);

/// The values of a voxel layer's field that can show, as rays see them: those with extinction
/// (volume, xray), levels (isosurface), all (others, and users' code), as far as they are in the
/// layer's interval.
volume::ShownValues shownValues(const Layer& layer, const plan::LayerPlan& plan,
                                const data::DatasetSummary& summary);

/// The same of one of several channels that are drawn together and absorb.
volume::ShownValues shownValues(const DrawnChannel& channel);

}  // namespace volcast::scene
