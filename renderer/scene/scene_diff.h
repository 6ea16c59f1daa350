#pragma once

#include <string>
#include <vector>

#include "renderer/scene/scene.h"

namespace volcast::scene {

/// What changed in one layer; each flag has a fixed cost on the GPU.
struct LayerDiff {
    std::string id;
    bool added = false;     ///< New, or its dataset is another.
    bool field = false;     ///< Fields, scales or time step: one buffer or texture each.
    bool cells = false;     ///< Which cells are drawn: a mesh of its own.
    bool map = false;       ///< Transfer functions, levels: one table each.
    bool program = false;   ///< Ray model, integrator, sampling, colouring: another shader.
    bool uniforms = false;  ///< Numbers that fit the parameter block.

    [[nodiscard]] bool any() const noexcept {
        return added || field || cells || map || program || uniforms;
    }
};

/// The difference of two scenes; empty where nothing has to be drawn again.
struct SceneDiff {
    bool camera = false;
    bool background = false;
    bool clipping = false;          ///< Clip planes: numbers in the parameter block.
    bool accuracy = false;          ///< May change integrators.
    bool order = false;             ///< Layers moved in the list, removed or hidden.
    std::vector<LayerDiff> layers;  ///< Only layers with a change.

    [[nodiscard]] bool empty() const noexcept {
        return !camera && !background && !clipping && !accuracy && !order && layers.empty();
    }
};

SceneDiff diff(const Scene& before, const Scene& after);

}  // namespace volcast::scene
