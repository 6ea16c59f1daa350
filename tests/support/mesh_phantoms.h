#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/data/mesh_builder.h"

/// Tetrahedral meshes whose shape and fields are known in closed form.
namespace volcast::support {

using PointFunction = std::function<double(const glm::dvec3&)>;

/// What latticeMesh() makes.
struct LatticeDesc {
    glm::ivec3 cubes{1};
    glm::dvec3 low{0.0};
    glm::dvec3 high{1.0};
    /// Cubes to fill with cells; all where empty.
    std::function<bool(const glm::ivec3&)> keep = {};
    /// Moves a lattice point; stays where empty.
    std::function<glm::dvec3(const glm::dvec3&)> move = {};
};

/// A lattice of cubes, each split into the six tetrahedra around its main diagonal (Kuhn's
/// triangulation, which conforms from cube to cube).
inline data::MeshInput latticeMesh(const LatticeDesc& desc) {
    data::MeshInput mesh;
    const glm::ivec3 n = desc.cubes;
    const auto id = [&n](const glm::ivec3& p) {
        return (static_cast<std::int64_t>(p.z) * (n.y + 1) + p.y) * (n.x + 1) + p.x;
    };
    for (int z = 0; z <= n.z; ++z) {
        for (int y = 0; y <= n.y; ++y) {
            for (int x = 0; x <= n.x; ++x) {
                const glm::dvec3 t = glm::dvec3{x, y, z} / glm::dvec3{n};
                const glm::dvec3 p = desc.low + (desc.high - desc.low) * t;
                mesh.points.push_back(desc.move ? desc.move(p) : p);
            }
        }
    }
    for (int z = 0; z < n.z; ++z) {
        for (int y = 0; y < n.y; ++y) {
            for (int x = 0; x < n.x; ++x) {
                if (desc.keep && !desc.keep({x, y, z})) continue;
                std::array<int, 3> axes{0, 1, 2};
                do {
                    glm::ivec3 p{x, y, z};
                    std::array<std::int64_t, 4> cell{id(p)};
                    for (std::size_t i = 0; i < 3; ++i) {
                        ++p[axes[i]];
                        cell[i + 1] = id(p);
                    }
                    mesh.cells.push_back(cell);
                } while (std::next_permutation(axes.begin(), axes.end()));
            }
        }
    }
    return mesh;
}

/// Cells around the z axis that hide one another in a circle, as seen from the origin: a ring of
/// triangles between two polygons, turned against each other like the blades of a shutter, with a
/// common fourth vertex on the axis.
inline data::MeshInput shutterMesh() {
    constexpr int kBlades = 6;
    constexpr double kTwist = 1.3;  // Radians; more than a polygon's side, so that all edges slant.
    data::MeshInput mesh;
    mesh.points.push_back({0, 0, 2});
    for (int i = 0; i < kBlades; ++i) {
        const double angle = 2.0 * 3.14159265358979 * i / kBlades;
        mesh.points.push_back({std::cos(angle), std::sin(angle), 0.0});
        mesh.points.push_back(4.0 *
                              glm::dvec3{std::cos(angle + kTwist), std::sin(angle + kTwist), 0.0});
    }
    for (std::int64_t i = 0; i < kBlades; ++i) {
        const std::int64_t next = (i + 1) % kBlades;
        mesh.cells.push_back({0, 1 + 2 * i, 1 + 2 * next, 2 + 2 * i});
        mesh.cells.push_back({0, 1 + 2 * next, 2 + 2 * next, 2 + 2 * i});
    }
    return mesh;
}

/// Adds a field of `association` with the values of `f` at points, cell centres or cell corners.
inline void addField(data::MeshInput& mesh, const std::string& name, data::Association association,
                     const PointFunction& f) {
    std::vector<double> values;
    if (association == data::Association::kVertex) {
        for (const auto& p : mesh.points) values.push_back(f(p));
    }
    for (const auto& cell : mesh.cells) {
        if (association == data::Association::kVertex) break;
        glm::dvec3 centre{0.0};
        for (const auto i : cell) centre += 0.25 * mesh.points[static_cast<std::size_t>(i)];
        if (association == data::Association::kCell) values.push_back(f(centre));
        for (const auto i : cell) {
            if (association == data::Association::kCellVertex) {
                values.push_back(f(mesh.points[static_cast<std::size_t>(i)]));
            }
        }
    }
    mesh.fields.push_back({.name = name,
                           .unit = "",
                           .association = association,
                           .steps = {std::move(values)},
                           .times = {}});
}

/// The same mesh with its points, cells and the corners of every cell in another order.
inline data::MeshInput shuffled(const data::MeshInput& mesh, unsigned seed) {
    std::mt19937 random{seed};
    std::vector<std::size_t> points(mesh.points.size());
    std::iota(points.begin(), points.end(), std::size_t{0});
    std::shuffle(points.begin(), points.end(), random);
    std::vector<std::int64_t> newId(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        newId[points[i]] = static_cast<std::int64_t>(i);
    }
    std::vector<std::size_t> cells(mesh.cells.size());
    std::iota(cells.begin(), cells.end(), std::size_t{0});
    std::shuffle(cells.begin(), cells.end(), random);

    data::MeshInput out;
    for (const std::size_t p : points) out.points.push_back(mesh.points[p]);
    std::vector<std::array<std::size_t, 4>> corners;
    for (const std::size_t c : cells) {
        std::array<std::size_t, 4> order{0, 1, 2, 3};
        std::shuffle(order.begin(), order.end(), random);
        corners.push_back(order);
        std::array<std::int64_t, 4> cell{};
        for (std::size_t i = 0; i < 4; ++i) {
            cell[i] = newId[static_cast<std::size_t>(mesh.cells[c][order[i]])];
        }
        out.cells.push_back(cell);
    }
    for (const data::FieldInput& field : mesh.fields) {
        data::FieldInput copy = field;
        for (auto& step : copy.steps) {
            std::vector<double> values;
            if (field.association == data::Association::kVertex) {
                for (const std::size_t p : points) values.push_back(step[p]);
            }
            for (std::size_t c = 0; c < cells.size(); ++c) {
                if (field.association == data::Association::kCell) values.push_back(step[cells[c]]);
                for (std::size_t i = 0; i < 4; ++i) {
                    if (field.association != data::Association::kCellVertex) break;
                    values.push_back(step[4 * cells[c] + corners[c][i]]);
                }
            }
            step = std::move(values);
        }
        out.fields.push_back(std::move(copy));
    }
    return out;
}

/// Moves inner points of the lattice of `cubes` in [low, high] by up to `share` of a cube, always
/// by the same amount for the same point; points on the sides stay.
inline std::function<glm::dvec3(const glm::dvec3&)> jitter(const glm::ivec3& cubes,
                                                           const glm::dvec3& low,
                                                           const glm::dvec3& high, double share) {
    const glm::dvec3 side = (high - low) / glm::dvec3{cubes};
    return [=](const glm::dvec3& p) {
        const glm::ivec3 g{glm::round((p - low) / side)};
        if (glm::any(glm::lessThanEqual(g, glm::ivec3{0})) ||
            glm::any(glm::greaterThanEqual(g, cubes))) {
            return p;
        }
        std::seed_seq seed{g.x, g.y, g.z};
        std::mt19937 random{seed};
        std::uniform_real_distribution<double> offset{-share, share};
        const double dx = offset(random);
        const double dy = offset(random);
        return p + side * glm::dvec3{dx, dy, offset(random)};
    };
}

}  // namespace volcast::support
