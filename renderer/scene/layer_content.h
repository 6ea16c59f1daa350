#pragma once

#include <span>

#include "renderer/plan/plan.h"
#include "renderer/scene/map_texels.h"
#include "renderer/scene/scene.h"

namespace volcast::scene {

/// What the programs of `layer` look up, as its plan says: maps, levels, sections. `layers`: all of
/// the scene, some of which it may draw too; their plans are in `plans`.
MapContent layerContent(const Layer& layer, const plan::LayerPlan& plan,
                        std::span<const Layer> layers, std::span<const plan::LayerPlan> plans,
                        const data::DatasetSummary& summary);

}  // namespace volcast::scene
