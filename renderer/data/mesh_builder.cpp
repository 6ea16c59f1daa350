#include "renderer/data/mesh_builder.h"

#include <cmath>
#include <limits>
#include <set>

#include "renderer/data/mesh_adjacency.h"
#include "renderer/data/mesh_order.h"
#include "renderer/data/mesh_restrict.h"
#include "renderer/data/text.h"

namespace volcast::data {

namespace {

bool fitsFloat(double value) {
    return std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max());
}

const char* itemName(Association association) {
    switch (association) {
        case Association::kVertex: return "point";
        case Association::kCell: return "cell";
        case Association::kCellVertex: return "cell vertex";
    }
    return "item";
}

std::size_t itemCount(const MeshInput& input, Association association) {
    switch (association) {
        case Association::kVertex: return input.points.size();
        case Association::kCell: return input.cells.size();
        case Association::kCellVertex: return 4 * input.cells.size();
    }
    return 0;
}

Result<void> checkCounts(const MeshInput& input) {
    if (input.points.empty() || input.cells.empty()) {
        return fail(ErrorCode::kInvalidArgument,
                    "mesh: " + std::to_string(input.points.size()) + " points and " +
                        std::to_string(input.cells.size()) + " tetrahedra, expected some of both");
    }
    if (input.points.size() > kMaxMeshItems || input.cells.size() > kMaxMeshItems) {
        return fail(ErrorCode::kLimitExceeded,
                    "mesh: " + std::to_string(input.points.size()) + " points and " +
                        std::to_string(input.cells.size()) + " tetrahedra, the limit of each is " +
                        std::to_string(kMaxMeshItems));
    }
    if (input.fields.size() > kMaxFields) {
        return fail(ErrorCode::kLimitExceeded, "mesh: " + std::to_string(input.fields.size()) +
                                                   " fields, the limit is " +
                                                   std::to_string(kMaxFields));
    }
    return {};
}

Result<void> checkGeometry(const MeshInput& input) {
    for (std::size_t i = 0; i < input.points.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            if (!std::isfinite(input.points[i][axis])) {
                return fail(ErrorCode::kInvalidArgument,
                            "mesh: coordinate " + std::to_string(axis) + " of point " +
                                std::to_string(i) + " is " + std::to_string(input.points[i][axis]) +
                                ", not a finite number");
            }
        }
    }
    const auto count = static_cast<std::int64_t>(input.points.size());
    for (std::size_t t = 0; t < input.cells.size(); ++t) {
        for (const std::int64_t id : input.cells[t]) {
            if (id < 0 || id >= count) {
                return fail(ErrorCode::kInvalidArgument, "mesh: tetrahedron " + std::to_string(t) +
                                                             " names point " + std::to_string(id) +
                                                             ", there are points 0 to " +
                                                             std::to_string(count - 1));
            }
        }
    }
    return {};
}

Result<void> checkValues(const FieldInput& field, std::size_t expected) {
    const std::string where = "field '" + field.name + "'";
    for (std::size_t s = 0; s < field.steps.size(); ++s) {
        const std::vector<double>& values = field.steps[s];
        const std::string step =
            field.steps.size() > 1 ? where + ", step " + std::to_string(s) : where;
        if (values.size() != expected) {
            return fail(ErrorCode::kInvalidArgument, step + ": " + std::to_string(values.size()) +
                                                         " values, expected " +
                                                         std::to_string(expected));
        }
        for (std::size_t i = 0; i < expected; ++i) {
            if (!std::isnan(values[i]) && !fitsFloat(values[i])) {
                return fail(ErrorCode::kInvalidArgument,
                            step + ": the value of " + itemName(field.association) + " " +
                                std::to_string(i) + " is " + std::to_string(values[i]) +
                                ", neither a finite float32 nor NaN");
            }
        }
    }
    return {};
}

Result<void> checkFields(MeshInput& input) {
    std::set<std::string> names;
    for (FieldInput& field : input.fields) {
        field.name = toUtf8(std::move(field.name));
        field.unit = toUtf8(std::move(field.unit));
        if (field.name.empty() || !names.insert(field.name).second) {
            return fail(ErrorCode::kInvalidArgument,
                        "mesh: the field name '" + field.name + "' is empty or occurs twice");
        }
        if (field.steps.empty() || field.steps.size() > kMaxSteps) {
            return fail(ErrorCode::kInvalidArgument,
                        "field '" + field.name + "': " + std::to_string(field.steps.size()) +
                            " time steps, expected 1 to " + std::to_string(kMaxSteps));
        }
        if (!field.times.empty() && field.times.size() != field.steps.size()) {
            return fail(ErrorCode::kInvalidArgument,
                        "field '" + field.name + "': " + std::to_string(field.times.size()) +
                            " times for " + std::to_string(field.steps.size()) + " steps");
        }
        for (const double time : field.times) {
            if (!std::isfinite(time)) {
                return fail(ErrorCode::kInvalidArgument,
                            "field '" + field.name + "': a time is not a finite number");
            }
        }
        if (auto checked = checkValues(field, itemCount(input, field.association)); !checked) {
            return checked;
        }
    }
    return {};
}

/// Where value `i` of a built field stands in its input.
std::size_t sourceOf(const OrderedMesh& ordered, Association association, std::size_t i) {
    switch (association) {
        case Association::kVertex: return ordered.vertexSource[i];
        case Association::kCell: return ordered.cellSource[i];
        case Association::kCellVertex:
            return 4 * std::size_t{ordered.cellSource[i / 4]} + ordered.cornerSource[i / 4][i % 4];
    }
    return 0;
}

/// Errors: kInvalidArgument (every value is NaN).
Result<Field> buildField(FieldInput input, const OrderedMesh& ordered) {
    const std::size_t vertices = ordered.vertices.size();
    const std::size_t cells = ordered.cells.size();
    const std::size_t count = input.association == Association::kVertex ? vertices
                              : input.association == Association::kCell ? cells
                                                                        : 4 * cells;
    Field field{.name = std::move(input.name),
                .unit = std::move(input.unit),
                .association = input.association,
                .range = {.min = std::numeric_limits<float>::infinity(),
                          .max = -std::numeric_limits<float>::infinity()},
                .steps = {},
                .times = std::move(input.times)};
    for (const std::vector<double>& source : input.steps) {
        std::vector<float> values(count);
        for (std::size_t i = 0; i < count; ++i) {
            const auto value = static_cast<float>(source[sourceOf(ordered, input.association, i)]);
            values[i] = value;
            if (std::isnan(value)) continue;
            field.range.min = std::min(field.range.min, value);
            field.range.max = std::max(field.range.max, value);
        }
        field.steps.emplace_back(std::move(values));
    }
    if (field.range.min > field.range.max) {
        return fail(ErrorCode::kInvalidArgument, "field '" + field.name + "': has no value, all " +
                                                     std::to_string(count * field.steps.size()) +
                                                     " are NaN");
    }
    if (field.times.empty()) {
        for (std::size_t s = 0; s < field.steps.size(); ++s) {
            field.times.push_back(static_cast<double>(s));
        }
    }
    return field;
}

}  // namespace

Result<Mesh> buildMesh(MeshInput input) {
    if (const auto checked = checkCounts(input); !checked) return checked.error();
    if (const auto checked = checkGeometry(input); !checked) return checked.error();
    if (const auto checked = checkFields(input); !checked) return checked.error();
    auto ordered = orderMesh(input);
    if (!ordered) return ordered.error();

    Adjacency adjacency = findAdjacency(ordered->cells, ordered->vertices.size());
    Mesh mesh;
    mesh.origin = ordered->origin;
    mesh.convex = isConvex(ordered->exactVertices, adjacency);
    mesh.cellsWithoutVolume = ordered->cellsWithoutVolume;
    mesh.cellsInverted = ordered->cellsInverted;
    mesh.cellsDoubled = ordered->cellsDoubled;
    mesh.facesNotManifold = adjacency.facesNotManifold;
    for (FieldInput& field : input.fields) {
        auto built = buildField(std::move(field), *ordered);
        if (!built) return built.error();
        mesh.fields.push_back(std::move(*built));
    }
    mesh.vertices = std::move(ordered->vertices);
    mesh.cells = std::move(ordered->cells);
    mesh.neighbours = std::move(adjacency.neighbours);
    mesh.boundaryFaces = std::move(adjacency.boundaryFaces);
    mesh.boundaryNeighbours = std::move(adjacency.boundaryNeighbours);
    for (Field& field : mesh.fields) field.cellsWithoutValue = countCellsWithoutValue(mesh, field);
    return mesh;
}

}  // namespace volcast::data
