#pragma once

#include <string>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/data/mesh.h"
#include "renderer/data/value_samples.h"
#include "renderer/data/volume.h"

namespace volcast::data {

/// What one import yields: one mesh or one volume.
using Dataset = std::variant<Mesh, Volume>;

struct Box {
    glm::dvec3 min{0.0};
    glm::dvec3 max{0.0};
};

/// One field or channel as users see it.
struct FieldSummary {
    std::string name;
    std::string unit;
    Association association = Association::kVertex;  ///< kVertex for voxel channels.
    Range range;
    int steps = 1;
    Spread spread = {};                   ///< Of samples of its values.
    std::uint64_t cellsWithoutValue = 0;  ///< Cells of a mesh with a NaN in any step.
    std::uint64_t voxelsWithoutValue = 0;
};

/// What is worth knowing of a dataset without holding it; all that plans and clients need.
struct DatasetSummary {
    bool isMesh = true;
    Box bounds;  ///< World, axis-aligned.
    std::uint64_t cells = 0;
    std::uint64_t vertices = 0;
    std::uint64_t boundaryFaces = 0;
    bool convex = false;
    std::uint64_t cellsWithoutVolume = 0;
    std::uint64_t cellsInverted = 0;
    std::uint64_t cellsDoubled = 0;
    std::uint64_t facesNotManifold = 0;
    glm::ivec3 voxels{0};
    glm::dvec3 spacing{0.0};
    VoxelType voxelType = VoxelType::kF32;
    int coarserLevels = 0;  ///< Of a volume's pyramid.
    std::vector<FieldSummary> fields;
    std::uint64_t bytes = 0;  ///< Size of the data as drawn.
};

/// Spreads are those of at most kMaxSamples evenly spread samples.
DatasetSummary summarize(const Dataset& dataset);

/// What users should know of the data before they trust a picture of it; one sentence each.
std::vector<std::string> warningsOf(const DatasetSummary& summary);

}  // namespace volcast::data
