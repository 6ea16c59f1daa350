// Scenes by themselves.
#include "renderer/scene/validate.h"

#include <cmath>
#include <set>
#include <string>

#include "renderer/scene/channels.h"
#include "renderer/scene/ray_models.h"
#include "renderer/scene/scale.h"
#include "renderer/scene/user_controls.h"
#include "renderer/scene/validate_error.h"
#include "renderer/scene/validate_sampling.h"

namespace volcast::scene {
namespace {

bool finite(const glm::vec3& colour) {
    return std::isfinite(colour.r) && std::isfinite(colour.g) && std::isfinite(colour.b);
}

bool colours(const Layer& layer) {
    const bool triangles = layer.model == RayModel::kSurface || layer.model == RayModel::kWireframe;
    return !triangles || layer.coloured;
}

Result<void> validateMap(const data::TransferFunction& map, const std::string& path) {
    const Result<void> valid = data::validate(map);
    if (valid) return {};
    const std::string field = path + "." + valid.error().field;
    return fail(valid.error().code, field + ": " + valid.error().message, field);
}

/// What serves what.
Result<void> validateChoices(const Layer& layer, const std::string& path) {
    if (layer.integrator != Integrator::kAuto &&
        integratorRow(layer.model, layer.integrator, true) == nullptr &&
        integratorRow(layer.model, layer.integrator, false) == nullptr) {
        return fail(ErrorCode::kUnsupported,
                    path + ".integrator: " + std::string{name(layer.integrator)} +
                        " cannot serve the ray model " + std::string{name(layer.model)} +
                        "; one of " + allowedIntegrators(layer.model) + " can",
                    path + ".integrator");
    }
    if (!serves(layer.evaluator, layer.model, layer.integrator)) {
        const bool faces = layer.evaluator == MeshEvaluator::kProjectionFaces;
        return fail(ErrorCode::kUnsupported,
                    path + ".evaluator: " + std::string{name(layer.evaluator)} +
                        (faces ? " draws mip, minip and mip_colour by ends alone, not "
                               : " draws what rays gather, not ") +
                        std::string{name(layer.model)},
                    path + ".evaluator");
    }
    return {};
}

Result<void> validate(const Light& light, const std::string& path) {
    const auto least = [&path](const char* name, float value, bool valid, const char* wanted) {
        return valid && std::isfinite(value)
                   ? Result<void>{}
                   : invalid(path + "." + name, std::to_string(value) + " is not " + wanted);
    };
    constexpr const char* kFromZero = "a number of 0 or more";
    Result<void> valid = least("ambient", light.ambient, light.ambient >= 0.0F, kFromZero);
    if (valid) valid = least("diffuse", light.diffuse, light.diffuse >= 0.0F, kFromZero);
    if (valid) valid = least("specular", light.specular, light.specular >= 0.0F, kFromZero);
    if (valid) valid = least("exponent", light.exponent, light.exponent > 0.0F, "a number above 0");
    if (!valid || !light.position) return valid;
    const glm::dvec3& position = *light.position;
    const bool finite =
        std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z);
    return finite ? Result<void>{} : invalid(path + ".position", "is not finite");
}

Result<void> validateNumbers(const Layer& layer, const std::string& path) {
    if (!(layer.edgeWidth > 0.0F && layer.edgeWidth <= 64.0F)) {
        return invalid(path + ".edge_width",
                       std::to_string(layer.edgeWidth) + " is not above 0 and at most 64 pixels");
    }
    if (!finite(layer.edgeColour)) return invalid(path + ".edge_colour", "is not finite");
    if (!(layer.extinctionScale >= 0.0F && std::isfinite(layer.extinctionScale))) {
        return invalid(path + ".extinction_scale",
                       std::to_string(layer.extinctionScale) + " is not a number of 0 or more");
    }
    if (!(std::abs(layer.exposure) <= 64.0F)) {
        return invalid(path + ".exposure",
                       std::to_string(layer.exposure) + " stops are not between -64 and 64");
    }
    if (layer.interval &&
        !(std::isfinite(layer.interval->min) && std::isfinite(layer.interval->max) &&
          layer.interval->min <= layer.interval->max)) {
        return invalid(path + ".interval", std::to_string(layer.interval->min) + " to " +
                                               std::to_string(layer.interval->max) +
                                               " is not a range of finite numbers in order");
    }
    if (!layer.markers.field.empty() && layer.markers.values.empty()) {
        return invalid(path + ".markers.values",
                       "no value is listed, so that no cell would be drawn");
    }
    if (layer.light) {
        if (auto valid = validate(*layer.light, path + ".light"); !valid) return valid;
    }
    if (layer.model == RayModel::kIsosurface) return validate(layer.levels, path + ".levels");
    return {};
}

Result<void> validate(const Layer& layer, const std::string& path) {
    if (auto valid = validateSampling(layer, path); !valid) return valid;
    if (!finite(layer.surfaceColour)) {
        return fail(ErrorCode::kInvalidArgument, path + ".surface_colour: is not finite",
                    path + ".surface_colour");
    }
    if (layer.timeStep < 0) {
        return fail(ErrorCode::kInvalidArgument,
                    path + ".time_step: " + std::to_string(layer.timeStep) + " is negative",
                    path + ".time_step");
    }
    Result<void> valid = validateChoices(layer, path);
    if (valid) valid = validateNumbers(layer, path);
    if (valid) valid = validateShader(layer, path);
    const bool usesMap = colours(layer) && !runsUserCode(layer);
    if (valid && (usesMap || !layer.map.points.empty())) {
        valid = validateMap(layer.map, path + ".transfer_function");
    }
    if (valid) valid = validateChannels(layer, path);
    if (valid && !layer.densityMap.points.empty()) {
        valid = validateMap(layer.densityMap, path + ".density_function");
    }
    return valid;
}

Result<void> validateRest(const Scene& scene) {
    if (scene.clipPlanes.size() > Scene::kMaxClipPlanes) {
        return fail(ErrorCode::kLimitExceeded,
                    "clip_planes: " + std::to_string(scene.clipPlanes.size()) + ", at most " +
                        std::to_string(Scene::kMaxClipPlanes),
                    "clip_planes");
    }
    for (std::size_t i = 0; i < scene.clipPlanes.size(); ++i) {
        const ClipPlane& plane = scene.clipPlanes[i];
        const double length = glm::length(plane.normal);
        const std::string path = "clip_planes[" + std::to_string(i) + "]";
        if (!(length > 1e-18 && length < 1e18)) {
            return invalid(path + ".normal", "is not a vector of finite length above 0");
        }
        if (!std::isfinite(plane.offset)) return invalid(path + ".offset", "is not finite");
    }
    const Accuracy& wish = scene.accuracy;
    const bool bounded =
        wish.kind == Accuracy::Kind::kErrorBound || wish.kind == Accuracy::Kind::kTimeBudget;
    if (bounded && !(wish.bound > 0.0 && std::isfinite(wish.bound))) {
        return invalid("accuracy.bound", std::to_string(wish.bound) + " is not above 0");
    }
    return {};
}

}  // namespace

Result<void> validate(const Scene& scene) {
    const Result<void> camera = validate(scene.camera);
    if (!camera) return camera.error();
    if (scene.layers.size() > Scene::kMaxLayers) {
        return fail(ErrorCode::kLimitExceeded,
                    "layers: " + std::to_string(scene.layers.size()) + ", at most " +
                        std::to_string(Scene::kMaxLayers),
                    "layers");
    }
    if (!finite(glm::vec3(scene.background))) {
        return fail(ErrorCode::kInvalidArgument, "background: is not finite", "background");
    }
    if (const Result<void> rest = validateRest(scene); !rest) return rest.error();
    if (!(scene.background.a >= 0.0F && scene.background.a <= 1.0F)) {
        return fail(ErrorCode::kInvalidArgument, "background_transparency: is not between 0 and 1",
                    "background_transparency");
    }
    std::set<std::string> ids;
    for (std::size_t i = 0; i < scene.layers.size(); ++i) {
        const Layer& layer = scene.layers[i];
        if (!ids.insert(layer.id).second) {
            return fail(ErrorCode::kInvalidArgument,
                        pathOf(i) + ".id: \"" + layer.id + "\" is taken by an earlier layer",
                        pathOf(i) + ".id");
        }
        const Result<void> valid = validate(layer, pathOf(i));
        if (!valid) return valid.error();
    }
    return {};
}

Result<void> validate(PictureSize size) {
    if (size.x < 1 || size.y < 1) {
        return fail(ErrorCode::kInvalidArgument,
                    "size: " + std::to_string(size.x) + " x " + std::to_string(size.y) +
                        " pixels is no picture",
                    "size");
    }
    if (size.x > kMaxPictureSide || size.y > kMaxPictureSide) {
        return fail(ErrorCode::kLimitExceeded,
                    "size: " + std::to_string(size.x) + " x " + std::to_string(size.y) +
                        " pixels, at most " + std::to_string(kMaxPictureSide) + " on a side",
                    "size");
    }
    return {};
}

}  // namespace volcast::scene
