#pragma once

#include <string>
#include <vector>

#include "renderer/scene/scene.h"

namespace CLI {
class App;
}

namespace volcast::commands {

/// What `volcast render` was asked for. Empty texts and lists: not given.
struct RenderOptions {
    std::string dataset;
    // what is seen
    std::string camera, map, model, field, sceneFile, projection, sampling, integrator;
    int timeStep = 0;
    double step = 0.0;  ///< World units; 0: half the smallest spacing.
    std::vector<float> colour;
    bool coloured = false;
    bool unlit = false;
    std::vector<float> background;
    // the picture
    std::vector<int> size{512, 512};
    std::string png, raw;
    bool explain = false;
    // the measurement
    int frames = 0;
    double orbitDegrees = 36.0;
    // how
    std::string gpu, cacheFolder, shaderFolder;
    double timeoutSeconds = 600.0;
    std::string tetgenSwitches = "pq1.414";
    std::vector<double> spacing;
};

/// Registers every option; wrong values are refused when the command line is read.
void addOptions(CLI::App& command, RenderOptions& options);

}  // namespace volcast::commands
