#pragma once

#include <string>
#include <vector>

#include "renderer/scene/scene.h"

namespace volcast::scene {

/// What changed in one layer; each flag has a fixed cost on the GPU.
struct LayerDiff {
    std::string id;
    bool added = false;     ///< New, or its dataset is another.
    bool field = false;     ///< Field or time step: one buffer or texture.
    bool map = false;       ///< Transfer function: one table.
    bool program = false;   ///< Ray model, integrator, sampling, colouring: another shader.
    bool uniforms = false;  ///< Numbers that fit the parameter block.
};

/// The difference of two scenes; empty where nothing has to be drawn again.
struct SceneDiff {
    bool camera = false;
    bool background = false;
    bool order = false;             ///< Layers moved in the list, removed or hidden.
    std::vector<LayerDiff> layers;  ///< Only layers with a change.

    [[nodiscard]] bool empty() const noexcept {
        return !camera && !background && !order && layers.empty();
    }
};

SceneDiff diff(const Scene& before, const Scene& after);

}  // namespace volcast::scene
