#include "server/session/dataset_message.h"

#include <algorithm>
#include <chrono>

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

const char* nameOf(data::VoxelType type) {
    switch (type) {
        case data::VoxelType::kU8: return "u8";
        case data::VoxelType::kU16: return "u16";
        case data::VoxelType::kI16: return "i16";
        case data::VoxelType::kF32: break;
    }
    return "f32";
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
    message.set_without_value(field.cellsWithoutValue + field.voxelsWithoutValue);
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
        set(*info.mutable_spacing(), summary.spacing);
        info.set_voxel_type(nameOf(summary.voxelType));
    }
    info.set_bytes(summary.bytes);
    for (const std::string& warning : warnings) info.add_warnings(warning);
    return info;
}

void addMoments(v1::DatasetInfo& info, const std::vector<data::Moments>& moments) {
    const auto count = std::min(moments.size(), static_cast<std::size_t>(info.fields_size()));
    for (std::size_t i = 0; i < count; ++i) {
        v1::FieldInfo& field = *info.mutable_fields(static_cast<int>(i));
        field.set_values(moments[i].values);
        if (moments[i].values == 0) continue;
        field.set_mean(moments[i].mean);
        field.set_deviation(moments[i].deviation);
    }
}

v1::ImportLog logOf(const workers::ImportedDataset& imported) {
    const data::DatasetSummary& summary = imported.summary;
    v1::ImportLog log;
    log.set_format(imported.format);
    log.set_ms(imported.ms);
    log.set_peak_mb(imported.peakMb);
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    log.set_finished(
        static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::seconds>(now).count()));
    log.set_cells_without_volume(summary.cellsWithoutVolume);
    log.set_cells_inverted(summary.cellsInverted);
    log.set_cells_doubled(summary.cellsDoubled);
    log.set_faces_not_manifold(summary.facesNotManifold);
    log.set_boundary_faces(summary.boundaryFaces);
    log.set_coarser_levels(static_cast<std::uint32_t>(summary.coarserLevels));
    return log;
}

}  // namespace volcast::session
