#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/data/field.h"
#include "renderer/reference/linear_map.h"
#include "renderer/reference/piece.h"
#include "renderer/reference/ray.h"

namespace volcast::reference {

/// A part of a ray in one cell: f and g run linearly from its front to its back.
struct Part {
    double front = 0.0, length = 0.0;  ///< Distance of its near end; world length, > 0.
    double f0 = 0.0, f1 = 0.0;
    double g0 = 0.0, g1 = 0.0;
    int cell = -1;
};

/// The parts of `pieces` that have a length within `span` and, where there is an interval, have
/// min <= f <= max.
void cut(std::span<const Piece> pieces, const Span& span,
         const std::optional<data::Range>& interval, std::vector<Part>& parts);

/// What the integrals over parts need.
struct Matter {
    const LinearMap* colour = nullptr;      ///< C, of f.
    const LinearMap* extinction = nullptr;  ///< rho, of g.
};

/// int C(f) rho(g) T ds premultiplied, and 1 - T.
glm::dvec4 volume(std::span<const Part> parts, const Matter& matter, std::vector<double>& scratch);
/// int rho(g) ds.
double opticalDepth(std::span<const Part> parts, const LinearMap& extinction,
                    std::vector<double>& scratch);
/// int C(f) ds.
glm::dvec3 colourIntegral(std::span<const Part> parts, const LinearMap& colour,
                          std::vector<double>& scratch);
/// Smallest and largest f; nothing without parts.
struct Extremes {
    double min = std::numeric_limits<double>::infinity();
    double max = -std::numeric_limits<double>::infinity();
};
std::optional<Extremes> extremes(std::span<const Part> parts);
/// The largest red, green and blue of C(f), each by itself; nothing without parts.
std::optional<glm::dvec3> largestColour(std::span<const Part> parts, const LinearMap& colour);

/// Where a ray first takes one of some levels.
struct LevelHit {
    double distance = 0.0;
    double level = 0.0;
    double g = 0.0;
    int cell = -1;
    int crossings = 0;  ///< Of this level, on all of the ray.
};
/// `levels` ascend. A level c is taken in a piece where (f0 < c) != (f1 < c); never between pieces.
std::optional<LevelHit> firstLevel(std::span<const Piece> pieces, const Span& span,
                                   std::span<const double> levels);

}  // namespace volcast::reference
