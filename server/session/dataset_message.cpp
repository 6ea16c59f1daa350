#include "server/session/dataset_message.h"

namespace volcast::session {

namespace {

void set(v1::Vec3& message, const glm::dvec3& value) {
    message.set_x(value.x);
    message.set_y(value.y);
    message.set_z(value.z);
}

v1::Association associationOf(data::Association association) {
    switch (association) {
        case data::Association::kCell: return v1::ASSOCIATION_CELL;
        case data::Association::kCellVertex: return v1::ASSOCIATION_CELL_VERTEX;
        case data::Association::kVertex: break;
    }
    return v1::ASSOCIATION_VERTEX;
}

void describeField(v1::FieldInfo& message, const data::FieldSummary& field) {
    message.set_name(field.name);
    message.set_unit(field.unit);
    message.set_association(associationOf(field.association));
    message.set_min(field.range.min);
    message.set_max(field.range.max);
    const data::Spread& spread = field.spread;
    message.mutable_histogram()->Assign(spread.histogram.begin(), spread.histogram.end());
    message.mutable_percentiles()->Assign(spread.percentiles.begin(), spread.percentiles.end());
    message.mutable_usual_range()->set_min(spread.usual.min);
    message.mutable_usual_range()->set_max(spread.usual.max);
    message.set_steps(static_cast<std::uint32_t>(field.steps));
}

}  // namespace

v1::DatasetInfo describe(const std::string& id, const std::string& name,
                         const data::DatasetSummary& summary,
                         const std::vector<std::string>& warnings) {
    v1::DatasetInfo info;
    info.set_id(id);
    info.set_name(name);
    info.set_state(v1::DATASET_STATE_READY);
    info.set_progress(1.0);
    info.set_kind(summary.isMesh ? v1::DATASET_KIND_MESH : v1::DATASET_KIND_VOLUME);
    for (const data::FieldSummary& field : summary.fields) {
        describeField(*info.add_fields(), field);
    }
    set(*info.mutable_bounds_min(), summary.bounds.min);
    set(*info.mutable_bounds_max(), summary.bounds.max);
    info.set_cells(summary.cells);
    info.set_vertices(summary.vertices);
    if (!summary.isMesh) {
        for (int axis = 0; axis < 3; ++axis) {
            info.add_voxels(static_cast<std::uint32_t>(summary.voxels[axis]));
        }
    }
    info.set_bytes(summary.bytes);
    for (const std::string& warning : warnings) info.add_warnings(warning);
    return info;
}

}  // namespace volcast::session
