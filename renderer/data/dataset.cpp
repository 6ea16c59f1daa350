#include "renderer/data/dataset.h"

#include <cstring>
#include <limits>
#include <span>
#include <utility>

namespace volcast::data {

namespace {

FieldSummary summarizeField(const Field& field) {
    std::vector<float> samples;
    const std::size_t perStep = field.steps.empty() ? 0 : field.steps.front().size();
    visitSamples(perStep * field.steps.size(),
                 [&](std::size_t i) { samples.push_back(field.steps[i / perStep][i % perStep]); });
    return {.name = field.name,
            .unit = field.unit,
            .association = field.association,
            .range = field.range,
            .steps = static_cast<int>(field.steps.size()),
            .spread = spreadOf(std::move(samples), field.range),
            .cellsWithoutValue = field.cellsWithoutValue};
}

template <class T>
float valueAt(std::span<const std::byte> voxels, std::size_t i) {
    T value{};
    std::memcpy(&value, voxels.data() + i * sizeof(T), sizeof(T));
    return static_cast<float>(value);
}

float voxelAt(std::span<const std::byte> voxels, VoxelType type, std::size_t i) {
    switch (type) {
        case VoxelType::kU8: return valueAt<std::uint8_t>(voxels, i);
        case VoxelType::kU16: return valueAt<std::uint16_t>(voxels, i);
        case VoxelType::kI16: return valueAt<std::int16_t>(voxels, i);
        case VoxelType::kF32: return valueAt<float>(voxels, i);
    }
    return 0.0F;
}

FieldSummary summarizeChannel(const Channel& channel, VoxelType type) {
    std::vector<float> samples;
    visitSamples(channel.voxels.size() / voxelBytes(type), [&](std::size_t i) {
        samples.push_back(voxelAt(channel.voxels.span(), type, i));
    });
    return {.name = channel.name,
            .unit = channel.unit,
            .association = Association::kVertex,
            .range = channel.range,
            .steps = 1,
            .spread = spreadOf(std::move(samples), channel.range),
            .voxelsWithoutValue = channel.voxelsWithoutValue};
}

void grow(Box& box, const glm::dvec3& point) {
    box.min = glm::min(box.min, point);
    box.max = glm::max(box.max, point);
}

Box emptyBox() {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return {.min = glm::dvec3{kInfinity}, .max = glm::dvec3{-kInfinity}};
}

DatasetSummary summarizeMesh(const Mesh& mesh) {
    DatasetSummary summary;
    summary.isMesh = true;
    summary.bounds = emptyBox();
    for (const glm::vec3& vertex : mesh.vertices) {
        grow(summary.bounds, mesh.origin + glm::dvec3{vertex});
    }
    summary.cells = mesh.cells.size();
    summary.vertices = mesh.vertices.size();
    summary.boundaryFaces = mesh.boundaryFaces.size();
    summary.convex = mesh.convex;
    summary.cellsWithoutVolume = mesh.cellsWithoutVolume;
    summary.cellsInverted = mesh.cellsInverted;
    summary.cellsDoubled = mesh.cellsDoubled;
    summary.facesNotManifold = mesh.facesNotManifold;
    summary.bytes = mesh.vertices.bytes().size() + mesh.cells.bytes().size() +
                    mesh.neighbours.bytes().size() + mesh.boundaryFaces.bytes().size() +
                    mesh.boundaryNeighbours.bytes().size();
    for (const Field& field : mesh.fields) {
        summary.fields.push_back(summarizeField(field));
        for (const auto& step : field.steps) summary.bytes += step.bytes().size();
    }
    return summary;
}

DatasetSummary summarizeVolume(const Volume& volume) {
    DatasetSummary summary;
    summary.isMesh = false;
    summary.bounds = emptyBox();
    const glm::dvec3 extent = volume.spacing * glm::dvec3{volume.size - 1};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 side{corner & 1, (corner >> 1) & 1, (corner >> 2) & 1};
        grow(summary.bounds, volume.origin + volume.direction * (extent * side));
    }
    summary.voxels = volume.size;
    summary.spacing = volume.spacing;
    summary.voxelType = volume.type;
    summary.coarserLevels = volume.coarserLevels();
    for (const Channel& channel : volume.channels) {
        summary.fields.push_back(summarizeChannel(channel, volume.type));
        summary.bytes += channel.voxels.size() + channel.bricks.bytes().size();
        for (const ChannelLevel& level : channel.coarser) {
            summary.bytes += level.voxels.size() + level.bricks.bytes().size();
        }
    }
    return summary;
}

std::string emptyVoxels(const DatasetSummary& summary, const FieldSummary& field) {
    const auto all = static_cast<std::uint64_t>(summary.voxels.x) *
                     static_cast<std::uint64_t>(summary.voxels.y) *
                     static_cast<std::uint64_t>(summary.voxels.z);
    const bool one = field.voxelsWithoutValue == 1;
    return std::to_string(field.voxelsWithoutValue) + " of " + std::to_string(all) +
           " voxels of \"" + field.name + (one ? "\" is NaN and is" : "\" are NaN and are") +
           " drawn as empty";
}

}  // namespace

DatasetSummary summarize(const Dataset& dataset) {
    if (const Mesh* mesh = std::get_if<Mesh>(&dataset)) return summarizeMesh(*mesh);
    return summarizeVolume(std::get<Volume>(dataset));
}

std::vector<std::string> warningsOf(const DatasetSummary& summary) {
    std::vector<std::string> warnings;
    for (const FieldSummary& field : summary.fields) {
        if (field.voxelsWithoutValue > 0) warnings.push_back(emptyVoxels(summary, field));
        if (field.cellsWithoutValue == 0) continue;
        const bool one = field.cellsWithoutValue == 1;
        warnings.push_back(std::to_string(field.cellsWithoutValue) +
                           (one ? " cell has" : " cells have") + " no value (NaN) in \"" +
                           field.name + "\" and " + (one ? "is" : "are") +
                           " left out where it is drawn");
    }
    return warnings;
}

}  // namespace volcast::data
