#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/base/result.h"
#include "renderer/data/mesh_builder.h"

namespace volcast::data {

/// A mesh in Morton order, and where each of its items stood in the input.
struct OrderedMesh {
    glm::dvec3 origin{0.0};
    std::vector<glm::vec3> vertices;        ///< Relative to `origin`.
    std::vector<glm::dvec3> exactVertices;  ///< The same before they were rounded to float32.
    std::vector<glm::ivec4> cells;          ///< In the form that Mesh promises.
    std::vector<std::uint32_t> vertexSource;
    std::vector<std::uint32_t> cellSource;
    /// Corner of the input cell that became corner i.
    std::vector<std::array<std::uint8_t, 4>> cornerSource;
    std::uint64_t cellsWithoutVolume = 0;
    std::uint64_t cellsInverted = 0;
    std::uint64_t cellsDoubled = 0;
};

/// Rebases, orients, joins and sorts a checked input, as buildMesh() promises.
///
/// Errors: kInvalidArgument (no cell has a volume; wider than float32 can hold).
Result<OrderedMesh> orderMesh(const MeshInput& input);

/// Sign of the volume of (a, b, c, d): 1, -1, or 0 where double cannot tell it from 0.
int orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);

}  // namespace volcast::data
