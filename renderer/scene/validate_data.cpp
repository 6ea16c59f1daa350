// Scenes against the data that they show.
#include <algorithm>
#include <string>
#include <vector>

#include "renderer/scene/channels.h"
#include "renderer/scene/ray_models.h"
#include "renderer/scene/scale.h"
#include "renderer/scene/user_controls.h"
#include "renderer/scene/validate.h"
#include "renderer/scene/validate_error.h"

namespace volcast::scene {
namespace {

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

}  // namespace

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

}  // namespace volcast::scene
