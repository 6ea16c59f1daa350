#include "renderer/data/load/demo.h"

#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>

#include "renderer/data/load/tetrahedralize.h"

namespace volcast::data::load {

namespace {

// The plate in centimetres: its middle is at the origin, the hole's axis is z.
constexpr double kHalfLength = 2.5;
constexpr double kHalfWidth = 1.75;
constexpr double kHalfThickness = 0.4;
constexpr double kHoleRadius = 0.7;
constexpr int kHoleCorners = 48;
constexpr const char* kSwitches = "pq1.3a0.0009";

/// Von Mises stress of an infinite plate with a hole, pulled along x with stress 1.
/// Source: G. Kirsch, VDI-Zeitschrift 42, 1898; in polar coordinates around the hole.
double kirschStress(double x, double y) {
    const double r2 = std::max(x * x + y * y, kHoleRadius * kHoleRadius);
    const double q = kHoleRadius * kHoleRadius / r2;
    const double angle = 2.0 * std::atan2(y, x);
    const double radial = 0.5 * (1 - q) + 0.5 * (1 - 4 * q + 3 * q * q) * std::cos(angle);
    const double hoop = 0.5 * (1 + q) - 0.5 * (1 + 3 * q * q) * std::cos(angle);
    const double shear = -0.5 * (1 + 2 * q - 3 * q * q) * std::sin(angle);
    return std::sqrt(radial * radial - radial * hoop + hoop * hoop + 3 * shear * shear);
}

/// Tension of 60 MPa and bending that adds 30 MPa at the upper face and takes it at the lower.
double stressMPa(const glm::dvec3& p) {
    return (60.0 + 30.0 * p.z / kHalfThickness) * kirschStress(p.x, p.y);
}

using Ring = std::vector<std::int64_t>;

/// A ring of points at height -kHalfThickness and the same at +kHalfThickness, joined by walls.
std::pair<Ring, Ring> addWalls(const std::vector<glm::dvec2>& outline, Surface& surface) {
    std::pair<Ring, Ring> rings;
    for (const glm::dvec2& p : outline) {
        const auto next = static_cast<std::int64_t>(surface.points.size());
        surface.points.emplace_back(p, -kHalfThickness);
        surface.points.emplace_back(p, kHalfThickness);
        rings.first.push_back(next);
        rings.second.push_back(next + 1);
    }
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const std::size_t j = (i + 1) % outline.size();
        surface.facets.push_back(
            {.polygons = {{rings.first[i], rings.first[j], rings.second[j], rings.second[i]}}});
    }
    return rings;
}

Surface plate() {
    Surface surface;
    std::vector<glm::dvec2> hole;
    for (int i = 0; i < kHoleCorners; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kHoleCorners;
        hole.push_back(kHoleRadius * glm::dvec2{std::cos(angle), std::sin(angle)});
    }
    const auto outer = addWalls({{-kHalfLength, -kHalfWidth},
                                 {kHalfLength, -kHalfWidth},
                                 {kHalfLength, kHalfWidth},
                                 {-kHalfLength, kHalfWidth}},
                                surface);
    const auto inner = addWalls(hole, surface);
    surface.facets.push_back(
        {.polygons = {outer.first, inner.first}, .holes = {{0.0, 0.0, -kHalfThickness}}});
    surface.facets.push_back(
        {.polygons = {outer.second, inner.second}, .holes = {{0.0, 0.0, kHalfThickness}}});
    surface.holes.emplace_back(0.0);
    return surface;
}

}  // namespace

Result<Loaded> demoMesh() {
    auto made = tetrahedralize(plate(), kSwitches);
    if (!made) return made.error();
    MeshInput& mesh = made->mesh;
    std::vector<double> atPoints(mesh.points.size());
    for (std::size_t i = 0; i < atPoints.size(); ++i) atPoints[i] = stressMPa(mesh.points[i]);
    std::vector<double> inCells(mesh.cells.size());
    for (std::size_t c = 0; c < inCells.size(); ++c) {
        for (const std::int64_t v : mesh.cells[c]) {
            inCells[c] += 0.25 * atPoints[static_cast<std::size_t>(v)];
        }
    }
    mesh.fields = {{.name = "von Mises stress",
                    .unit = "MPa",
                    .association = Association::kVertex,
                    .steps = {std::move(atPoints)},
                    .times = {0.0}},
                   {.name = "stress, cell mean",
                    .unit = "MPa",
                    .association = Association::kCell,
                    .steps = {std::move(inCells)},
                    .times = {0.0}}};
    return Loaded{.input = std::move(mesh), .format = "demo"};
}

Result<Loaded> demoVolume() {
    // |psi|^2 of n = 3, l = 2, m = 0 without its constant: (r^2 exp(-r/3) (3 cos^2 - 1))^2, with r
    // in Bohr radii; scaled to a largest value of about 1.
    constexpr int kSize = 128;
    constexpr double kHalfBohr = 21.0;
    constexpr double kSpacing = 2.0 * kHalfBohr / (kSize - 1);
    constexpr double kScale = 0.1026;
    std::vector<float> density;
    density.reserve(std::size_t{kSize} * kSize * kSize);
    for (int k = 0; k < kSize; ++k) {
        for (int j = 0; j < kSize; ++j) {
            for (int i = 0; i < kSize; ++i) {
                const glm::dvec3 p = glm::dvec3{i, j, k} * kSpacing - kHalfBohr;
                const double angular = 3.0 * p.z * p.z - glm::dot(p, p);
                const double wave = kScale * angular * std::exp(-glm::length(p) / 3.0);
                density.push_back(static_cast<float>(wave * wave));
            }
        }
    }
    VolumeInput volume{.size = glm::ivec3{kSize},
                       .spacing = glm::dvec3{kSpacing},
                       .origin = glm::dvec3{-kHalfBohr},
                       .type = VoxelType::kF32};
    std::vector<std::byte> voxels(density.size() * sizeof(float));
    std::memcpy(voxels.data(), density.data(), voxels.size());
    volume.channels.push_back({.name = "electron density", .voxels = std::move(voxels)});
    return Loaded{.input = std::move(volume), .format = "demo"};
}

}  // namespace volcast::data::load
