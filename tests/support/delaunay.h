#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/data/mesh_builder.h"

namespace volcast::support {

/// A Delaunay mesh point by point: the cells whose spheres hold a new point make way for cells from
/// their common outline to it.
///
/// Source: A. Bowyer, Computing Dirichlet tessellations, The Computer Journal 24(2), 1981.
class DelaunayBuilder {
public:
    /// Of points in general position within [-1, 1]^3. Of the hull flat cells are missing.
    static data::MeshInput build(const std::vector<glm::dvec3>& points) {
        DelaunayBuilder builder;
        // Far away, but near enough for exact spheres: only cells without these corners are kept.
        for (const glm::dvec3 corner :
             {glm::dvec3{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}}) {
            builder.points_.push_back(64.0 * corner);
        }
        builder.add({0, 1, 2, 3});
        for (const glm::dvec3& point : points) builder.insert(point);
        data::MeshInput mesh;
        mesh.points = points;
        for (const Cell& cell : builder.cells_) {
            if (*std::ranges::min_element(cell.corners) < 4) continue;
            auto& corners = mesh.cells.emplace_back();
            for (std::size_t i = 0; i < 4; ++i) corners[i] = cell.corners[i] - 4;
        }
        return mesh;
    }

private:
    struct Cell {
        std::array<std::int64_t, 4> corners;
        glm::dvec3 centre;
        double radius2;
    };

    void add(const std::array<std::int64_t, 4>& corners) {
        const auto at = [&](std::size_t i) {
            return points_[static_cast<std::size_t>(corners[i])];
        };
        const glm::dvec3 u = at(1) - at(0);
        const glm::dvec3 v = at(2) - at(0);
        const glm::dvec3 w = at(3) - at(0);
        const glm::dvec3 middle =
            (glm::dot(u, u) * glm::cross(v, w) + glm::dot(v, v) * glm::cross(w, u) +
             glm::dot(w, w) * glm::cross(u, v)) /
            (2.0 * glm::dot(u, glm::cross(v, w)));
        cells_.push_back({corners, at(0) + middle, glm::dot(middle, middle)});
    }

    void insert(const glm::dvec3& point) {
        std::map<std::array<std::int64_t, 3>, int>
            faces;  // Sorted corners; how many cells have it.
        const auto holds = [&](const Cell& cell) {
            const glm::dvec3 offset = point - cell.centre;
            if (glm::dot(offset, offset) >= cell.radius2) return false;
            for (std::size_t left = 0; left < 4; ++left) {
                std::array<std::int64_t, 3> face{};
                for (std::size_t i = 0; i < 3; ++i) {
                    face[i] = cell.corners[i < left ? i : i + 1];
                }
                std::ranges::sort(face);
                ++faces[face];
            }
            return true;
        };
        std::erase_if(cells_, holds);
        const auto id = static_cast<std::int64_t>(points_.size());
        points_.push_back(point);
        for (const auto& [face, count] : faces) {
            if (count == 1) add({face[0], face[1], face[2], id});
        }
    }

    std::vector<glm::dvec3> points_;
    std::vector<Cell> cells_;
};

/// The Delaunay mesh of `count` random points in [-1, 1]^3, always the same for one `seed`.
///
/// Coordinates are float32 numbers and the bounds are symmetric, so that data::buildMesh(), which
/// takes their middle off, rounds nothing: the mesh stays exactly Delaunay.
inline data::MeshInput randomDelaunay(int count, unsigned seed) {
    std::mt19937 random{seed};
    std::uniform_real_distribution<float> place{-1.0F, 1.0F};
    std::vector<glm::dvec3> points;
    for (int i = 0; i < count; ++i) {
        const float x = place(random);
        const float y = place(random);
        glm::dvec3& point = points.emplace_back(x, y, place(random));
        if (i < 6) point[i / 2] = i % 2 == 0 ? -1.0 : 1.0;
    }
    return DelaunayBuilder::build(points);
}

}  // namespace volcast::support
