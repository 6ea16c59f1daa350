#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/data/mesh.h"

namespace volcast::mesh {

/// Where lines of sight come from.
struct Viewpoint {
    bool perspective = true;
    glm::dvec3 at{0.0};  ///< Data space: the eye, or the direction of all lines of sight.
};

/// What is known of an order after it was made.
struct OrderReport {
    std::int64_t cells = 0;        ///< That were sorted; 0: the model needs no order.
    bool byPowerDistance = false;  ///< The mesh is Delaunay; otherwise by centroids.
    /// Neighbours that the sort put in the wrong order, and how many of them are left after cells
    /// were moved behind those that hide them: only neighbours that hide one another in a circle.
    std::int64_t sortViolations = 0;
    std::int64_t orderViolations = 0;
    double milliseconds = 0.0;  ///< Of all this, on the CPU.
};

/// Puts the cells of one mesh in the order in which lines of sight meet them.
///
/// In a Delaunay mesh a line meets cells in the order of the power distances of the eye to their
/// circumscribed spheres, |c - eye|^2 - R^2, in other meshes almost in the order of the distances
/// to their centroids. Cells that share a face must have the one on the eye's side of the face
/// first; where the keys say otherwise (no Delaunay mesh, or equal keys as in a lattice), cells are
/// moved. Cells without a common face, as across a hollow, are ordered by their keys alone.
/// Sources: H. Edelsbrunner, An Acyclicity Theorem for Cell Complexes in d Dimensions,
/// Combinatorica 10(3), 1990 (power distance); P. Williams, Visibility Ordering Meshed Polyhedra,
/// ACM TOG 11(2), 1992 (moving behind what is before).
class VisibilityOrder {
public:
    /// `mesh` must outlive this. Takes O(cells) time and 73 bytes a cell.
    explicit VisibilityOrder(const data::Mesh& mesh);

    /// Cells by number, the nearest first; good until the next call.
    std::span<const std::uint32_t> sort(const Viewpoint& viewpoint);
    [[nodiscard]] const OrderReport& report() const noexcept { return report_; }

private:
    /// A cell and its key as a number that sorts like it.
    struct Item {
        std::uint64_t key = 0;
        std::uint32_t cell = 0;
    };

    void sortByKeys(const Viewpoint& viewpoint);
    void findBefore(const Viewpoint& viewpoint);
    [[nodiscard]] std::int64_t violations();
    void moveBehind();

    const data::Mesh* mesh_;
    std::vector<glm::dvec4> sites_;  ///< xyz: centre, w: |centre|^2, less the squared radius.
    std::vector<Item> items_, scratch_;
    std::vector<std::uint32_t> order_, rank_;
    std::vector<std::uint8_t> before_;  ///< Bit i: the neighbour across face i is to come first.
    OrderReport report_;
};

}  // namespace volcast::mesh
