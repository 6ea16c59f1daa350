#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>

#include "renderer/base/result.h"
#include "renderer/scene/scene.h"

namespace volcast::workers {

/// Whether a layer of `scene` that is shown runs a user's code.
bool runsCode(const scene::Scene& scene);

/// Codes of users that took down workers, with the states of their controls: the same code may be
/// harmless with others. The oldest is forgiven when there are many.
class Quarantine {
public:
    static constexpr std::size_t kMost = 64;

    /// Takes in all codes that a scene runs.
    void add(const scene::Scene& scene);
    /// The number of a layer that runs one of them.
    [[nodiscard]] std::optional<std::size_t> find(const scene::Scene& scene) const;

private:
    std::deque<scene::UserShader> shaders_;
};

/// kDeviceLost that names the code of layer number `layer`; `why`: what happened, where it just
/// did.
Error quarantined(const scene::Scene& scene, std::size_t layer, const std::string& why);

}  // namespace volcast::workers
