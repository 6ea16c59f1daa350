#include "renderer/data/load/mixed_mesh.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>

#include "renderer/data/load/quadratic_cells.h"

namespace volcast::data::load {

namespace {

struct KindName {
    std::string_view name;
    CellKind kind;
    std::size_t vertices;
};

constexpr std::array kKinds{
    KindName{"tetra", CellKind::kTetra, 4},
    KindName{"pyramid", CellKind::kPyramid, 5},
    KindName{"wedge", CellKind::kWedge, 6},
    KindName{"hexahedron", CellKind::kHexahedron, 8},
    KindName{"tetra10", CellKind::kTetra10, 10},
    KindName{"pyramid13", CellKind::kPyramid13, 13},
    KindName{"pyramid14", CellKind::kPyramid14, 14},
    KindName{"wedge15", CellKind::kWedge15, 15},
    KindName{"wedge18", CellKind::kWedge18, 18},
    KindName{"hexahedron20", CellKind::kHexahedron20, 20},
    KindName{"hexahedron27", CellKind::kHexahedron27, 27},
};

using Face = std::array<int, 4>;  ///< Local vertices in a ring; the last is -1 for a triangle.

constexpr std::array<Face, 5> kPyramidFaces{
    {{0, 1, 2, 3}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}}};
constexpr std::array<Face, 5> kWedgeFaces{
    {{0, 1, 2, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}};
constexpr std::array<Face, 6> kHexahedronFaces{
    {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

std::span<const Face> facesOf(CellKind kind) {
    switch (kind) {
        case CellKind::kPyramid: return kPyramidFaces;
        case CellKind::kWedge: return kWedgeFaces;
        default: return kHexahedronFaces;
    }
}

using Tetra = std::array<std::int64_t, 4>;

bool hasPointTwice(const Tetra& t) {
    return t[0] == t[1] || t[0] == t[2] || t[0] == t[3] || t[1] == t[2] || t[1] == t[3] ||
           t[2] == t[3];
}

/// Turns cells into tetrahedra and remembers which cell each came from.
class Splitter {
public:
    explicit Splitter(MeshInput& out) : out_{out} {}

    void add(CellKind kind, std::span<const std::int64_t> vertices, std::size_t parent) {
        if (kind == CellKind::kTetra) {
            emit({vertices[0], vertices[1], vertices[2], vertices[3]}, parent);
            return;
        }
        const auto apex = std::min_element(vertices.begin(), vertices.end()) - vertices.begin();
        for (const Face& face : facesOf(kind)) {
            if (std::find(face.begin(), face.end(), static_cast<int>(apex)) != face.end()) continue;
            cone(vertices, vertices[static_cast<std::size_t>(apex)], face, parent);
        }
    }

    [[nodiscard]] const std::vector<std::uint32_t>& parents() const { return parents_; }

private:
    void cone(std::span<const std::int64_t> vertices, std::int64_t apex, const Face& face,
              std::size_t parent) {
        const auto at = [&](std::size_t i) {
            return vertices[static_cast<std::size_t>(face.at(i % 4))];
        };
        if (face[3] < 0) {
            emit({at(0), at(1), at(2), apex}, parent);
            return;
        }
        std::size_t first = 0;
        for (std::size_t i = 1; i < 4; ++i) {
            if (at(i) < at(first)) first = i;
        }
        emit({at(first), at(first + 1), at(first + 2), apex}, parent);
        emit({at(first), at(first + 2), at(first + 3), apex}, parent);
    }

    void emit(const Tetra& tetra, std::size_t parent) {
        if (hasPointTwice(tetra)) return;
        out_.cells.push_back(positive(tetra));
        parents_.push_back(static_cast<std::uint32_t>(parent));
    }

    /// The faces above are not all seen from one side, so the sign is made here.
    [[nodiscard]] Tetra positive(Tetra t) const {
        const auto point = [&](std::size_t i) {
            return out_.points[static_cast<std::size_t>(t.at(i))];
        };
        const glm::dvec3 a = point(0);
        if (glm::dot(glm::cross(point(1) - a, point(2) - a), point(3) - a) < 0.0) {
            std::swap(t[0], t[1]);
        }
        return t;
    }

    MeshInput& out_;
    std::vector<std::uint32_t> parents_;
};

Result<void> checkFields(const MixedMesh& mesh, bool onlyTetra) {
    for (const FieldInput& field : mesh.fields) {
        if (field.association == Association::kCellVertex && !onlyTetra) {
            return fail(ErrorCode::kUnsupported,
                        "field \"" + field.name +
                            "\": values that jump between cells need linear tetrahedra");
        }
        for (const std::vector<double>& step : field.steps) {
            if (field.association != Association::kVertex || step.size() == mesh.points.size()) {
                continue;
            }
            return fail(ErrorCode::kInvalidArgument,
                        "field \"" + field.name + "\": has " + std::to_string(step.size()) +
                            " values, there are " + std::to_string(mesh.points.size()) + " points");
        }
    }
    return {};
}

Result<void> checkBlocks(const MixedMesh& mesh) {
    const auto points = static_cast<std::int64_t>(mesh.points.size());
    for (const CellBlock& block : mesh.blocks) {
        if (block.vertices.size() % vertexCount(block.kind) != 0) {
            return fail(ErrorCode::kInvalidArgument, "a block of cells ends within a cell");
        }
        for (std::size_t i = 0; i < block.vertices.size(); ++i) {
            const std::int64_t vertex = block.vertices[i];
            if (vertex >= 0 && vertex < points) continue;
            return fail(ErrorCode::kInvalidArgument,
                        "cell " + std::to_string(i / vertexCount(block.kind)) + " names point " +
                            std::to_string(vertex) + ", there are " + std::to_string(points));
        }
    }
    return {};
}

std::size_t cellCount(const MixedMesh& mesh) {
    std::size_t cells = 0;
    for (const CellBlock& block : mesh.blocks) {
        cells += block.vertices.size() / vertexCount(block.kind);
    }
    return cells;
}

/// Gives each tetrahedron the value of the cell that it came from.
Result<void> spreadCellFields(std::vector<FieldInput>& fields, std::size_t cells,
                              const std::vector<std::uint32_t>& parents) {
    for (FieldInput& field : fields) {
        if (field.association != Association::kCell) continue;
        for (std::vector<double>& step : field.steps) {
            if (step.size() != cells) {
                return fail(ErrorCode::kInvalidArgument,
                            "field \"" + field.name + "\": has " + std::to_string(step.size()) +
                                " values, there are " + std::to_string(cells) + " cells");
            }
            std::vector<double> spread(parents.size());
            for (std::size_t i = 0; i < spread.size(); ++i) spread[i] = step[parents[i]];
            step = std::move(spread);
        }
    }
    return {};
}

}  // namespace

std::size_t vertexCount(CellKind kind) noexcept {
    const auto* found = std::find_if(kKinds.begin(), kKinds.end(),
                                     [&](const KindName& row) { return row.kind == kind; });
    return found->vertices;
}

std::optional<CellKind> cellKind(std::string_view name) noexcept {
    const auto* found = std::find_if(kKinds.begin(), kKinds.end(),
                                     [&](const KindName& row) { return row.name == name; });
    if (found == kKinds.end()) return std::nullopt;
    return found->kind;
}

Result<MeshInput> splitCells(MixedMesh mesh) {
    auto checked = checkBlocks(mesh);
    if (!checked) return checked.error();
    const std::size_t cells = cellCount(mesh);
    if (cells > kMaxMeshItems) {
        return fail(
            ErrorCode::kLimitExceeded,
            "has " + std::to_string(cells) + " cells, more than " + std::to_string(kMaxMeshItems));
    }
    const bool onlyTetra = std::all_of(mesh.blocks.begin(), mesh.blocks.end(),
                                       [](const auto& b) { return b.kind == CellKind::kTetra; });
    checked = checkFields(mesh, onlyTetra);
    if (!checked) return checked.error();
    MeshInput out;
    if (onlyTetra) {  // As they are: cell-vertex fields count their vertices in this order.
        out.cells.reserve(cells);
        for (const CellBlock& block : mesh.blocks) {
            for (std::size_t i = 0; i < block.vertices.size(); i += 4) {
                out.cells.push_back({block.vertices[i], block.vertices[i + 1],
                                     block.vertices[i + 2], block.vertices[i + 3]});
            }
        }
        out.points = std::move(mesh.points);
        out.fields = std::move(mesh.fields);
        return out;
    }
    const LinearCells linear = cutQuadratic(mesh);
    out.points = std::move(mesh.points);
    Splitter splitter{out};
    for (const LinearBlock& block : linear.blocks) {
        const std::size_t stride = vertexCount(block.kind);
        for (std::size_t i = 0; i < block.parents.size(); ++i) {
            splitter.add(block.kind, std::span{block.vertices}.subspan(i * stride, stride),
                         block.parents[i]);
        }
    }
    out.fields = std::move(mesh.fields);
    auto spread = spreadCellFields(out.fields, cells, splitter.parents());
    if (!spread) return spread.error();
    return out;
}

}  // namespace volcast::data::load
