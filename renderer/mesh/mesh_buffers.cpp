#include "renderer/mesh/mesh_buffers.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "renderer/mesh/shared.h"

namespace volcast::mesh {

namespace {

std::uint64_t nextSerial() {
    static std::uint64_t serial = 0;  // All uploads happen on the device's thread.
    return ++serial;
}

/// Corners of a cell in ascending order of their vertex numbers.
std::array<int, 4> ascendingCorners(const glm::ivec4& cell) {
    std::array<int, 4> corners{0, 1, 2, 3};
    std::sort(corners.begin(), corners.end(), [&cell](int i, int j) { return cell[i] < cell[j]; });
    return corners;
}

std::int32_t mixed(const glm::ivec4& ids) {
    return ids.x ^ ids.y ^ ids.z ^ ids.w;
}

std::vector<glm::ivec4> cellRecords(const data::Mesh& mesh) {
    std::vector<glm::ivec4> records(2 * mesh.cells.size());
    for (std::size_t t = 0; t < mesh.cells.size(); ++t) {
        const auto corners = ascendingCorners(mesh.cells[t]);
        for (int rank = 0; rank < 4; ++rank) {
            const int corner = corners[static_cast<std::size_t>(rank)];
            const std::int32_t other = mesh.neighbours[t][corner];
            records[2 * t][rank] = other;
            if (other < 0) continue;
            // Three of the four ids occur in both cells and cancel out.
            records[2 * t + 1][rank] = mixed(mesh.cells[static_cast<std::size_t>(other)]) ^
                                       mixed(mesh.cells[t]) ^ mesh.cells[t][corner];
        }
    }
    return records;
}

std::vector<glm::ivec4> boundaryRecords(const data::Mesh& mesh) {
    std::vector<glm::ivec4> records(2 * std::max<std::size_t>(mesh.boundaryFaces.size(), 1));
    for (std::size_t b = 0; b < mesh.boundaryFaces.size(); ++b) {
        const data::BoundaryFace& face = mesh.boundaryFaces[b];
        const glm::ivec3& v = face.vertices;
        const std::int32_t apex =
            mixed(mesh.cells[static_cast<std::size_t>(face.cell)]) ^ v.x ^ v.y ^ v.z;
        records[2 * b] = {face.cell, v};
        records[2 * b + 1] = {mesh.boundaryNeighbours[b], apex};
    }
    return records;
}

data::Box boundsOf(const data::Mesh& mesh) {
    data::Box box{.min = glm::dvec3{std::numeric_limits<double>::max()},
                  .max = glm::dvec3{std::numeric_limits<double>::lowest()}};
    for (const glm::vec3& vertex : mesh.vertices) {
        box.min = glm::min(box.min, glm::dvec3{vertex});
        box.max = glm::max(box.max, glm::dvec3{vertex});
    }
    return box;
}

/// Corner values in the order of vertex numbers, which is how shaders find them.
std::vector<glm::vec4> cornerValues(const data::Mesh& mesh, std::span<const float> values) {
    std::vector<glm::vec4> sorted(mesh.cells.size());
    for (std::size_t t = 0; t < mesh.cells.size(); ++t) {
        const auto corners = ascendingCorners(mesh.cells[t]);
        for (int rank = 0; rank < 4; ++rank) {
            const auto corner = static_cast<std::size_t>(corners[static_cast<std::size_t>(rank)]);
            sorted[t][rank] = values[4 * t + corner];
        }
    }
    return sorted;
}

/// Makes `target` hold `values` as texels.
template <class T>
Result<void> fill(gpu::Device& device, gpu::Buffer& target, std::span<const T> values,
                  gpu::TexelFormat texels, const char* label) {
    auto made = gpu::Buffer::create(
        device, {.bytes = values.size_bytes(), .texels = texels, .label = label},
        std::as_bytes(values));
    if (!made) return made.error();
    target = std::move(*made);
    return {};
}

}  // namespace

Result<std::unique_ptr<MeshGpu>> MeshGpu::upload(gpu::Device& device, const data::Mesh& mesh) {
    auto gpu = std::make_unique<MeshBuffers>();
    const std::span<const float> positions{&mesh.vertices.data()->x, 3 * mesh.vertices.size()};
    const std::vector<glm::ivec4> cells = cellRecords(mesh);
    const std::vector<glm::ivec4> boundary = boundaryRecords(mesh);
    if (auto done =
            fill(device, gpu->positions, positions, gpu::TexelFormat::kR32F, "mesh positions");
        !done) {
        return done.error();
    }
    if (auto done =
            fill(device, gpu->cells, std::span{cells}, gpu::TexelFormat::kRgba32I, "mesh cells");
        !done) {
        return done.error();
    }
    if (auto done = fill(device, gpu->boundary, std::span{boundary}, gpu::TexelFormat::kRgba32I,
                         "mesh boundary");
        !done) {
        return done.error();
    }
    gpu->vertexCount = static_cast<int>(mesh.vertices.size());
    gpu->cellCount = static_cast<int>(mesh.cells.size());
    gpu->boundaryCount = static_cast<int>(mesh.boundaryFaces.size());
    gpu->bounds = boundsOf(mesh);
    const double diagonal = glm::length(gpu->bounds.max - gpu->bounds.min);
    gpu->scale = diagonal > 0.0 ? 2.0 / diagonal : 1.0;
    gpu->serial = nextSerial();
    return std::unique_ptr<MeshGpu>{std::move(gpu)};
}

Result<std::unique_ptr<FieldGpu>> FieldGpu::upload(gpu::Device& device, const data::Mesh& mesh,
                                                   const data::Field& field, int step,
                                                   const scene::ScaleFunction& scale) {
    auto gpu = std::make_unique<FieldBuffer>();
    std::span<const float> values = field.steps.at(static_cast<std::size_t>(step)).span();
    std::vector<float> scaled;
    if (!scale.identity()) {
        for (const float value : values) scaled.push_back(scale.ofData(value));
        values = scaled;
    }
    Result<void> done;
    if (field.association == data::Association::kCellVertex) {
        const std::vector<glm::vec4> sorted = cornerValues(mesh, values);
        done = fill(device, gpu->values, std::span{sorted}, gpu::TexelFormat::kRgba32F,
                    "field at corners");
    } else {
        done = fill(device, gpu->values, values, gpu::TexelFormat::kR32F, "field");
    }
    if (!done) return done.error();
    gpu->association = field.association;
    gpu->serial = nextSerial();
    return std::unique_ptr<FieldGpu>{std::move(gpu)};
}

int valuesAt(const FieldGpu* field) {
    return field == nullptr ? shared::kValuesNowhere
                            : valuesAt(FieldBuffer::of(*field).association);
}

int valuesAt(data::Association association) {
    switch (association) {
        case data::Association::kVertex: return shared::kValuesAtVertices;
        case data::Association::kCell: return shared::kValuesAtCells;
        case data::Association::kCellVertex: return shared::kValuesAtCorners;
    }
    return shared::kValuesAtVertices;
}

}  // namespace volcast::mesh
