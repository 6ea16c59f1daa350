#pragma once

#include <deque>
#include <string>

#include "renderer/scene/scene.h"

namespace volcast::workers {

/// Codes of users that took down workers; the oldest is forgiven when there are many.
class Quarantine {
public:
    static constexpr std::size_t kMost = 64;

    /// Takes in all codes of a scene.
    void add(const scene::Scene& scene);
    /// Whether a scene runs one of them.
    [[nodiscard]] bool holds(const scene::Scene& scene) const;

private:
    std::deque<std::string> codes_;
};

}  // namespace volcast::workers
