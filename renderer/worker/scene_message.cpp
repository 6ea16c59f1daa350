#include "renderer/worker/scene_message.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "renderer/scene/validate.h"

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

Result<scene::RayModel> modelFrom(v1::RayModel message, const string& field) {
    switch (message) {
        case v1::RAY_MODEL_UNSPECIFIED:
        case v1::RAY_MODEL_VOLUME: return scene::RayModel::kVolume;
        case v1::RAY_MODEL_SURFACE: return scene::RayModel::kSurface;
        case v1::RAY_MODEL_MIP: return scene::RayModel::kMip;
        default: return unknownEnumerator(field, message);
    }
}

Result<scene::Integrator> integratorFrom(v1::Integrator message, const string& field) {
    switch (message) {
        case v1::INTEGRATOR_AUTO: return scene::Integrator::kAuto;
        case v1::INTEGRATOR_AVERAGE: return scene::Integrator::kAverage;
        default: return unknownEnumerator(field, message);
    }
}

Result<scene::Sampling> samplingFrom(v1::Sampling message, const string& field) {
    switch (message) {
        case v1::SAMPLING_TRILINEAR: return scene::Sampling::kTrilinear;
        case v1::SAMPLING_NEAREST: return scene::Sampling::kNearest;
        default: return unknownEnumerator(field, message);
    }
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

Result<scene::Layer> layerFrom(const v1::Layer& message, const string& path) {
    auto model = modelFrom(message.model(), path + ".model");
    if (!model) return std::move(model).error();
    auto integrator = integratorFrom(message.integrator(), path + ".integrator");
    if (!integrator) return std::move(integrator).error();
    auto sampling = samplingFrom(message.sampling(), path + ".sampling");
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
                       .stepWorld = message.step_world(),
                       .sampling = *sampling};
    if (message.has_surface_colour()) layer.surfaceColour = colourFrom(message.surface_colour());
    return layer;
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

v1::RayModel toMessage(scene::RayModel model) {
    switch (model) {
        case scene::RayModel::kSurface: return v1::RAY_MODEL_SURFACE;
        case scene::RayModel::kMip: return v1::RAY_MODEL_MIP;
        case scene::RayModel::kVolume: return v1::RAY_MODEL_VOLUME;
    }
    return v1::RAY_MODEL_UNSPECIFIED;
}

void put(v1::Vec3* message, const glm::dvec3& value) {
    message->set_x(value.x);
    message->set_y(value.y);
    message->set_z(value.z);
}

void put(v1::Colour* message, const glm::vec3& value) {
    message->set_r(value.r);
    message->set_g(value.g);
    message->set_b(value.b);
}

void put(v1::Camera* message, const scene::Camera& camera) {
    put(message->mutable_eye(), camera.eye);
    put(message->mutable_center(), camera.center);
    put(message->mutable_up(), camera.up);
    message->set_projection(camera.projection == scene::Projection::kOrthographic
                                ? v1::PROJECTION_ORTHOGRAPHIC
                                : v1::PROJECTION_PERSPECTIVE);
    message->set_fovy_degrees(camera.fovyDegrees);
    message->set_orthographic_height(camera.orthographicHeight);
}

void put(v1::Layer* message, const scene::Layer& layer) {
    message->set_id(layer.id);
    message->set_dataset(layer.dataset);
    message->set_field(layer.field);
    message->set_time_step(layer.timeStep);
    message->set_model(toMessage(layer.model));
    for (const data::ControlPoint& point : layer.map.points) {
        v1::ControlPoint* added = message->mutable_transfer_function()->add_points();
        added->set_value(point.value);
        put(added->mutable_colour(), point.colour);
        added->set_extinction(point.extinction);
    }
    message->set_hidden(!layer.visible);
    message->set_coloured(layer.coloured);
    put(message->mutable_surface_colour(), layer.surfaceColour);
    message->set_unlit(!layer.headlight);
    message->set_integrator(layer.integrator == scene::Integrator::kAverage ? v1::INTEGRATOR_AVERAGE
                                                                            : v1::INTEGRATOR_AUTO);
    message->set_step_world(layer.stepWorld);
    message->set_sampling(layer.sampling == scene::Sampling::kNearest ? v1::SAMPLING_NEAREST
                                                                      : v1::SAMPLING_TRILINEAR);
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
    for (int i = 0; i < message.layers_size(); ++i) {
        auto layer = layerFrom(message.layers(i), "layers[" + std::to_string(i) + "]");
        if (!layer) return std::move(layer).error();
        scene.layers.push_back(*std::move(layer));
    }
    if (Result<void> valid = scene::validate(scene); !valid) return std::move(valid).error();
    return scene;
}

v1::Scene toMessage(const scene::Scene& scene) {
    v1::Scene message;
    put(message.mutable_camera(), scene.camera);
    for (const scene::Layer& layer : scene.layers) put(message.add_layers(), layer);
    put(message.mutable_background(), glm::vec3(scene.background));
    message.set_background_transparency(1.0 - static_cast<double>(scene.background.a));
    return message;
}

}  // namespace volcast::worker
