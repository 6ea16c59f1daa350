#include "renderer/data/mesh_restrict.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "renderer/data/mesh_adjacency.h"

namespace volcast::data {

namespace {

std::size_t valuesAStep(const Mesh& mesh, Association association) {
    switch (association) {
        case Association::kVertex: return mesh.vertices.size();
        case Association::kCell: return mesh.cells.size();
        case Association::kCellVertex: return 4 * mesh.cells.size();
    }
    return 0;
}

/// The values of a step that is there and has the right number of them.
Result<std::span<const float>> valuesOf(const Mesh& mesh, const FieldStep& chosen) {
    const Field& field = *chosen.field;
    if (chosen.step < 0 || static_cast<std::size_t>(chosen.step) >= field.steps.size()) {
        return fail(ErrorCode::kInvalidArgument, "field '" + field.name + "': there is no step " +
                                                     std::to_string(chosen.step) + ", it has " +
                                                     std::to_string(field.steps.size()));
    }
    const auto values = field.steps[static_cast<std::size_t>(chosen.step)].span();
    const std::size_t expected = valuesAStep(mesh, field.association);
    if (values.size() != expected) {
        return fail(ErrorCode::kInvalidArgument,
                    "field '" + field.name + "': " + std::to_string(values.size()) +
                        " values, the mesh needs " + std::to_string(expected));
    }
    return values;
}

/// True where one of the values that cell `t` interpolates is NaN.
bool lacksValue(const Mesh& mesh, Association association, std::span<const float> values,
                std::size_t t) {
    if (association == Association::kCell) return std::isnan(values[t]);
    for (int i = 0; i < 4; ++i) {
        const std::size_t at = association == Association::kVertex
                                   ? static_cast<std::size_t>(mesh.cells[t][i])
                                   : 4 * t + static_cast<std::size_t>(i);
        if (std::isnan(values[at])) return true;
    }
    return false;
}

/// What can still become of a cell.
enum class Fate : std::uint8_t { kKept, kNotListed, kWithoutValue };

void leaveOutUnlisted(std::vector<Fate>& fates, std::span<const float> markers,
                      std::span<const float> listed) {
    std::vector<float> sorted{listed.begin(), listed.end()};
    std::erase_if(sorted, [](float value) { return std::isnan(value); });
    std::ranges::sort(sorted);
    for (std::size_t t = 0; t < fates.size(); ++t) {
        // NaN is not listed, and it would break the search.
        const bool found =
            !std::isnan(markers[t]) && std::ranges::binary_search(sorted, markers[t]);
        if (!found) fates[t] = Fate::kNotListed;
    }
}

void leaveOutWithoutValue(std::vector<Fate>& fates, const Mesh& mesh, Association association,
                          std::span<const float> values) {
    // Most fields have a value everywhere, which is told faster from the values alone.
    if (std::ranges::none_of(values, [](float value) { return std::isnan(value); })) return;
    for (std::size_t t = 0; t < fates.size(); ++t) {
        if (fates[t] == Fate::kKept && lacksValue(mesh, association, values, t)) {
            fates[t] = Fate::kWithoutValue;
        }
    }
}

}  // namespace

std::uint64_t countCellsWithoutValue(const Mesh& mesh, const Field& field) {
    std::vector<Fate> fates(mesh.cells.size(), Fate::kKept);
    for (const auto& step : field.steps) {
        leaveOutWithoutValue(fates, mesh, field.association, step.span());
    }
    return static_cast<std::uint64_t>(std::ranges::count(fates, Fate::kWithoutValue));
}

Result<std::optional<KeptCells>> keptCells(const Mesh& mesh, const FieldStep& marker,
                                           std::span<const float> listed,
                                           std::span<const FieldStep> fields) {
    std::vector<Fate> fates(mesh.cells.size(), Fate::kKept);
    if (marker.field != nullptr) {
        if (marker.field->association != Association::kCell) {
            return fail(ErrorCode::kInvalidArgument, "field '" + marker.field->name +
                                                         "' has not one value a cell: cells "
                                                         "cannot be chosen by it");
        }
        const auto values = valuesOf(mesh, marker);
        if (!values) return values.error();
        leaveOutUnlisted(fates, *values, listed);
    }
    for (const FieldStep& chosen : fields) {
        const auto values = valuesOf(mesh, chosen);
        if (!values) return values.error();
        leaveOutWithoutValue(fates, mesh, chosen.field->association, *values);
    }
    KeptCells kept;
    kept.notListed = static_cast<std::uint64_t>(std::ranges::count(fates, Fate::kNotListed));
    kept.withoutValue = static_cast<std::uint64_t>(std::ranges::count(fates, Fate::kWithoutValue));
    if (kept.notListed + kept.withoutValue == 0) return std::optional<KeptCells>{};
    kept.cells.reserve(fates.size() - kept.notListed - kept.withoutValue);
    for (std::size_t t = 0; t < fates.size(); ++t) {
        if (fates[t] == Fate::kKept) kept.cells.push_back(static_cast<std::int32_t>(t));
    }
    return std::optional{std::move(kept)};
}

Restriction restrictMesh(const Mesh& mesh, std::vector<std::int32_t> cells) {
    std::vector<std::int32_t> newId(mesh.cells.size(), -1);
    for (std::size_t t = 0; t < cells.size(); ++t) {
        newId[static_cast<std::size_t>(cells[t])] = static_cast<std::int32_t>(t);
    }
    std::vector<glm::ivec4> corners(cells.size());
    std::vector<glm::ivec4> neighbours(cells.size());
    for (std::size_t t = 0; t < cells.size(); ++t) {
        const auto old = static_cast<std::size_t>(cells[t]);
        corners[t] = mesh.cells[old];
        for (int i = 0; i < 4; ++i) {
            const std::int32_t other = mesh.neighbours[old][i];
            neighbours[t][i] = other < 0 ? -1 : newId[static_cast<std::size_t>(other)];
        }
    }
    Adjacency adjacency = completeAdjacency(corners, std::move(neighbours));
    // Where three cells shared a face, two may be left: they stay apart, and are counted as before.
    adjacency.facesNotManifold = mesh.facesNotManifold;

    const std::vector<glm::dvec3> exact{mesh.vertices.begin(), mesh.vertices.end()};
    Restriction result;
    result.mesh.origin = mesh.origin;
    result.mesh.vertices = mesh.vertices;
    result.mesh.convex = !cells.empty() && isConvex(exact, adjacency);
    result.mesh.cellsWithoutVolume = mesh.cellsWithoutVolume;
    result.mesh.cellsInverted = mesh.cellsInverted;
    result.mesh.cellsDoubled = mesh.cellsDoubled;
    result.mesh.facesNotManifold = mesh.facesNotManifold;
    result.mesh.cells = std::move(corners);
    result.mesh.neighbours = std::move(adjacency.neighbours);
    result.mesh.boundaryFaces = std::move(adjacency.boundaryFaces);
    result.mesh.boundaryNeighbours = std::move(adjacency.boundaryNeighbours);
    result.source = std::move(cells);
    return result;
}

Field restrictField(const Field& field, int step, std::span<const std::int32_t> source) {
    const auto s = static_cast<std::size_t>(step);
    Field result{.name = field.name,
                 .unit = field.unit,
                 .association = field.association,
                 .range = field.range,
                 .steps = {},
                 .times = {field.times[s]},
                 .cellsWithoutValue = field.cellsWithoutValue};
    if (field.association == Association::kVertex) {
        result.steps.push_back(field.steps[s]);
        return result;
    }
    const std::size_t each = field.association == Association::kCell ? 1 : 4;
    std::vector<float> values(each * source.size());
    for (std::size_t t = 0; t < source.size(); ++t) {
        const auto old = static_cast<std::size_t>(source[t]);
        for (std::size_t i = 0; i < each; ++i) {
            values[each * t + i] = field.steps[s][each * old + i];
        }
    }
    result.steps.emplace_back(std::move(values));
    return result;
}

}  // namespace volcast::data
