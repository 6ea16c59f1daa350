#pragma once

#include <string>

#include "server/commands/scene_options.h"

namespace volcast::commands {

/// What `volcast render` was asked for. Empty texts: not given.
struct RenderOptions {
    SceneOptions scene;
    std::string png, raw;
    bool explain = false;
    // the measurement
    int frames = 0;
    double orbitDegrees = 36.0;
    float levelStep = 0.0F;
};

/// Registers every option; wrong values are refused when the command line is read.
void addOptions(CLI::App& command, RenderOptions& options);

}  // namespace volcast::commands
