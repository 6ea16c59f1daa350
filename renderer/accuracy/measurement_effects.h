#pragma once

#include <string>
#include <vector>

#include "renderer/scene/scene.h"

namespace volcast::accuracy {

/// A scene as it is but for one effect of one layer, so that drawing both tells what it takes.
struct WithoutEffect {
    std::string layer;   ///< Its id.
    std::string effect;  ///< As plans name it.
    scene::Scene scene;
};

/// All effects that the settings of visible layers ask for and that can be left out of a scene;
/// whether they are on is the plan's matter. Layers that run code have none.
std::vector<WithoutEffect> withoutEffects(const scene::Scene& scene);

}  // namespace volcast::accuracy
