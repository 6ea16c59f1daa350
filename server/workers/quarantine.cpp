#include "server/workers/quarantine.h"

#include <algorithm>

#include "renderer/scene/user_controls.h"

namespace volcast::workers {

void Quarantine::add(const scene::Scene& scene) {
    for (const scene::Layer& layer : scene.layers) {
        const std::string& code = layer.shader.code;
        if (!scene::runsUserCode(layer) || std::ranges::find(codes_, code) != codes_.end())
            continue;
        if (codes_.size() == kMost) codes_.pop_front();
        codes_.push_back(code);
    }
}

bool Quarantine::holds(const scene::Scene& scene) const {
    return std::ranges::any_of(scene.layers, [this](const scene::Layer& layer) {
        return std::ranges::find(codes_, layer.shader.code) != codes_.end();
    });
}

}  // namespace volcast::workers
