#include "renderer/reference/layer_data.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "renderer/scene/ray_models.h"
#include "renderer/scene/scale.h"

namespace volcast::reference {
namespace {

Result<const data::Field*> fieldNamed(const data::Mesh& mesh, const std::string& name,
                                      const std::string& path) {
    if (name.empty() && !mesh.fields.empty()) return &mesh.fields.front();
    const auto found = std::ranges::find(mesh.fields, name, &data::Field::name);
    if (found != mesh.fields.end()) return &*found;
    return fail(ErrorCode::kNotFound, path + ": the mesh has no field \"" + name + "\"", path);
}

/// Values of one step as rays interpolate them; `own` backs them where a scale is applied.
Result<FieldValues> valuesOf(const data::Field& field, int step, const scene::ScaleFunction& scale,
                             base::Array<float>& own, const std::string& path) {
    if (static_cast<std::size_t>(step) >= field.steps.size()) {
        return fail(ErrorCode::kInvalidArgument,
                    path + ".time_step: " + std::to_string(step) + " of \"" + field.name +
                        "\", which has " + std::to_string(field.steps.size()),
                    path + ".time_step");
    }
    const base::Array<float>& stored = field.steps[static_cast<std::size_t>(step)];
    FieldValues values{.association = field.association, .values = stored.data()};
    if (scale.identity()) return values;
    std::vector<float> scaled;
    scaled.reserve(stored.size());
    for (const float value : stored) scaled.push_back(scale.ofData(value));
    own = std::move(scaled);
    values.values = own.data();
    return values;
}

bool hasNumbers(const data::Mesh& mesh, std::size_t cell, const FieldValues& field) {
    for (int corner = 0; corner < 4; ++corner) {
        const double value = field.at(static_cast<int>(cell), corner, mesh.cells[cell][corner]);
        if (!std::isfinite(value)) return false;
    }
    return true;
}

/// Fills in `kept`: cells that the markers list and whose values are numbers.
Result<void> chooseCells(const scene::CellMarkers& markers, LayerData& data,
                         const std::string& path) {
    const data::Mesh& mesh = data.caster->mesh();
    const base::Array<float>* marks = nullptr;
    if (!markers.field.empty()) {
        const auto field = fieldNamed(mesh, markers.field, path + ".markers.field");
        if (!field) return field.error();
        if ((*field)->association != data::Association::kCell) {
            return fail(
                ErrorCode::kUnsupported,
                path + ".markers.field: \"" + markers.field + "\" has no value for each cell",
                path + ".markers.field");
        }
        // A marker field with one step holds for all of them.
        const auto step = static_cast<std::size_t>(data.layer->timeStep);
        marks = &(*field)->steps[step < (*field)->steps.size() ? step : 0];
    }
    data.kept.assign(mesh.cells.size(), 1);
    bool all = true;
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) {
        const bool listed = marks == nullptr || std::ranges::find(markers.values, (*marks)[cell]) !=
                                                    markers.values.end();
        const bool keep =
            listed && hasNumbers(mesh, cell, data.f) && hasNumbers(mesh, cell, data.g);
        data.kept[cell] = keep ? 1 : 0;
        all = all && keep;
    }
    if (all) data.kept.clear();
    return {};
}

data::Range scaledRange(const data::Range& range, const scene::ScaleFunction& scale) {
    return {.min = scale.ofPoint(range.min), .max = scale.ofPoint(range.max)};
}

/// What only depends on values: maps, interval, levels.
void scaleNumbers(const scene::ScaleFunction& ofF, const scene::ScaleFunction& ofG,
                  LayerData& data) {
    const scene::Layer& layer = *data.layer;
    data.colour = LinearMap{layer.map, ofF};
    data::TransferFunction density = layer.densityMap.points.empty() ? layer.map : layer.densityMap;
    if (layer.model == scene::RayModel::kVolume && layer.gain != 0.0F) {
        for (auto& point : density.points) point.extinction *= std::exp(layer.gain);
    }
    data.extinction = LinearMap{density, ofG};
    if (layer.interval) data.interval = scaledRange(*layer.interval, ofF);
    if (layer.model != scene::RayModel::kIsosurface) return;
    for (const float level : scene::resolved(layer.levels)) {
        const double scaled = ofF.ofPoint(level);
        if (data.interval && (scaled < data.interval->min || scaled > data.interval->max)) continue;
        data.levels.push_back(scaled);
    }
}

/// Looks up both fields and scales all that is in their units.
Result<void> readFields(LayerData& data, const std::string& path) {
    const scene::Layer& layer = *data.layer;
    const data::Mesh& mesh = data.caster->mesh();
    const auto field = fieldNamed(mesh, layer.field, path + ".field");
    if (!field) return field.error();
    const data::Field* second = *field;
    if (data.twoFields) {
        const auto found = fieldNamed(mesh, layer.densityField, path + ".density_field");
        if (!found) return found.error();
        second = *found;
    }
    const scene::Scale& secondScale = data.twoFields ? layer.densityScale : layer.scale;
    Result<void> valid = scene::validate(layer.scale, (*field)->range, path + ".scale");
    if (valid) valid = scene::validate(secondScale, second->range, path + ".density_scale");
    if (!valid) return valid;
    const scene::ScaleFunction ofF{layer.scale, (*field)->range};
    const scene::ScaleFunction ofG{secondScale, second->range};
    const auto f = valuesOf(**field, layer.timeStep, ofF, data.ownF, path);
    if (!f) return f.error();
    data.f = data.g = *f;
    if (data.twoFields) {
        const auto g = valuesOf(*second, layer.timeStep, ofG, data.ownG, path);
        if (!g) return g.error();
        data.g = *g;
    }
    scaleNumbers(ofF, ofG, data);
    return {};
}

template <class T>
void convert(std::span<const std::byte> voxels, const scene::ScaleFunction& scale,
             std::vector<float>& values) {
    values.resize(voxels.size() / sizeof(T));
    for (std::size_t i = 0; i < values.size(); ++i) {
        T value;
        std::memcpy(&value, voxels.data() + i * sizeof(T), sizeof(T));
        values[i] = scale.ofData(static_cast<float>(value));
    }
}

void convert(data::VoxelType type, std::span<const std::byte> voxels,
             const scene::ScaleFunction& scale, std::vector<float>& values) {
    switch (type) {
        case data::VoxelType::kU8: return convert<std::uint8_t>(voxels, scale, values);
        case data::VoxelType::kU16: return convert<std::uint16_t>(voxels, scale, values);
        case data::VoxelType::kI16: return convert<std::int16_t>(voxels, scale, values);
        case data::VoxelType::kF32: return convert<float>(voxels, scale, values);
    }
}

/// Looks up the channel and scales all that is in its unit.
Result<void> readVoxels(const data::Volume& volume, LayerData& data, const std::string& path) {
    const scene::Layer& layer = *data.layer;
    if (scene::row(layer.model).chunk.empty()) {
        return fail(ErrorCode::kUnsupported,
                    path + ".model: the reference has no " + std::string{scene::name(layer.model)} +
                        " of voxels",
                    path + ".model");
    }
    auto channel = volume.channels.begin();
    if (!layer.field.empty()) {
        channel = std::ranges::find(volume.channels, layer.field, &data::Channel::name);
    }
    if (channel == volume.channels.end()) {
        return fail(ErrorCode::kNotFound,
                    path + ".field: the volume has no channel \"" + layer.field + "\"",
                    path + ".field");
    }
    if (auto valid = scene::validate(layer.scale, channel->range, path + ".scale"); !valid) {
        return valid;
    }
    const scene::ScaleFunction scale{layer.scale, channel->range};
    scaleNumbers(scale, scale, data);
    convert(volume.type, channel->voxels.span(), scale, data.voxels);
    data.grid.emplace(volume, data.voxels, layer.sampling);
    return {};
}

}  // namespace

Result<LayerData> prepare(const scene::Layer& layer, const Bodies& bodies,
                          const std::string& path) {
    const auto body = bodies.find(layer.dataset);
    if (body == bodies.end()) {
        return fail(ErrorCode::kNotFound,
                    path + ".dataset: \"" + layer.dataset + "\" is not among the data given",
                    path + ".dataset");
    }
    LayerData data;
    data.layer = &layer;
    if (body->second.volume != nullptr) {
        const auto read = readVoxels(*body->second.volume, data, path);
        if (!read) return read.error();
        return data;
    }
    data.caster = body->second.mesh.get();
    data.twoFields = scene::row(layer.model).secondField && !layer.densityField.empty();
    if (scene::needsField(layer)) {
        if (const auto read = readFields(data, path); !read) return read.error();
    }
    if (const auto chosen = chooseCells(layer.markers, data, path); !chosen) return chosen.error();
    return data;
}

}  // namespace volcast::reference
