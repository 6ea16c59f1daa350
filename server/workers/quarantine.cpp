#include "server/workers/quarantine.h"

#include <algorithm>

#include "renderer/base/printable.h"
#include "renderer/scene/user_controls.h"

namespace volcast::workers {
namespace {

bool runsCode(const scene::Layer& layer) {
    return layer.visible && scene::runsUserCode(layer);
}

/// The first line of a code that is not empty, for a human to recognise.
std::string firstLineOf(const std::string& code) {
    constexpr std::size_t kMostShown = 60;
    const std::size_t begin = code.find_first_not_of(" \t\r\n");
    if (begin == std::string::npos) return {};
    const std::size_t end = code.find_first_of("\r\n", begin);
    return base::printable(code.substr(begin, end == std::string::npos ? end : end - begin),
                           kMostShown);
}

}  // namespace

bool runsCode(const scene::Scene& scene) {
    return std::ranges::any_of(scene.layers,
                               [](const scene::Layer& layer) { return runsCode(layer); });
}

void Quarantine::add(const scene::Scene& scene) {
    for (const scene::Layer& layer : scene.layers) {
        if (!runsCode(layer) || std::ranges::find(shaders_, layer.shader) != shaders_.end()) {
            continue;
        }
        if (shaders_.size() == kMost) shaders_.pop_front();
        shaders_.push_back(layer.shader);
    }
}

std::optional<std::size_t> Quarantine::find(const scene::Scene& scene) const {
    for (std::size_t i = 0; i < scene.layers.size(); ++i) {
        const scene::Layer& layer = scene.layers[i];
        if (runsCode(layer) && std::ranges::find(shaders_, layer.shader) != shaders_.end())
            return i;
    }
    return std::nullopt;
}

Error quarantined(const scene::Scene& scene, std::size_t layer, const std::string& why) {
    const std::string field = "layers[" + std::to_string(layer) + "].shader.code";
    return fail(ErrorCode::kDeviceLost,
                field + ": the shader code of layer \"" + scene.layers[layer].id +
                    "\", which begins with \"" + firstLineOf(scene.layers[layer].shader.code) +
                    "\", took down two GL workers and is not run again with these controls" +
                    (why.empty() ? std::string{} : ": " + why),
                field);
}

}  // namespace volcast::workers
