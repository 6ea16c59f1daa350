#include "renderer/data/packed_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>

#include "renderer/data/mesh_builder.h"
#include "renderer/data/mesh_restrict.h"
#include "renderer/data/pyramid.h"
#include "renderer/data/text.h"
#include "renderer/data/volume_builder.h"

namespace volcast::data::packed {

namespace {

Error damaged(const std::string& what) {
    return fail(ErrorCode::kInvalidArgument, "packed dataset: " + what);
}

Error damagedAt(const char* what, std::size_t i) {
    return damaged(std::string{what} + " " + std::to_string(i) + " is damaged");
}

bool allFinite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool isId(std::int32_t id, std::size_t count) {
    return id >= 0 && static_cast<std::size_t>(id) < count;
}

bool validRange(const Range& range) {
    return std::isfinite(range.min) && std::isfinite(range.max) && range.min <= range.max;
}

Result<void> checkName(const std::string& name, const std::string& unit,
                       std::set<std::string>& names) {
    if (name.size() > kMaxNameBytes || unit.size() > kMaxNameBytes || !isUtf8(name) ||
        !isUtf8(unit)) {
        return damaged("a name is too long or no UTF-8");
    }
    if (name.empty() || !names.insert(name).second) {
        return damaged("the name '" + name + "' is empty or occurs twice");
    }
    return {};
}

bool distinct(const glm::ivec4& c) {
    return c.x != c.y && c.x != c.z && c.x != c.w && c.y != c.z && c.y != c.w && c.z != c.w;
}

Result<void> checkCells(const Mesh& mesh) {
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        if (!allFinite(mesh.vertices[i])) return damagedAt("vertex", i);
    }
    for (std::size_t t = 0; t < mesh.cells.size(); ++t) {
        const glm::ivec4 cell = mesh.cells[t];
        for (int i = 0; i < 4; ++i) {
            if (!isId(cell[i], mesh.vertices.size())) return damagedAt("cell", t);
        }
        if (!distinct(cell)) return damagedAt("cell", t);
    }
    return {};
}

/// The vertices of the face opposite vertex `i`, ascending.
std::array<std::int32_t, 3> faceOf(const glm::ivec4& cell, int i) {
    std::array<std::int32_t, 3> face{cell[(i + 1) & 3], cell[(i + 2) & 3], cell[(i + 3) & 3]};
    if (face[0] > face[1]) std::swap(face[0], face[1]);
    if (face[1] > face[2]) std::swap(face[1], face[2]);
    if (face[0] > face[1]) std::swap(face[0], face[1]);
    return face;
}

/// True where the cell across face `i` of cell `t` names `t` across the same three vertices.
bool neighbourAgrees(const Mesh& mesh, std::size_t t, int i) {
    const std::int32_t other = mesh.neighbours[t][i];
    if (other == -1) return true;
    if (!isId(other, mesh.cells.size())) return false;
    const auto o = static_cast<std::size_t>(other);
    for (int j = 0; j < 4; ++j) {
        if (mesh.neighbours[o][j] == static_cast<std::int32_t>(t) &&
            faceOf(mesh.cells[o], j) == faceOf(mesh.cells[t], i)) {
            return o != t;
        }
    }
    return false;
}

Result<void> checkNeighbours(const Mesh& mesh) {
    for (std::size_t t = 0; t < mesh.cells.size(); ++t) {
        for (int i = 0; i < 4; ++i) {
            if (!neighbourAgrees(mesh, t, i)) return damagedAt("the neighbour of cell", t);
        }
    }
    return {};
}

/// True where the three vertices are different ones of the cell.
bool isFaceOf(const glm::ivec4& cell, const glm::ivec3& face) {
    const auto has = [&cell](std::int32_t id) {
        return id == cell.x || id == cell.y || id == cell.z || id == cell.w;
    };
    return has(face.x) && has(face.y) && has(face.z) && face.x != face.y && face.y != face.z &&
           face.z != face.x;
}

Result<void> checkBoundary(const Mesh& mesh) {
    const std::size_t count = mesh.boundaryFaces.size();
    if (mesh.boundaryNeighbours.size() != count || count > 4 * mesh.cells.size()) {
        return damaged("wrong number of boundary faces");
    }
    for (std::size_t b = 0; b < count; ++b) {
        const BoundaryFace& face = mesh.boundaryFaces[b];
        if (!isId(face.cell, mesh.cells.size()) ||
            !isFaceOf(mesh.cells[static_cast<std::size_t>(face.cell)], face.vertices)) {
            return damagedAt("boundary face", b);
        }
        for (int i = 0; i < 3; ++i) {
            const std::int32_t other = mesh.boundaryNeighbours[b][i];
            if (other != -1 && !isId(other, count)) return damagedAt("boundary face", b);
        }
    }
    return {};
}

Result<void> checkField(const Field& field, const Mesh& mesh) {
    if (field.steps.empty() || field.steps.size() > kMaxSteps ||
        field.steps.size() != field.times.size()) {
        return damaged("field '" + field.name + "' has a wrong number of steps or times");
    }
    for (const double time : field.times) {
        if (!std::isfinite(time)) return damaged("field '" + field.name + "': a time is damaged");
    }
    if (!validRange(field.range)) return damaged("field '" + field.name + "': range is damaged");
    const std::size_t expected = field.association == Association::kVertex ? mesh.vertices.size()
                                 : field.association == Association::kCell ? mesh.cells.size()
                                                                           : 4 * mesh.cells.size();
    for (const auto& step : field.steps) {
        if (step.size() != expected) {
            return damaged("field '" + field.name + "': " + std::to_string(step.size()) +
                           " values, expected " + std::to_string(expected));
        }
        for (std::size_t i = 0; i < expected; ++i) {
            // NaN is outside neither; infinity is, as the range is finite.
            if (step[i] < field.range.min || step[i] > field.range.max) {
                return damaged("field '" + field.name + "': value " + std::to_string(i) +
                               " lies outside the field's range");
            }
        }
    }
    if (field.cellsWithoutValue != countCellsWithoutValue(mesh, field)) {
        return damaged("field '" + field.name + "': wrong number of cells without a value");
    }
    return {};
}

/// `missing`: voxels may be NaN.
template <class T>
bool voxelsWithin(std::span<const std::byte> bytes, const Range& range, bool missing) {
    // Sections are aligned to 64 bytes.
    const std::span<const T> voxels{reinterpret_cast<const T*>(bytes.data()),
                                    bytes.size() / sizeof(T)};
    return std::all_of(voxels.begin(), voxels.end(), [&range, missing](T voxel) {
        const auto value = static_cast<float>(voxel);
        return (value >= range.min && value <= range.max) || (missing && std::isnan(value));
    });
}

bool voxelsWithin(VoxelType type, std::span<const std::byte> bytes, const Channel& channel) {
    const Range& range = channel.range;
    const bool missing = channel.voxelsWithoutValue > 0;
    switch (type) {
        case VoxelType::kU8: return voxelsWithin<std::uint8_t>(bytes, range, missing);
        case VoxelType::kU16: return voxelsWithin<std::uint16_t>(bytes, range, missing);
        case VoxelType::kI16: return voxelsWithin<std::int16_t>(bytes, range, missing);
        case VoxelType::kF32: return voxelsWithin<float>(bytes, range, missing);
    }
    return false;
}

Result<void> checkGrid(const Volume& volume) {
    for (int i = 0; i < 3; ++i) {
        if (volume.size[i] < 1 || volume.size[i] > kMaxVolumeSide) {
            return damaged("size of the volume");
        }
        if (!(volume.spacing[i] > 0.0) || !std::isfinite(volume.spacing[i])) {
            return damaged("spacing of the volume");
        }
        if (!allFinite(volume.direction[i])) return damaged("direction of the volume");
    }
    if (!allFinite(volume.origin)) return damaged("origin of the volume");
    constexpr double kTolerance = 1e-9;
    const glm::dmat3 product = glm::transpose(volume.direction) * volume.direction;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            if (std::abs(product[i][j] - (i == j ? 1.0 : 0.0)) > kTolerance) {
                return damaged("direction of the volume");
            }
        }
    }
    return {};
}

std::size_t product(const glm::ivec3& v) {
    return static_cast<std::size_t>(v.x) * static_cast<std::size_t>(v.y) *
           static_cast<std::size_t>(v.z);
}

Result<void> checkLevel(const Channel& channel, const Volume& volume, int level,
                        const base::Array<std::byte>& voxels, const base::Array<glm::vec2>& bricks,
                        Trust trust) {
    const std::string where = "channel '" + channel.name + "': " +
                              (level > 0 ? "level " + std::to_string(level) + ": " : std::string{});
    if (voxels.size() != product(volume.levelSize(level)) * voxelBytes(volume.type)) {
        return damaged(where + "wrong number of bytes");
    }
    if (bricks.size() != product(volume.brickGrid(level))) {
        return damaged(where + "wrong number of bricks");
    }
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (const glm::vec2& brick : bricks) {
        const bool without = brick == glm::vec2{kInfinity, -kInfinity};
        if (without && channel.voxelsWithoutValue > 0) continue;
        if (!(brick.x >= channel.range.min && brick.x <= brick.y && brick.y <= channel.range.max)) {
            return damaged(where + "a brick is damaged");
        }
    }
    if (trust == Trust::kNone && !voxelsWithin(volume.type, voxels.span(), channel)) {
        return damaged(where + "a voxel lies outside the channel's range");
    }
    return {};
}

Result<void> checkChannel(const Channel& channel, const Volume& volume, Trust trust) {
    const std::string where = "channel '" + channel.name + "': ";
    if (!validRange(channel.range)) return damaged(where + "range is damaged");
    const int coarser = pyramidLevels(volume.size);
    if (channel.coarser.size() != static_cast<std::size_t>(coarser)) {
        return damaged(where + "wrong number of levels");
    }
    if (trust == Trust::kNone) {
        const auto counted = countWithoutValue(volume, channel.name, channel.voxels.span());
        if (!counted || *counted != channel.voxelsWithoutValue) {
            return damaged(where + "wrong number of voxels without a value");
        }
    }
    auto finest = checkLevel(channel, volume, 0, channel.voxels, channel.bricks, trust);
    if (!finest) return finest;
    for (int level = 1; level <= coarser; ++level) {
        const ChannelLevel& one = channel.coarser[static_cast<std::size_t>(level) - 1];
        auto checked = checkLevel(channel, volume, level, one.voxels, one.bricks, trust);
        if (!checked) return checked;
    }
    return {};
}

}  // namespace

Result<void> check(const Mesh& mesh) {
    if (!allFinite(mesh.origin)) return damaged("origin of the mesh");
    if (mesh.cells.empty() || mesh.cells.size() > kMaxMeshItems || mesh.vertices.empty() ||
        mesh.vertices.size() > kMaxMeshItems || mesh.neighbours.size() != mesh.cells.size()) {
        return damaged("wrong number of cells or vertices");
    }
    if (auto cells = checkCells(mesh); !cells) return cells;
    if (auto neighbours = checkNeighbours(mesh); !neighbours) return neighbours;
    if (auto boundary = checkBoundary(mesh); !boundary) return boundary;
    if (mesh.fields.size() > kMaxFields) return damaged("too many fields");
    std::set<std::string> names;
    for (const Field& field : mesh.fields) {
        if (auto name = checkName(field.name, field.unit, names); !name) return name;
        if (auto checked = checkField(field, mesh); !checked) return checked;
    }
    return {};
}

Result<void> check(const Volume& volume, Trust trust) {
    if (auto grid = checkGrid(volume); !grid) return grid;
    if (volume.channels.empty() || volume.channels.size() > kMaxChannels) {
        return damaged("wrong number of channels");
    }
    std::set<std::string> names;
    for (const Channel& channel : volume.channels) {
        if (auto name = checkName(channel.name, channel.unit, names); !name) return name;
        if (auto checked = checkChannel(channel, volume, trust); !checked) return checked;
    }
    return {};
}

}  // namespace volcast::data::packed
