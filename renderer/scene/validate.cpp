#include "renderer/scene/validate.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "renderer/scene/channels.h"
#include "renderer/scene/ray_models.h"
#include "renderer/scene/scale.h"
#include "renderer/scene/user_controls.h"
#include "renderer/scene/validate_sampling.h"

namespace volcast::scene {
namespace {

std::string pathOf(std::size_t layer) {
    return "layers[" + std::to_string(layer) + "]";
}

bool finite(const glm::vec3& colour) {
    return std::isfinite(colour.r) && std::isfinite(colour.g) && std::isfinite(colour.b);
}

bool colours(const Layer& layer) {
    const bool triangles = layer.model == RayModel::kSurface || layer.model == RayModel::kWireframe;
    return !triangles || layer.coloured;
}

Error invalid(const std::string& field, const std::string& why) {
    return fail(ErrorCode::kInvalidArgument, field + ": " + why, field);
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

const data::FieldSummary* fieldNamed(const data::DatasetSummary& summary, const std::string& name) {
    const auto found = std::ranges::find(summary.fields, name, &data::FieldSummary::name);
    return found == summary.fields.end() ? nullptr : &*found;
}

Error noField(const Layer& layer, const data::DatasetSummary& summary, const std::string& name,
              const std::string& path) {
    std::string names;
    for (const data::FieldSummary& field : summary.fields) {
        names += (names.empty() ? "" : ", ") + field.name;
    }
    return fail(ErrorCode::kNotFound,
                path + ": \"" + layer.dataset + "\" has no field \"" + name + "\"; it has " +
                    (names.empty() ? "none" : names),
                path);
}

/// Points, levels and intervals of a logarithmic scale must lie above 0 themselves.
Result<void> validateScaled(const Scale& scale, const std::vector<float>& values,
                            const std::string& path) {
    if (scale.kind != Scale::Kind::kLog) return {};
    for (const float value : values) {
        if (value > 0.0F) continue;
        return invalid(path, std::to_string(value) +
                                 " has no logarithm; the scale of its field is "
                                 "logarithmic");
    }
    return {};
}

std::vector<float> valuesOf(const data::TransferFunction& map) {
    std::vector<float> values;
    for (const data::ControlPoint& point : map.points) values.push_back(point.value);
    return values;
}

Result<void> validateScales(const Layer& layer, const data::FieldSummary& f,
                            const data::FieldSummary& g, const std::string& path) {
    Result<void> valid = validate(layer.scale, f.range, path + ".scale");
    if (valid) valid = validate(layer.densityScale, g.range, path + ".density_scale");
    if (valid) {
        valid = validateScaled(layer.scale, valuesOf(layer.map), path + ".transfer_function");
    }
    const data::TransferFunction& density =
        layer.densityMap.points.empty() ? layer.map : layer.densityMap;
    if (valid && !layer.densityField.empty()) {
        valid = validateScaled(layer.densityScale, valuesOf(density), path + ".density_function");
    }
    if (valid && layer.model == RayModel::kIsosurface) {
        valid = validateScaled(layer.scale, resolved(layer.levels), path + ".levels");
    }
    if (valid && layer.interval) {
        valid = validateScaled(layer.scale, {layer.interval->min, layer.interval->max},
                               path + ".interval");
    }
    return valid;
}

Error wrongModel(const Layer& layer, const std::string& path, const char* why) {
    return fail(ErrorCode::kUnsupported, path + ".model: " + std::string{name(layer.model)} + why,
                path + ".model");
}

/// What only meshes have: several fields, markers, isosurfaces of fields at vertices.
Result<void> validateMesh(const Layer& layer, const data::DatasetSummary& summary,
                          const std::string& path) {
    if (!row(layer.model).onMeshes) {
        return wrongModel(layer, path, " draws the grid of a volume of voxels; a mesh has none");
    }
    if (layer.voxelEvaluator != VoxelEvaluator::kAuto) {
        return fail(ErrorCode::kUnsupported,
                    path + ".voxel_evaluator: " + std::string{name(layer.voxelEvaluator)} +
                        " draws voxels; a mesh has an evaluator of its own",
                    path + ".voxel_evaluator");
    }
    if (!layer.markers.field.empty()) {
        const data::FieldSummary* marker = fieldNamed(summary, layer.markers.field);
        if (marker == nullptr) {
            return noField(layer, summary, layer.markers.field, path + ".markers.field");
        }
        if (marker->association != data::Association::kCell) {
            return fail(
                ErrorCode::kUnsupported,
                path + ".markers.field: \"" + marker->name + "\" has no value for each cell",
                path + ".markers.field");
        }
    }
    if (!needsField(layer)) return {};
    const data::FieldSummary* f =
        layer.field.empty() ? &summary.fields.front() : fieldNamed(summary, layer.field);
    const data::FieldSummary* g =
        layer.densityField.empty() ? f : fieldNamed(summary, layer.densityField);
    if (g == nullptr) {
        return noField(layer, summary, layer.densityField, path + ".density_field");
    }
    if (layer.timeStep >= g->steps) {
        return invalid(path + ".time_step", std::to_string(layer.timeStep) + " of \"" + g->name +
                                                "\", which has " + std::to_string(g->steps));
    }
    if (layer.model == RayModel::kIsosurface && f->association == data::Association::kCell) {
        return fail(ErrorCode::kUnsupported,
                    path + ".field: \"" + f->name +
                        "\" has one value a cell; an isosurface needs values that vary in cells",
                    path + ".field");
    }
    return validateScales(layer, *f, *g, path);
}

/// What voxels do not have yet.
Result<void> validateVolume(const Layer& layer, const std::string& path) {
    const auto unsupported = [](const std::string& field, const std::string& why) {
        return fail(ErrorCode::kUnsupported, field + ": " + why, field);
    };
    if (!row(layer.model).onVolumes) {
        return wrongModel(layer, path, " draws the faces of a mesh; a volume of voxels has none");
    }
    const bool slices = layer.voxelEvaluator == VoxelEvaluator::kSlices ||
                        layer.voxelEvaluator == VoxelEvaluator::kSliceInstances;
    if (slices && row(layer.model).opaque) {
        return unsupported(path + ".voxel_evaluator", std::string{name(layer.voxelEvaluator)} +
                                                          " draws what rays gather, not " +
                                                          std::string{name(layer.model)});
    }
    if (!layer.densityField.empty()) {
        return unsupported(path + ".density_field",
                           "a volume is drawn by one channel, which gives colour and extinction");
    }
    if (layer.scale.kind != Scale::Kind::kLinear || layer.scale.domain) {
        return unsupported(path + ".scale", "values of voxels are taken as they are");
    }
    if (!layer.markers.field.empty()) {
        return unsupported(path + ".markers.field", "a volume of voxels has no cells to mark");
    }
    return {};
}

/// An integrator may serve a model on data of one kind alone.
Result<void> validateIntegrator(const Layer& layer, bool mesh, const std::string& path) {
    if (layer.integrator == Integrator::kAuto ||
        integratorRow(layer.model, layer.integrator, mesh) != nullptr) {
        return {};
    }
    return fail(ErrorCode::kUnsupported,
                path + ".integrator: " + std::string{name(layer.integrator)} + " does not serve " +
                    std::string{name(layer.model)} + " on " + (mesh ? "meshes" : "voxels") +
                    "; one of " + allowedIntegrators(layer.model, mesh) + " does",
                path + ".integrator");
}

Result<void> validateField(const Layer& layer, const data::DatasetSummary& summary,
                           const std::string& path) {
    if (summary.fields.empty()) {
        if (!needsField(layer)) return {};
        return fail(ErrorCode::kInvalidArgument,
                    path + ".field: \"" + layer.dataset + "\" has no field to show",
                    path + ".field");
    }
    const auto field = layer.field.empty() ? summary.fields.begin()
                                           : std::ranges::find(summary.fields, layer.field,
                                                               &data::FieldSummary::name);
    if (field == summary.fields.end()) {
        return noField(layer, summary, layer.field, path + ".field");
    }
    if (layer.timeStep >= field->steps) {
        return fail(ErrorCode::kInvalidArgument,
                    path + ".time_step: " + std::to_string(layer.timeStep) + " of \"" +
                        field->name + "\", which has " + std::to_string(field->steps),
                    path + ".time_step");
    }
    return {};
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

Result<void> validate(const Scene& scene, const Summaries& summaries) {
    for (std::size_t i = 0; i < scene.layers.size(); ++i) {
        const Layer& layer = scene.layers[i];
        const auto found = summaries.find(layer.dataset);
        if (found == summaries.end()) {
            return fail(ErrorCode::kNotFound,
                        pathOf(i) + ".dataset: there is no dataset \"" + layer.dataset + "\"",
                        pathOf(i) + ".dataset");
        }
        Result<void> valid = validateField(layer, found->second, pathOf(i));
        if (valid) {
            valid = found->second.isMesh ? validateMesh(layer, found->second, pathOf(i))
                                         : validateVolume(layer, pathOf(i));
        }
        if (valid) valid = validateIntegrator(layer, found->second.isMesh, pathOf(i));
        if (valid) valid = validateChannels(layer, found->second, pathOf(i));
        if (valid) valid = validateShader(layer, found->second, pathOf(i));
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
