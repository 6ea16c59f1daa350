#include "renderer/data/load/quadratic_cells.h"

#include <algorithm>
#include <array>
#include <map>
#include <span>

namespace volcast::data::load {

namespace {

/// A face of four corners and the middles of its edges, as local vertices.
struct QuadraticFace {
    std::array<int, 4> corners;
    std::array<int, 4> middles;
};

// Centres are made in the order in which the 27-, 18- and 14-point cells have them.
constexpr std::array<QuadraticFace, 6> kHexahedronFaces{{{{0, 4, 7, 3}, {16, 15, 19, 11}},
                                                         {{1, 2, 6, 5}, {9, 18, 13, 17}},
                                                         {{0, 1, 5, 4}, {8, 17, 12, 16}},
                                                         {{3, 7, 6, 2}, {19, 14, 18, 10}},
                                                         {{0, 1, 2, 3}, {8, 9, 10, 11}},
                                                         {{4, 5, 6, 7}, {12, 13, 14, 15}}}};
constexpr std::array<QuadraticFace, 3> kWedgeFaces{{{{0, 1, 4, 3}, {6, 13, 9, 12}},
                                                    {{1, 2, 5, 4}, {7, 14, 10, 13}},
                                                    {{2, 0, 3, 5}, {8, 12, 11, 14}}}};
constexpr std::array<QuadraticFace, 1> kPyramidFaces{{{{0, 1, 2, 3}, {5, 6, 7, 8}}}};

/// Local vertices of the pieces of each whole quadratic cell.
constexpr std::array<std::array<int, 4>, 8> kTetraPieces{{{0, 4, 6, 7},
                                                          {4, 1, 5, 8},
                                                          {6, 5, 2, 9},
                                                          {7, 8, 9, 3},
                                                          {6, 8, 4, 5},
                                                          {6, 8, 5, 9},
                                                          {6, 8, 9, 7},
                                                          {6, 8, 7, 4}}};
constexpr std::array<std::array<int, 4>, 4> kPyramidTetra{
    {{5, 9, 10, 13}, {6, 10, 11, 13}, {7, 11, 12, 13}, {8, 12, 9, 13}}};
constexpr std::array<std::array<int, 5>, 6> kPyramidPieces{{{0, 5, 13, 8, 9},
                                                            {1, 6, 13, 5, 10},
                                                            {2, 7, 13, 6, 11},
                                                            {3, 8, 13, 7, 12},
                                                            {9, 10, 11, 12, 4},
                                                            {9, 12, 11, 10, 13}}};
/// Points of a wedge by layer: three corners, then the middles of the triangle's edges.
constexpr std::array<std::array<int, 6>, 3> kWedgeLayers{
    {{0, 1, 2, 6, 7, 8}, {12, 13, 14, 15, 16, 17}, {3, 4, 5, 9, 10, 11}}};
constexpr std::array<std::array<int, 3>, 4> kTrianglePieces{
    {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};
/// Points of a hexahedron at (x, y, z) in {0, 1, 2}: index x + 3 y + 9 z.
constexpr std::array<int, 27> kHexahedronGrid{0,  8,  1,  11, 24, 9,  3, 10, 2,  16, 22, 17, 20, 26,
                                              21, 19, 23, 18, 4,  12, 5, 15, 25, 13, 7,  14, 6};
constexpr std::array<std::size_t, 8> kHexahedronSteps{0, 1, 4, 3, 9, 10, 13, 12};

struct Weighted {
    std::int64_t point;
    double weight;
};

/// Cuts cells one by one; points made for a face are shared by the cells on both sides of it.
class Cutter {
public:
    explicit Cutter(MixedMesh& mesh) : mesh_{mesh} {
        for (const CellKind kind :
             {CellKind::kTetra, CellKind::kPyramid, CellKind::kWedge, CellKind::kHexahedron}) {
            out_.blocks.push_back({.kind = kind});
        }
    }

    void add(CellKind kind, std::span<const std::int64_t> vertices, std::uint32_t parent) {
        parent_ = parent;
        cell_.assign(vertices.begin(), vertices.end());
        switch (kind) {
            case CellKind::kTetra10: return pieces(0, kTetraPieces);
            case CellKind::kPyramid13: addFaceCentres(kPyramidFaces); [[fallthrough]];
            case CellKind::kPyramid14: pieces(0, kPyramidTetra); return pieces(1, kPyramidPieces);
            case CellKind::kWedge15: addFaceCentres(kWedgeFaces); [[fallthrough]];
            case CellKind::kWedge18: return cutWedge();
            case CellKind::kHexahedron20:
                addFaceCentres(kHexahedronFaces);
                addHexahedronCentre();
                [[fallthrough]];
            case CellKind::kHexahedron27: return cutHexahedron();
            case CellKind::kTetra: return whole(0);
            case CellKind::kPyramid: return whole(1);
            case CellKind::kWedge: return whole(2);
            case CellKind::kHexahedron: return whole(3);
        }
    }

    LinearCells take() { return std::move(out_); }

private:
    void whole(std::size_t block) {
        auto& out = out_.blocks[block];
        out.vertices.insert(out.vertices.end(), cell_.begin(), cell_.end());
        out.parents.push_back(parent_);
    }

    template <std::size_t Vertices>
    void piece(std::size_t block, const std::array<int, Vertices>& local) {
        auto& out = out_.blocks[block];
        for (const int i : local) out.vertices.push_back(cell_[static_cast<std::size_t>(i)]);
        out.parents.push_back(parent_);
    }

    template <std::size_t Vertices, std::size_t Count>
    void pieces(std::size_t block, const std::array<std::array<int, Vertices>, Count>& list) {
        for (const auto& local : list) piece(block, local);
    }

    void cutWedge() {
        for (std::size_t layer = 0; layer < 2; ++layer) {
            const auto& below = kWedgeLayers.at(layer);
            const auto& above = kWedgeLayers.at(layer + 1);
            for (const auto& t : kTrianglePieces) {
                const auto at = [&](const auto& points, std::size_t i) {
                    return points.at(static_cast<std::size_t>(t.at(i)));
                };
                piece<6>(2, {at(below, 0), at(below, 1), at(below, 2), at(above, 0), at(above, 1),
                             at(above, 2)});
            }
        }
    }

    void cutHexahedron() {
        for (const std::size_t first : {0U, 1U, 3U, 4U, 9U, 10U, 12U, 13U}) {
            std::array<int, 8> local{};
            for (std::size_t i = 0; i < local.size(); ++i) {
                local.at(i) = kHexahedronGrid.at(first + kHexahedronSteps.at(i));
            }
            piece(3, local);
        }
    }

    template <std::size_t Count>
    void addFaceCentres(const std::array<QuadraticFace, Count>& faces) {
        for (const QuadraticFace& face : faces) {
            std::array<std::int64_t, 4> key{};
            std::vector<Weighted> terms;
            for (std::size_t i = 0; i < 4; ++i) {
                key.at(i) = cell_[static_cast<std::size_t>(face.corners.at(i))];
                terms.push_back({key.at(i), -0.25});
                terms.push_back({cell_[static_cast<std::size_t>(face.middles.at(i))], 0.5});
            }
            std::sort(key.begin(), key.end());
            auto found = centres_.find(key);
            if (found == centres_.end()) found = centres_.emplace(key, addPoint(terms)).first;
            cell_.push_back(found->second);
        }
    }

    /// The 20-point shape functions at the centre.
    void addHexahedronCentre() {
        std::vector<Weighted> terms;
        for (std::size_t i = 0; i < 20; ++i) terms.push_back({cell_[i], i < 8 ? -0.25 : 0.25});
        cell_.push_back(addPoint(terms));
    }

    std::int64_t addPoint(const std::vector<Weighted>& terms) {
        glm::dvec3 position{0.0};
        for (const Weighted& term : terms) {
            position += term.weight * mesh_.points[static_cast<std::size_t>(term.point)];
        }
        mesh_.points.push_back(position);
        for (FieldInput& field : mesh_.fields) {
            if (field.association != Association::kVertex) continue;
            for (std::vector<double>& step : field.steps) {
                double value = 0.0;
                for (const Weighted& term : terms) {
                    value += term.weight * step.at(static_cast<std::size_t>(term.point));
                }
                step.push_back(value);
            }
        }
        return static_cast<std::int64_t>(mesh_.points.size()) - 1;
    }

    MixedMesh& mesh_;
    LinearCells out_;
    std::vector<std::int64_t> cell_;  ///< The current cell's points, centres appended.
    std::uint32_t parent_ = 0;
    std::map<std::array<std::int64_t, 4>, std::int64_t> centres_;
};

}  // namespace

LinearCells cutQuadratic(MixedMesh& mesh) {
    Cutter cutter{mesh};
    std::uint32_t parent = 0;
    for (const CellBlock& block : mesh.blocks) {
        const std::size_t stride = vertexCount(block.kind);
        for (std::size_t i = 0; i < block.vertices.size(); i += stride) {
            cutter.add(block.kind, std::span{block.vertices}.subspan(i, stride), parent++);
        }
    }
    return cutter.take();
}

}  // namespace volcast::data::load
