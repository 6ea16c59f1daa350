#include "renderer/scene/mesh_part.h"

#include <algorithm>
#include <bit>
#include <vector>

#include "renderer/scene/layer_fields.h"
#include "renderer/scene/ray_models.h"

namespace volcast::scene {
namespace {

/// Fields that `layer` reads and that lack a value somewhere.
std::vector<const data::FieldSummary*> incompleteFields(const Layer& layer,
                                                        const data::DatasetSummary& summary) {
    std::vector<const data::FieldSummary*> fields;
    if (!needsField(layer)) return fields;
    const auto add = [&fields](const data::FieldSummary* field) {
        if (field != nullptr && field->cellsWithoutValue > 0) fields.push_back(field);
    };
    add(mainField(layer, summary).field);
    if (const auto second = secondField(layer, summary)) add(second->field);
    return fields;
}

const data::Field* named(const data::Mesh& mesh, const std::string& name) {
    const auto found = std::ranges::find(mesh.fields, name, &data::Field::name);
    return found == mesh.fields.end() ? nullptr : &*found;
}

}  // namespace

std::string partKey(const Layer& layer, const data::DatasetSummary& summary) {
    std::string key;
    if (!layer.markers.field.empty()) {
        key += "m|" + layer.markers.field;
        for (const float value : layer.markers.values) {
            key += "|" + std::to_string(std::bit_cast<std::uint32_t>(value));
        }
    }
    for (const data::FieldSummary* field : incompleteFields(layer, summary)) {
        key += "|f|" + std::to_string(layer.timeStep) + "|" + field->name;
    }
    return key;
}

Result<MeshPart> makePart(const data::Mesh& mesh, const Layer& layer,
                          const data::DatasetSummary& summary) {
    std::vector<data::FieldStep> fields;
    for (const data::FieldSummary* field : incompleteFields(layer, summary)) {
        fields.push_back({.field = named(mesh, field->name), .step = layer.timeStep});
    }
    data::FieldStep marker;
    if (!layer.markers.field.empty()) {
        // Markers may have fewer time steps than what they mark.
        marker.field = named(mesh, layer.markers.field);
        const int last = static_cast<int>(marker.field->steps.size()) - 1;
        marker.step = std::min(layer.timeStep, last);
    }
    auto kept = data::keptCells(mesh, marker, layer.markers.values, fields);
    if (!kept) return std::move(kept).error();
    MeshPart part;
    if (*kept) part.restriction = data::restrictMesh(mesh, std::move((*kept)->cells));
    return part;
}

}  // namespace volcast::scene
