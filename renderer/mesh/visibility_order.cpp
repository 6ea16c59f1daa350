#include "renderer/mesh/visibility_order.h"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <numeric>

#include "renderer/data/mesh_adjacency.h"

namespace volcast::mesh {

namespace {

// A pass sorts by 11 bits. Of a key's 64 bits the upper 44 count, which leaves 32 bits of mantissa:
// what these cannot tell apart, neighbours put right.
constexpr int kDigitBits = 11;
constexpr int kPasses = 4;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;

std::size_t digit(std::uint64_t key, int pass) {
    return (key >> (64 - kDigitBits * (kPasses - pass))) & (kDigits - 1);
}

/// A number that sorts like `value`.
std::uint64_t sortable(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    constexpr std::uint64_t kSign = std::uint64_t{1} << 63;
    return (bits & kSign) != 0 ? ~bits : bits | kSign;
}

glm::dvec3 vertexOf(const data::Mesh& mesh, std::size_t cell, int corner) {
    return glm::dvec3{mesh.vertices[static_cast<std::size_t>(mesh.cells[cell][corner])]};
}

/// Centre of the sphere through a cell's corners; not finite where the cell is flat.
glm::dvec3 circumcentre(const data::Mesh& mesh, std::size_t cell) {
    const glm::dvec3 origin = vertexOf(mesh, cell, 0);
    const glm::dvec3 u = vertexOf(mesh, cell, 1) - origin;
    const glm::dvec3 v = vertexOf(mesh, cell, 2) - origin;
    const glm::dvec3 w = vertexOf(mesh, cell, 3) - origin;
    const glm::dvec3 vw = glm::cross(v, w);
    return origin + (glm::dot(u, u) * vw + glm::dot(v, v) * glm::cross(w, u) +
                     glm::dot(w, w) * glm::cross(u, v)) /
                        (2.0 * glm::dot(u, vw));
}

/// The power distance of a point to the sphere of `site`.
double power(const glm::dvec4& site, const glm::dvec3& point) {
    return glm::dot(point, point) - 2.0 * glm::dot(glm::dvec3{site}, point) + site.w;
}

/// Sites of the circumscribed spheres; empty where the mesh is not Delaunay: where a neighbour's
/// corner is deeper in a cell's sphere than rounding explains.
std::vector<glm::dvec4> spheresOf(const data::Mesh& mesh) {
    std::vector<glm::dvec4> sites(mesh.cells.size());
    for (std::size_t t = 0; t < sites.size(); ++t) {
        const glm::dvec3 centre = circumcentre(mesh, t);
        const glm::dvec3 corner = vertexOf(mesh, t, 0);
        sites[t] = {centre, 2.0 * glm::dot(centre, corner) - glm::dot(corner, corner)};
        if (!(glm::dot(centre, centre) < 1e300)) return {};
    }
    constexpr double kRounding = 1e-9;  // Of the squared radius, for corners in float32.
    for (std::size_t t = 0; t < sites.size(); ++t) {
        const glm::dvec3 centre{sites[t]};
        const double radius2 = glm::dot(centre, centre) - sites[t].w;
        for (int i = 0; i < 4; ++i) {
            const int other = mesh.neighbours[t][i];
            if (other < 0) continue;
            for (int corner = 0; corner < 4; ++corner) {
                const glm::dvec3 point = vertexOf(mesh, static_cast<std::size_t>(other), corner);
                if (power(sites[t], point) < -kRounding * radius2) return {};
            }
        }
    }
    return sites;
}

std::vector<glm::dvec4> centroidsOf(const data::Mesh& mesh) {
    std::vector<glm::dvec4> sites(mesh.cells.size());
    for (std::size_t t = 0; t < sites.size(); ++t) {
        glm::dvec3 centre{0.0};
        for (int i = 0; i < 4; ++i) centre += 0.25 * vertexOf(mesh, t, i);
        sites[t] = {centre, glm::dot(centre, centre)};
    }
    return sites;
}

}  // namespace

VisibilityOrder::VisibilityOrder(const data::Mesh& mesh)
    : mesh_{&mesh}, sites_{spheresOf(mesh)}, order_(mesh.cells.size()), rank_(mesh.cells.size()) {
    report_.cells = static_cast<std::int64_t>(mesh.cells.size());
    report_.byPowerDistance = !sites_.empty();
    if (sites_.empty()) sites_ = centroidsOf(mesh);
    items_.resize(sites_.size());
    scratch_.resize(sites_.size());
    before_.resize(sites_.size());
}

std::span<const std::uint32_t> VisibilityOrder::sort(const Viewpoint& viewpoint) {
    const auto start = std::chrono::steady_clock::now();
    sortByKeys(viewpoint);
    findBefore(viewpoint);
    report_.sortViolations = violations();
    report_.orderViolations = report_.sortViolations;
    if (report_.sortViolations > 0) {
        moveBehind();
        report_.orderViolations = violations();
    }
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - start;
    report_.milliseconds = taken.count();
    return order_;
}

/// Least significant digit first.
void VisibilityOrder::sortByKeys(const Viewpoint& viewpoint) {
    // |c - eye|^2 - R^2 without what is the same for all cells.
    const glm::dvec4 axis = viewpoint.perspective ? glm::dvec4{-2.0 * viewpoint.at, 1.0}
                                                  : glm::dvec4{viewpoint.at, 0.0};
    std::vector<std::array<std::uint32_t, kDigits>> counts(kPasses);
    for (std::size_t t = 0; t < sites_.size(); ++t) {
        items_[t] = {sortable(glm::dot(sites_[t], axis)), static_cast<std::uint32_t>(t)};
        for (int pass = 0; pass < kPasses; ++pass) {
            ++counts[static_cast<std::size_t>(pass)][digit(items_[t].key, pass)];
        }
    }
    for (int pass = 0; pass < kPasses; ++pass) {
        auto& places = counts[static_cast<std::size_t>(pass)];
        std::exclusive_scan(places.begin(), places.end(), places.begin(), 0U);
        for (const Item& item : items_) scratch_[places[digit(item.key, pass)]++] = item;
        items_.swap(scratch_);
    }
    std::ranges::transform(items_, order_.begin(), &Item::cell);
}

/// Of two cells at a face, the one on the eye's side hides the other.
void VisibilityOrder::findBefore(const Viewpoint& viewpoint) {
    std::ranges::fill(before_, std::uint8_t{0});
    for (std::size_t t = 0; t < before_.size(); ++t) {
        const glm::ivec4 neighbours = mesh_->neighbours[t];
        for (int i = 0; i < 4; ++i) {
            if (neighbours[i] <= static_cast<int>(t)) continue;
            const auto& face = data::kFaceCorners[static_cast<std::size_t>(i)];
            const glm::dvec3 a = vertexOf(*mesh_, t, face[0]);
            const glm::dvec3 outwards =
                glm::cross(vertexOf(*mesh_, t, face[1]) - a, vertexOf(*mesh_, t, face[2]) - a);
            const double side = viewpoint.perspective ? glm::dot(outwards, viewpoint.at - a)
                                                      : -glm::dot(outwards, viewpoint.at);
            const auto other = static_cast<std::size_t>(neighbours[i]);
            if (side > 0.0) before_[t] |= static_cast<std::uint8_t>(1U << i);
            if (side >= 0.0) continue;
            for (int j = 0; j < 4; ++j) {
                if (mesh_->neighbours[other][j] == static_cast<int>(t)) {
                    before_[other] |= static_cast<std::uint8_t>(1U << j);
                }
            }
        }
    }
}

/// Pairs of neighbours of which the farther one is drawn first.
std::int64_t VisibilityOrder::violations() {
    for (std::size_t place = 0; place < order_.size(); ++place) {
        rank_[order_[place]] = static_cast<std::uint32_t>(place);
    }
    std::int64_t count = 0;
    for (std::size_t t = 0; t < before_.size(); ++t) {
        for (int i = 0; i < 4; ++i) {
            if ((before_[t] >> i & 1U) == 0) continue;
            if (rank_[static_cast<std::size_t>(mesh_->neighbours[t][i])] > rank_[t]) ++count;
        }
    }
    return count;
}

/// Moves each cell behind all that must come before it, and otherwise keeps the order: depth first
/// along `before_`. A cell that is met again while it waits hides itself: that link is ignored.
void VisibilityOrder::moveBehind() {
    constexpr std::uint32_t kNotYet = 0;
    constexpr std::uint32_t kMet = 1;  // Waiting, or in its place.
    std::ranges::fill(rank_, kNotYet);
    std::vector<std::uint8_t> unseen = before_;  // Links that were not followed yet.
    std::vector<std::uint32_t> waiting;
    std::vector<std::uint32_t> moved;
    moved.reserve(order_.size());
    for (const std::uint32_t first : order_) {
        if (rank_[first] == kMet) continue;
        rank_[first] = kMet;
        waiting.push_back(first);
        while (!waiting.empty()) {
            const std::uint32_t cell = waiting.back();
            std::uint8_t& links = unseen[cell];
            if (links == 0) {
                moved.push_back(cell);
                waiting.pop_back();
                continue;
            }
            const int face = std::countr_zero(links);
            links = static_cast<std::uint8_t>(links & (links - 1U));
            const auto other = static_cast<std::uint32_t>(mesh_->neighbours[cell][face]);
            if (rank_[other] == kMet) continue;
            rank_[other] = kMet;
            waiting.push_back(other);
        }
    }
    order_.swap(moved);
}

}  // namespace volcast::mesh
