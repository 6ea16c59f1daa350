#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/base/result.h"
#include "renderer/data/mesh_builder.h"

namespace volcast::data::load {

/// A flat part of a surface: one outline, and more for what is cut out of it or lies in it.
struct Facet {
    std::vector<std::vector<std::int64_t>> polygons = {};  ///< Rings of point indices.
    std::vector<glm::dvec3> holes = {};  ///< A point in each part that is cut out.
};

struct Region {
    glm::dvec3 inside{0.0};  ///< Any point of it.
    double attribute = 0.0;
    double maxVolume = -1.0;  ///< Of a cell, used with the switch "a"; negative: none.
};

/// What TetGen calls a piecewise linear complex.
struct Surface {
    std::vector<glm::dvec3> points = {};
    std::vector<FieldInput> attributes = {};  ///< Vertex fields of one step.
    std::vector<Facet> facets = {};
    std::vector<glm::dvec3> holes = {};  ///< A point in each hollow that stays empty.
    std::vector<Region> regions = {};
};

struct Tetrahedra {
    MeshInput mesh;
    std::size_t addedPoints = 0;  ///< That the surface does not have.
};

/// Fills a surface with tetrahedra. With regions, each cell's is the field "region". Attributes of
/// points are kept where TetGen adds no points.
///
/// Errors: kInvalidArgument (switches that are not allowed, a surface that crosses itself or is
/// not closed, in words), kLimitExceeded (memory).
Result<Tetrahedra> tetrahedralize(const Surface& surface, const std::string& switches);

/// The Delaunay mesh of points. Errors: kInvalidArgument (all in one plane), kLimitExceeded.
Result<Tetrahedra> delaunay(const Surface& points);

}  // namespace volcast::data::load
