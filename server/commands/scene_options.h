#pragma once

#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "renderer/scene/scene.h"

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace volcast::commands {

/// How the values of a field are turned into those that rays interpolate. Empty: not given.
struct ScaleOptions {
    std::string kind;  ///< linear, log, power.
    std::optional<float> exponent;
    std::vector<float> domain;
};

/// What is drawn: shared by the commands that draw. Empty texts, lists and optionals: not given.
struct SceneOptions {
    std::string dataset;
    // the layer
    std::string map, model, field, sampling, integrator, evaluator, voxelEvaluator;
    std::vector<double> sectionPoint;   ///< World; empty: the middle.
    std::vector<std::string> sections;  ///< Those shown; empty: all.
    int timeStep = 0;
    double step = 0.0;     ///< World units; 0: half the smallest spacing.
    int depthSamples = 0;  ///< 0: as `step` says.
    float gain = 0.0F;
    std::optional<std::uint32_t> jitter = {};
    ScaleOptions scale;
    std::string densityField, densityMap;
    ScaleOptions densityScale;
    std::vector<float> interval;
    std::vector<std::string> markers;  ///< A field, then values.
    std::vector<float> levels;
    std::vector<float> levelRange;  ///< First, last, count.
    std::string levelSpacing;
    std::optional<float> levelExponent;
    std::vector<float> colour;
    bool coloured = false;
    bool unlit = false;
    std::optional<float> edgeWidth;
    std::vector<float> edgeColour;
    std::optional<float> exposure, extinctionScale;
    std::vector<std::pair<std::string, std::string>> channels;  ///< A name and its map's file.
    bool light = false;
    std::vector<double> lightPosition;
    std::optional<float> ambient, diffuse, specular, shininess;
    std::string shader;                 ///< File of code that takes the map's place.
    std::vector<std::string> controls;  ///< NAME=VALUE of its controls.
    // the scene
    std::string sceneFile, camera, projection;
    std::vector<std::tuple<double, double, double, double>> clip;  ///< Normal and offset.
    std::string accuracy;
    std::vector<float> background;
    // the picture
    std::vector<int> size{512, 512};
    // how
    std::string gpu, cacheFolder, shaderFolder;
    std::uint64_t volumeBudgetMib = 1024;
    double timeoutSeconds = 600.0;
    std::string tetgenSwitches = "pq1.414";
    std::vector<double> spacing;
};

/// Whether a command draws with one ray model, integrator and evaluator, or has a say of its own.
enum class Choices { kOne, kOwn };

/// Registers every option above (Choices::kOwn: but --model, --integrator and --evaluator); wrong
/// values are refused when the command line is read.
void addSceneOptions(CLI::App& command, SceneOptions& options, Choices choices);

/// Whether a word is a name in the registry; ray models have some names more.
CLI::Validator knownModel();
CLI::Validator knownIntegrator();
CLI::Validator knownEvaluator();

/// "auto", "fastest", "exact", "error:X" (1/255) or "time:MS".
///
/// Errors: kInvalidArgument saying what is allowed.
Result<scene::Accuracy> parseAccuracy(const std::string& text);

/// CLI11's number checks let NaN and infinity through.
const CLI::Validator& finite();

}  // namespace volcast::commands
