#include "renderer/worker/scene_message.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "renderer/scene/validate.h"
#include "renderer/worker/scene_message_pairs.h"
#include "renderer/worker/user_shader_message.h"

namespace volcast::worker {

namespace {

using std::string;

Error unknownEnumerator(const string& field, int value) {
    return fail(ErrorCode::kUnsupported,
                field + ": " + std::to_string(value) + " is not known to this server", field);
}

/// `value` as a float; a number too large for one is refused instead of becoming infinite.
Result<float> floatFrom(double value, const string& field) {
    if (!std::isfinite(value)) {
        return fail(ErrorCode::kInvalidArgument,
                    field + ": " + std::to_string(value) + " is not a finite number", field);
    }
    if (std::abs(value) > std::numeric_limits<float>::max()) {
        return fail(ErrorCode::kInvalidArgument,
                    field + ": " + std::to_string(value) + " does not fit single precision", field);
    }
    return static_cast<float>(value);
}

glm::dvec3 vectorFrom(const v1::Vec3& message) {
    return {message.x(), message.y(), message.z()};
}

glm::vec3 colourFrom(const v1::Colour& message) {
    return {message.r(), message.g(), message.b()};
}

template <class Pairs, class Theirs>
auto oursFrom(const Pairs& pairs, Theirs theirs, const string& field)
    -> Result<decltype(pairs[0].ours)> {
    for (const auto& pair : pairs) {
        if (pair.theirs == theirs) return pair.ours;
    }
    return unknownEnumerator(field, theirs);
}

Result<data::Range> rangeFrom(const v1::Range& message, const string& path) {
    const Result<float> low = floatFrom(message.min(), path + ".min");
    if (!low) return low.error();
    const Result<float> high = floatFrom(message.max(), path + ".max");
    if (!high) return high.error();
    return data::Range{.min = *low, .max = *high};
}

template <class Message>
Result<std::vector<float>> floatsFrom(const Message& values, int most, const string& path) {
    if (values.size() > most) {
        return fail(ErrorCode::kLimitExceeded,
                    path + ": " + std::to_string(values.size()) + " values, at most " +
                        std::to_string(most),
                    path);
    }
    std::vector<float> result;
    for (int i = 0; i < values.size(); ++i) {
        const Result<float> value = floatFrom(values.Get(i), path + "[" + std::to_string(i) + "]");
        if (!value) return value.error();
        result.push_back(*value);
    }
    return result;
}

Result<scene::Scale> scaleFrom(const v1::Scale& message, const string& path) {
    const auto kind = oursFrom(kScales, message.kind(), path + ".kind");
    if (!kind) return kind.error();
    scene::Scale scale{.kind = *kind};
    if (message.exponent() != 0.0) {
        const auto exponent = floatFrom(message.exponent(), path + ".exponent");
        if (!exponent) return exponent.error();
        scale.exponent = *exponent;
    }
    if (!message.has_domain()) return scale;
    const auto domain = rangeFrom(message.domain(), path + ".domain");
    if (!domain) return domain.error();
    scale.domain = *domain;
    return scale;
}

Result<scene::Levels> levelsFrom(const v1::Levels& message, const string& path) {
    const auto spacing = oursFrom(kSpacings, message.spacing(), path + ".spacing");
    if (!spacing) return spacing.error();
    auto values = floatsFrom(message.values(), scene::Levels::kMaxLevels, path + ".values");
    if (!values) return std::move(values).error();
    const auto first = floatFrom(message.first(), path + ".first");
    if (!first) return first.error();
    const auto last = floatFrom(message.last(), path + ".last");
    if (!last) return last.error();
    const auto exponent = floatFrom(message.exponent(), path + ".exponent");
    if (!exponent) return exponent.error();
    scene::Levels levels{.spacing = *spacing,
                         .values = *std::move(values),
                         .first = *first,
                         .last = *last,
                         .count = message.count()};
    if (*exponent != 0.0F) levels.exponent = *exponent;
    return levels;
}

/// Limits are checked before anything is copied.
Result<data::TransferFunction> mapFrom(const v1::TransferFunction& message, const string& path) {
    const int count = message.points_size();
    if (count > static_cast<int>(data::TransferFunction::kMaxPoints)) {
        return fail(ErrorCode::kLimitExceeded,
                    path + ".points: " + std::to_string(count) + " points, at most " +
                        std::to_string(data::TransferFunction::kMaxPoints),
                    path + ".points");
    }
    data::TransferFunction map;
    map.points.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        const v1::ControlPoint& point = message.points(i);
        const string here = path + ".points[" + std::to_string(i) + "]";
        const Result<float> value = floatFrom(point.value(), here + ".value");
        if (!value) return value.error();
        const Result<float> extinction = floatFrom(point.extinction(), here + ".extinction");
        if (!extinction) return extinction.error();
        map.points.push_back(
            {.value = *value, .colour = colourFrom(point.colour()), .extinction = *extinction});
    }
    return map;
}

/// Everything that decides which part of the data is seen, and through what.
Result<void> readSelection(const v1::Layer& message, const string& path, scene::Layer& layer) {
    auto scale = scaleFrom(message.scale(), path + ".scale");
    if (!scale) return std::move(scale).error();
    layer.scale = *scale;
    layer.densityField = message.density_field();
    auto density = mapFrom(message.density_function(), path + ".density_function");
    if (!density) return std::move(density).error();
    layer.densityMap = *std::move(density);
    auto densityScale = scaleFrom(message.density_scale(), path + ".density_scale");
    if (!densityScale) return std::move(densityScale).error();
    layer.densityScale = *densityScale;
    if (message.has_interval()) {
        const auto interval = rangeFrom(message.interval(), path + ".interval");
        if (!interval) return interval.error();
        layer.interval = *interval;
    }
    constexpr int kMaxMarkers = 4096;
    auto markers = floatsFrom(message.markers().values(), kMaxMarkers, path + ".markers.values");
    if (!markers) return std::move(markers).error();
    layer.markers = {.field = message.markers().field(), .values = *std::move(markers)};
    return {};
}

Result<scene::Light> lightFrom(const v1::Light& message, const string& path) {
    scene::Light light;
    if (message.has_position()) light.position = vectorFrom(message.position());
    const auto read = [&path](bool given, double value, const char* name, float& number) {
        if (!given) return Result<void>{};
        const Result<float> narrowed = floatFrom(value, path + "." + name);
        if (!narrowed) return Result<void>{narrowed.error()};
        number = *narrowed;
        return Result<void>{};
    };
    Result<void> done = read(message.has_ambient(), message.ambient(), "ambient", light.ambient);
    if (done) done = read(message.has_diffuse(), message.diffuse(), "diffuse", light.diffuse);
    if (done) done = read(message.has_specular(), message.specular(), "specular", light.specular);
    if (done) done = read(message.has_exponent(), message.exponent(), "exponent", light.exponent);
    if (!done) return done.error();
    return light;
}

/// The parameters of single ray models.
Result<void> readParameters(const v1::Layer& message, const string& path, scene::Layer& layer) {
    if (message.has_levels()) {
        auto levels = levelsFrom(message.levels(), path + ".levels");
        if (!levels) return std::move(levels).error();
        layer.levels = *std::move(levels);
    }
    if (message.has_light()) {
        const auto light = lightFrom(message.light(), path + ".light");
        if (!light) return light.error();
        layer.light = *light;
    }
    if (message.has_edge_width()) {
        const auto width = floatFrom(message.edge_width(), path + ".edge_width");
        if (!width) return width.error();
        layer.edgeWidth = *width;
    }
    if (message.has_edge_colour()) layer.edgeColour = colourFrom(message.edge_colour());
    if (message.has_extinction_scale()) {
        const auto scale = floatFrom(message.extinction_scale(), path + ".extinction_scale");
        if (!scale) return scale.error();
        layer.extinctionScale = *scale;
    }
    const auto exposure = floatFrom(message.exposure(), path + ".exposure");
    if (!exposure) return exposure.error();
    layer.exposure = *exposure;
    if (message.has_surface_colour()) layer.surfaceColour = colourFrom(message.surface_colour());
    return {};
}

Result<void> readVoxels(const v1::Layer& message, const string& path, scene::Layer& layer) {
    const auto evaluator =
        oursFrom(kVoxelEvaluators, message.voxel_evaluator(), path + ".voxel_evaluator");
    if (!evaluator) return evaluator.error();
    layer.voxelEvaluator = *evaluator;
    layer.depthSamples = message.depth_samples();
    const auto gain = floatFrom(message.gain(), path + ".gain");
    if (!gain) return gain.error();
    layer.gain = *gain;
    if (message.has_jitter()) layer.jitter = message.jitter();
    for (int i = 0; i < message.channels_size(); ++i) {
        const v1::ChannelMap& channel = message.channels(i);
        auto map = mapFrom(channel.transfer_function(),
                           path + ".channels[" + std::to_string(i) + "].transfer_function");
        if (!map) return std::move(map).error();
        layer.channels.push_back(
            {.field = channel.field(), .map = *std::move(map), .visible = !channel.hidden()});
        if (!channel.has_interval()) continue;
        const auto interval =
            rangeFrom(channel.interval(), path + ".channels[" + std::to_string(i) + "].interval");
        if (!interval) return interval.error();
        layer.channels.back().interval = *interval;
    }
    if (message.has_shader()) {
        auto shader = userShaderFrom(message.shader(), path + ".shader");
        if (!shader) return std::move(shader).error();
        layer.shader = *std::move(shader);
    }
    const v1::CrossSections& sections = message.cross_sections();
    if (sections.has_point()) layer.crossSections.point = vectorFrom(sections.point());
    layer.crossSections.shown =
        glm::not_(glm::bvec3(sections.hide_first(), sections.hide_second(), sections.hide_third()));
    return {};
}

Result<scene::Layer> layerFrom(const v1::Layer& message, const string& path) {
    auto model = oursFrom(kModels, message.model(), path + ".model");
    if (!model) return std::move(model).error();
    auto integrator = oursFrom(kIntegrators, message.integrator(), path + ".integrator");
    if (!integrator) return std::move(integrator).error();
    auto evaluator = oursFrom(kEvaluators, message.evaluator(), path + ".evaluator");
    if (!evaluator) return std::move(evaluator).error();
    auto sampling = oursFrom(kSamplings, message.sampling(), path + ".sampling");
    if (!sampling) return std::move(sampling).error();
    auto map = mapFrom(message.transfer_function(), path + ".transfer_function");
    if (!map) return std::move(map).error();
    scene::Layer layer{.id = message.id(),
                       .dataset = message.dataset(),
                       .field = message.field(),
                       .timeStep = message.time_step(),
                       .model = *model,
                       .map = *std::move(map),
                       .visible = !message.hidden(),
                       .coloured = message.coloured(),
                       .headlight = !message.unlit(),
                       .integrator = *integrator,
                       .evaluator = *evaluator,
                       .stepWorld = message.step_world(),
                       .sampling = *sampling};
    Result<void> read = readSelection(message, path, layer);
    if (read) read = readParameters(message, path, layer);
    if (read) read = readVoxels(message, path, layer);
    if (!read) return std::move(read).error();
    return layer;
}

/// Clip planes and the accuracy asked for.
Result<void> readRest(const v1::Scene& message, scene::Scene& scene) {
    const int planes = message.clip_planes_size();
    if (planes > static_cast<int>(scene::Scene::kMaxClipPlanes)) {
        return fail(ErrorCode::kLimitExceeded,
                    "clip_planes: " + std::to_string(planes) + " planes, at most " +
                        std::to_string(scene::Scene::kMaxClipPlanes),
                    "clip_planes");
    }
    for (const v1::ClipPlane& plane : message.clip_planes()) {
        scene.clipPlanes.push_back(
            {.normal = vectorFrom(plane.normal()), .offset = plane.offset()});
    }
    const auto kind = oursFrom(kAccuracies, message.accuracy().kind(), "accuracy.kind");
    if (!kind) return kind.error();
    scene.accuracy = {.kind = *kind, .bound = message.accuracy().bound()};
    return {};
}

Result<glm::vec4> backgroundFrom(const v1::Scene& message) {
    const double transparency = message.background_transparency();
    if (!(transparency >= 0.0 && transparency <= 1.0)) {
        return fail(
            ErrorCode::kInvalidArgument,
            "background_transparency: " + std::to_string(transparency) + " is outside [0, 1]",
            "background_transparency");
    }
    return glm::vec4(colourFrom(message.background()), static_cast<float>(1.0 - transparency));
}

}  // namespace

Result<scene::Camera> cameraFrom(const v1::Camera& message, const string& path) {
    if (message.projection() != v1::PROJECTION_PERSPECTIVE &&
        message.projection() != v1::PROJECTION_ORTHOGRAPHIC) {
        return unknownEnumerator(path + ".projection", message.projection());
    }
    // What a message leaves out keeps its default, so that {"eye": ...} alone is a camera.
    scene::Camera camera;
    if (message.has_eye()) camera.eye = vectorFrom(message.eye());
    if (message.has_center()) camera.center = vectorFrom(message.center());
    if (message.has_up()) camera.up = vectorFrom(message.up());
    if (message.projection() == v1::PROJECTION_ORTHOGRAPHIC) {
        camera.projection = scene::Projection::kOrthographic;
    }
    if (message.fovy_degrees() != 0.0) camera.fovyDegrees = message.fovy_degrees();
    if (message.orthographic_height() != 0.0) {
        camera.orthographicHeight = message.orthographic_height();
    }
    if (Result<void> valid = scene::validate(camera); !valid) {
        Error error = std::move(valid).error();
        // The camera's own check names its fields from "camera" on.
        const string standard = "camera";
        if (error.field.starts_with(standard)) {
            error.field = path + error.field.substr(standard.size());
        }
        return error;
    }
    return camera;
}

Result<scene::Scene> sceneFrom(const v1::Scene& message) {
    if (message.layers_size() > static_cast<int>(scene::Scene::kMaxLayers)) {
        return fail(ErrorCode::kLimitExceeded,
                    "layers: " + std::to_string(message.layers_size()) + " layers, at most " +
                        std::to_string(scene::Scene::kMaxLayers),
                    "layers");
    }
    auto camera = cameraFrom(message.camera());
    if (!camera) return std::move(camera).error();
    auto background = backgroundFrom(message);
    if (!background) return std::move(background).error();
    scene::Scene scene{.camera = *camera, .layers = {}, .background = *background};
    if (Result<void> read = readRest(message, scene); !read) return std::move(read).error();
    for (int i = 0; i < message.layers_size(); ++i) {
        auto layer = layerFrom(message.layers(i), "layers[" + std::to_string(i) + "]");
        if (!layer) return std::move(layer).error();
        scene.layers.push_back(*std::move(layer));
    }
    if (Result<void> valid = scene::validate(scene); !valid) return std::move(valid).error();
    return scene;
}

Result<scene::Integrator> integratorFrom(v1::Integrator message) {
    return oursFrom(kIntegrators, message, "integrator");
}

Result<scene::MeshEvaluator> meshEvaluatorFrom(v1::MeshEvaluator message) {
    return oursFrom(kEvaluators, message, "evaluator");
}

}  // namespace volcast::worker
