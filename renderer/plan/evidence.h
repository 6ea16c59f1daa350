#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderer/scene/scene.h"

namespace volcast::plan {

/// What is known of one integrator for one layer of a scene.
struct Evidence {
    scene::Integrator integrator = scene::Integrator::kExact;
    std::optional<double> predictedMs = {};  ///< Of one picture, from costs measured before.
    std::optional<double> error = {};        ///< Largest, in 1/255, measured on a sample of pixels.
};

/// By layer id; layers that need none are left out.
using SceneEvidence = std::map<std::string, std::vector<Evidence>>;

}  // namespace volcast::plan
