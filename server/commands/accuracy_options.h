#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "server/commands/scene_options.h"

namespace volcast::commands {

/// What `volcast accuracy` was asked for. Empty texts and lists: not given.
struct AccuracyOptions {
    SceneOptions scene;
    std::vector<std::string> models, integrators, evaluators;  ///< Empty: all.
    int frames = 5;
    std::uint64_t sample = 20'000;  ///< Pixels to compare; 0: all.
    std::string json, svg;
};

/// Registers every option; wrong values are refused when the command line is read.
void addOptions(CLI::App& command, AccuracyOptions& options);

}  // namespace volcast::commands
