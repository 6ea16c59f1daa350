#pragma once

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

#include "renderer/data/field.h"

/// The bytes of a packed dataset: a header, a table of sections, the sections in the table's order,
/// each starting at a multiple of kAlignment. Native byte order: it never leaves the machine.
///
/// Mesh: kMesh, kVertices, kCells, kNeighbours, kBoundaryFaces, kBoundaryNeighbours, then for each
/// field kField, kText (name), kText (unit), kTimes, and one kValues a step.
/// Volume: kVolume, then for each channel kChannel, kText, kText, and kVoxels and kBricks for each
/// level of its pyramid, the finest first. Voxels lie in slices, x fastest: a brick is read by its
/// rows, wherever they are, and nothing else of the file is touched.
namespace volcast::data::packed {

inline constexpr std::size_t kAlignment = 64;
inline constexpr std::array<char, 8> kMagic{'V', 'C', 'S', 'T', 'D', 'A', 'T', '2'};

enum class Kind : std::uint64_t { kMesh = 1, kVolume = 2 };

enum class Tag : std::uint64_t {
    kMesh = 1,
    kVertices,
    kCells,
    kNeighbours,
    kBoundaryFaces,
    kBoundaryNeighbours,
    kField,
    kText,
    kTimes,
    kValues,
    kVolume,
    kChannel,
    kVoxels,
    kBricks,
};

struct Header {
    std::array<char, 8> magic = kMagic;
    Kind kind = Kind::kMesh;
    std::uint64_t sections = 0;
    std::uint64_t bytes = 0;  ///< Of the whole file.
};

struct Entry {
    Tag tag = Tag::kMesh;
    std::uint64_t elementBytes = 0;
    std::uint64_t offset = 0;  ///< From the start of the file.
    std::uint64_t count = 0;   ///< Elements.
};

struct MeshHeader {
    glm::dvec3 origin{0.0};
    std::uint64_t cellsWithoutVolume = 0;
    std::uint64_t cellsInverted = 0;
    std::uint64_t cellsDoubled = 0;
    std::uint64_t facesNotManifold = 0;
    std::uint64_t fields = 0;
    std::uint64_t convex = 0;
};

struct FieldHeader {
    Range range;
    std::uint64_t association = 0;
    std::uint64_t steps = 0;
    std::uint64_t cellsWithoutValue = 0;
};

struct ChannelHeader {
    Range range;
    std::uint64_t voxelsWithoutValue = 0;
};

struct VolumeHeader {
    glm::dvec3 spacing{1.0};
    glm::dvec3 origin{0.0};
    glm::dmat3 direction{1.0};
    glm::ivec3 size{1};
    std::uint32_t type = 0;
    std::uint64_t channels = 0;
    std::uint64_t coarserLevels = 0;
};

}  // namespace volcast::data::packed
