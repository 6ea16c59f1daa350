#include "renderer/scene/validate.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace volcast::scene {
namespace {

std::string pathOf(std::size_t layer) {
    return "layers[" + std::to_string(layer) + "]";
}

bool finite(const glm::vec3& colour) {
    return std::isfinite(colour.r) && std::isfinite(colour.g) && std::isfinite(colour.b);
}

bool needsMap(const Layer& layer) {
    return layer.model != RayModel::kSurface || layer.coloured;
}

Result<void> validate(const Layer& layer, const std::string& path) {
    if (!std::isfinite(layer.stepWorld) || layer.stepWorld < 0.0) {
        return fail(ErrorCode::kInvalidArgument,
                    path + ".step_world: " + std::to_string(layer.stepWorld) +
                        " is not a length of 0 or more",
                    path + ".step_world");
    }
    if (!finite(layer.surfaceColour)) {
        return fail(ErrorCode::kInvalidArgument, path + ".surface_colour: is not finite",
                    path + ".surface_colour");
    }
    if (layer.timeStep < 0) {
        return fail(ErrorCode::kInvalidArgument,
                    path + ".time_step: " + std::to_string(layer.timeStep) + " is negative",
                    path + ".time_step");
    }
    if (layer.map.points.empty() && !needsMap(layer)) return {};
    const Result<void> map = data::validate(layer.map);
    if (map) return {};
    const std::string field = path + ".transfer_function." + map.error().field;
    return fail(map.error().code, field + ": " + map.error().message, field);
}

Result<void> validateField(const Layer& layer, const data::DatasetSummary& summary,
                           const std::string& path) {
    if (summary.fields.empty()) {
        if (!needsMap(layer)) return {};
        return fail(ErrorCode::kInvalidArgument,
                    path + ".field: \"" + layer.dataset + "\" has no field to show",
                    path + ".field");
    }
    const auto field = layer.field.empty() ? summary.fields.begin()
                                           : std::ranges::find(summary.fields, layer.field,
                                                               &data::FieldSummary::name);
    if (field == summary.fields.end()) {
        return fail(ErrorCode::kNotFound,
                    path + ".field: \"" + layer.dataset + "\" has no field \"" + layer.field + "\"",
                    path + ".field");
    }
    if (layer.timeStep >= field->steps) {
        return fail(ErrorCode::kInvalidArgument,
                    path + ".time_step: " + std::to_string(layer.timeStep) + " of \"" +
                        field->name + "\", which has " + std::to_string(field->steps),
                    path + ".time_step");
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

Result<void> validate(const Scene& scene, const Summaries& summaries) {
    for (std::size_t i = 0; i < scene.layers.size(); ++i) {
        const Layer& layer = scene.layers[i];
        const auto found = summaries.find(layer.dataset);
        if (found == summaries.end()) {
            return fail(ErrorCode::kNotFound,
                        pathOf(i) + ".dataset: there is no dataset \"" + layer.dataset + "\"",
                        pathOf(i) + ".dataset");
        }
        if (layer.model == RayModel::kSurface && !found->second.isMesh) {
            return fail(ErrorCode::kUnsupported,
                        pathOf(i) + ".model: a voxel volume has no surface to draw",
                        pathOf(i) + ".model");
        }
        const Result<void> field = validateField(layer, found->second, pathOf(i));
        if (!field) return field.error();
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
