#include "server/commands/option_layer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "renderer/scene/default_scene.h"
#include "renderer/scene/layer_fields.h"
#include "renderer/scene/ray_models.h"
#include "server/commands/files.h"
#include "server/commands/map_file.h"
#include "server/commands/option_shader.h"
#include "server/commands/render_scene.h"

namespace volcast::commands {

namespace {

scene::RayModel modelFrom(const std::string& name) {
    if (name == "max") return scene::RayModel::kMip;
    // The command line was checked: what is left means volume.
    return scene::rayModelNamed(name).value_or(scene::RayModel::kVolume);
}

Result<std::string> chosenField(const SceneOptions& options, const data::DatasetSummary& summary) {
    std::string names;
    for (const data::FieldSummary& field : summary.fields) {
        if (field.name == options.field) return field.name;
        names += (names.empty() ? "" : ", ") + field.name;
    }
    if (!options.field.empty()) {
        return fail(ErrorCode::kNotFound,
                    options.dataset + ": has no field \"" + options.field + "\"" +
                        (names.empty() ? "; it has none" : "; it has " + names));
    }
    return summary.fields.empty() ? std::string{} : summary.fields.front().name;
}

Result<scene::Scale> scaleFrom(const ScaleOptions& options, const std::string& option) {
    scene::Scale scale;
    if (options.kind == "log") scale.kind = scene::Scale::Kind::kLog;
    if (options.kind == "power") scale.kind = scene::Scale::Kind::kPower;
    if (options.exponent) scale.exponent = *options.exponent;
    if (options.exponent && scale.kind != scene::Scale::Kind::kPower) {
        return fail(ErrorCode::kInvalidArgument,
                    option + "-exponent: only " + option + " power has an exponent");
    }
    if (!options.domain.empty()) {
        scale.domain = data::Range{.min = options.domain[0], .max = options.domain[1]};
    }
    return scale;
}

/// What a scale does to values of a field, and its inverse; none for a linear one.
data::Axis axisOf(const scene::Scale& scale, const data::Range& range) {
    const data::Range domain = scale.domain.value_or(range);
    const double low = domain.min, width = static_cast<double>(domain.max) - low;
    const double exponent = scale.exponent;
    switch (scale.kind) {
        case scene::Scale::Kind::kLinear: return {};
        case scene::Scale::Kind::kLog:
            return {.along = [](double value) { return std::log(value); },
                    .back = [](double place) { return std::exp(place); }};
        case scene::Scale::Kind::kPower: break;
    }
    return {
        .along =
            [=](double value) { return std::pow(std::max(value - low, 0.0) / width, exponent); },
        .back = [=](double place) { return low + width * std::pow(place, 1.0 / exponent); }};
}

/// The map of a file, for a field as a layer reads it; opacities are over a tenth of the data's
/// diagonal, as in the page.
Result<data::TransferFunction> mapFrom(const std::string& path, const data::FieldSummary* field,
                                       const scene::Scale& scale,
                                       const data::DatasetSummary& summary) {
    auto text = readTextFile(path);
    if (!text) return std::move(text).error();
    const double diagonal = glm::length(summary.bounds.max - summary.bounds.min);
    MapUsual usual{.window = {.min = 0.0F, .max = 1.0F},
                   .distance = diagonal > 0.0 ? diagonal / 10.0 : 1.0};
    if (field != nullptr) {
        usual.window = scale.domain.value_or(field->spread.usual);
        usual.percentiles = field->spread.percentiles;
        usual.axis = axisOf(scale, field->range);
    }
    auto map = parseMap(*text, usual);
    if (!map) return in(path, map.error());
    return map;
}

/// Errors: kInvalidArgument where a value is no number.
Result<scene::CellMarkers> markersFrom(const std::vector<std::string>& words) {
    scene::CellMarkers markers;
    if (words.empty()) return markers;
    markers.field = words.front();
    for (std::size_t i = 1; i < words.size(); ++i) {
        char* end = nullptr;
        const float value = std::strtof(words[i].c_str(), &end);
        if (end != words[i].c_str() + words[i].size() || !std::isfinite(value)) {
            return fail(ErrorCode::kInvalidArgument,
                        "--markers: \"" + words[i] + "\" is not a finite number");
        }
        markers.values.push_back(value);
    }
    return markers;
}

/// Errors: kInvalidArgument for a count that is no whole number from 1 to kMaxLevels.
Result<scene::Levels> levelsFrom(const SceneOptions& options, const scene::Levels& usual) {
    using Spacing = scene::Levels::Spacing;
    scene::Levels levels = usual;
    if (!options.levels.empty()) {
        levels.spacing = Spacing::kList;
        levels.values = options.levels;
    }
    if (options.levelRange.empty()) return levels;
    const float count = options.levelRange[2];
    if (count != std::floor(count) || count < 1.0F ||
        count > static_cast<float>(scene::Levels::kMaxLevels)) {
        return fail(ErrorCode::kInvalidArgument, "--level-range: a count of " +
                                                     std::to_string(count) +
                                                     " is no whole number from 1 to " +
                                                     std::to_string(scene::Levels::kMaxLevels));
    }
    levels = {.spacing = options.levelSpacing == "log"     ? Spacing::kLog
                         : options.levelSpacing == "power" ? Spacing::kPower
                                                           : Spacing::kLinear,
              .values = {},
              .first = options.levelRange[0],
              .last = options.levelRange[1],
              .count = static_cast<int>(count)};
    if (options.levelExponent) levels.exponent = *options.levelExponent;
    return levels;
}

glm::vec3 vectorFrom(const std::vector<float>& values) {
    return {values[0], values[1], values[2]};
}

Result<void> setEvaluation(scene::Layer& layer, const SceneOptions& options) {
    if (!options.evaluator.empty()) {
        layer.evaluator = *scene::evaluatorNamed(options.evaluator);
    }
    if (!options.integrator.empty()) {
        layer.integrator = *scene::integratorNamed(options.integrator);
    }
    if (layer.integrator != scene::Integrator::kAuto &&
        scene::integratorRow(layer.model, layer.integrator, true) == nullptr &&
        scene::integratorRow(layer.model, layer.integrator, false) == nullptr) {
        return fail(ErrorCode::kUnsupported,
                    "--integrator: " + options.integrator + " cannot serve --model " +
                        std::string{scene::name(layer.model)} + "; one of " +
                        scene::allowedIntegrators(layer.model) + " can");
    }
    layer.stepWorld = options.step;
    if (!options.voxelEvaluator.empty()) {
        layer.voxelEvaluator = *scene::voxelEvaluatorNamed(options.voxelEvaluator);
    }
    layer.depthSamples = options.depthSamples;
    layer.gain = options.gain;
    layer.jitter = options.jitter;
    if (!options.sampling.empty()) layer.sampling = *scene::samplingNamed(options.sampling);
    return {};
}

/// What the options say of fields, maps and scales.
Result<void> setFields(scene::Layer& layer, const SceneOptions& options,
                       const data::DatasetSummary& summary) {
    auto scale = scaleFrom(options.scale, "--scale");
    if (!scale) return std::move(scale).error();
    layer.scale = *scale;
    auto densityScale = scaleFrom(options.densityScale, "--density-scale");
    if (!densityScale) return std::move(densityScale).error();
    layer.densityScale = *densityScale;
    if (!options.map.empty()) {
        auto map =
            mapFrom(options.map, scene::findField(summary, layer.field), layer.scale, summary);
        if (!map) return std::move(map).error();
        layer.map = *std::move(map);
    }
    if (!options.densityMap.empty()) {
        auto map = mapFrom(options.densityMap, scene::findField(summary, layer.densityField),
                           layer.densityScale, summary);
        if (!map) return std::move(map).error();
        layer.densityMap = *std::move(map);
    }
    for (const auto& [name, path] : options.channels) {
        auto map = mapFrom(path, scene::findField(summary, name), {}, summary);
        if (!map) return std::move(map).error();
        layer.channels.push_back({.field = name, .map = *std::move(map)});
    }
    layer.timeStep = options.timeStep;
    if (!options.interval.empty()) {
        layer.interval = data::Range{.min = options.interval[0], .max = options.interval[1]};
    }
    auto markers = markersFrom(options.markers);
    if (!markers) return std::move(markers).error();
    layer.markers = *std::move(markers);
    return {};
}

scene::Light lightFrom(const SceneOptions& options) {
    scene::Light light;
    const std::vector<double>& place = options.lightPosition;
    if (!place.empty()) light.position = glm::dvec3(place[0], place[1], place[2]);
    light.ambient = options.ambient.value_or(light.ambient);
    light.diffuse = options.diffuse.value_or(light.diffuse);
    light.specular = options.specular.value_or(light.specular);
    light.exponent = options.shininess.value_or(light.exponent);
    return light;
}

scene::CrossSections crossSectionsFrom(const SceneOptions& options) {
    scene::CrossSections sections;
    const std::vector<double>& point = options.sectionPoint;
    if (!point.empty()) sections.point = glm::dvec3(point[0], point[1], point[2]);
    if (options.sections.empty()) return sections;
    const auto named = [&](const char* axis) {
        return std::ranges::find(options.sections, axis) != options.sections.end();
    };
    sections.shown = glm::bvec3(named("x"), named("y"), named("z"));
    return sections;
}

void setLook(scene::Layer& layer, const SceneOptions& options) {
    layer.crossSections = crossSectionsFrom(options);
    layer.headlight = !options.unlit;
    if (options.coloured) layer.coloured = true;
    if (!options.colour.empty()) {
        layer.coloured = false;
        layer.surfaceColour = vectorFrom(options.colour);
    }
    if (options.light) layer.light = lightFrom(options);
    if (options.edgeWidth) layer.edgeWidth = *options.edgeWidth;
    if (!options.edgeColour.empty()) layer.edgeColour = vectorFrom(options.edgeColour);
    if (options.exposure) layer.exposure = *options.exposure;
    if (options.extinctionScale) layer.extinctionScale = *options.extinctionScale;
}

}  // namespace

Error in(const std::string& path, const Error& error) {
    const bool named = error.field.empty() || error.message.find(error.field) != std::string::npos;
    return fail(error.code, path + ": " + (named ? "" : error.field + ": ") + error.message,
                error.field);
}

Result<scene::Layer> layerFor(const SceneOptions& options, const data::DatasetSummary& summary,
                              scene::RayModel usual) {
    auto field = chosenField(options, summary);
    if (!field) return std::move(field).error();
    const scene::RayModel model = options.model.empty() ? usual : modelFrom(options.model);
    scene::Layer layer = scene::defaultLayer(kRenderDataset, summary, *field, model);
    layer.densityField = options.densityField;
    if (auto set = setFields(layer, options, summary); !set) return std::move(set).error();
    if (auto set = setEvaluation(layer, options); !set) return std::move(set).error();
    auto levels = levelsFrom(options, layer.levels);
    if (!levels) return std::move(levels).error();
    layer.levels = *std::move(levels);
    if (!options.shader.empty()) {
        auto shader = shaderFrom(options.shader, options.controls);
        if (!shader) return std::move(shader).error();
        layer.shader = *std::move(shader);
    }
    scene::expose(layer, summary);  // Anew, for the maps that the options name.
    setLook(layer, options);
    return layer;
}

}  // namespace volcast::commands
