#pragma once

#include <string>

#include <gtest/gtest.h>

#include "renderer/data/packed_dataset.h"
#include "server/workers/import_service.h"
#include "tests/support/import_files.h"

namespace volcast::test {

/// Runs the real volcast-import, which the build puts beside the test program.
class Import : public testing::Test {
protected:
    Result<workers::ImportedDataset> import(const std::string& path) {
        request.path = path;
        return workers::runImport(request, settings, nullptr);
    }

    /// The dataset of an import that must succeed; an empty mesh if it does not.
    data::Dataset dataset(const std::string& path) {
        auto imported = import(path);
        EXPECT_TRUE(imported.has_value()) << imported.error().message;
        if (!imported) return {};
        summary = imported->summary;
        format = imported->format;
        warnings = imported->warnings;
        auto unpacked = data::unpack(imported->packed);
        EXPECT_TRUE(unpacked.has_value());
        return unpacked ? std::move(*unpacked) : data::Dataset{};
    }
    data::Mesh mesh(const std::string& path) {
        auto all = dataset(path);
        auto* held = std::get_if<data::Mesh>(&all);
        EXPECT_NE(held, nullptr) << path << " is no mesh";
        return held != nullptr ? std::move(*held) : data::Mesh{};
    }
    data::Volume volume(const std::string& path) {
        auto all = dataset(path);
        auto* held = std::get_if<data::Volume>(&all);
        EXPECT_NE(held, nullptr) << path << " is no volume";
        return held != nullptr ? std::move(*held) : data::Volume{};
    }

    /// Expects a refusal with `code` that names the file and says `reason`.
    void expectRefused(const std::string& path, ErrorCode code, const std::string& reason) {
        const auto imported = import(path);
        ASSERT_FALSE(imported.has_value()) << path << " was imported";
        const std::string& message = imported.error().message;
        EXPECT_EQ(name(imported.error().code), std::string{name(code)}) << message;
        EXPECT_NE(message.find(path), std::string::npos) << message;
        EXPECT_NE(message.find(reason), std::string::npos) << message;
    }

    // NOLINTBEGIN(readability-identifier-naming): a fixture's parts are used like locals
    TempFolder folder;
    workers::ImportRequest request;
    workers::ImportSettings settings;
    data::DatasetSummary summary;
    std::string format;
    std::vector<std::string> warnings;
    // NOLINTEND(readability-identifier-naming)
};

/// Sum of the volumes of all cells.
inline double totalVolume(const data::Mesh& mesh) {
    double sum = 0.0;
    for (const glm::ivec4& cell : mesh.cells) {
        const glm::dvec3 a = mesh.vertices[static_cast<std::size_t>(cell.x)];
        const glm::dvec3 b = mesh.vertices[static_cast<std::size_t>(cell.y)];
        const glm::dvec3 c = mesh.vertices[static_cast<std::size_t>(cell.z)];
        const glm::dvec3 d = mesh.vertices[static_cast<std::size_t>(cell.w)];
        sum += glm::dot(glm::cross(b - a, c - a), d - a) / 6.0;
    }
    return sum;
}

/// The field called `name`, or null.
inline const data::Field* field(const data::Mesh& mesh, const std::string& name) {
    for (const data::Field& candidate : mesh.fields) {
        if (candidate.name == name) return &candidate;
    }
    return nullptr;
}

/// Largest difference of a vertex field's step from `expected(world position)`.
template <class Expected>
double vertexError(const data::Mesh& mesh, const data::Field& field, Expected expected,
                   std::size_t step = 0) {
    double worst = 0.0;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const glm::dvec3 world = mesh.origin + glm::dvec3{mesh.vertices[i]};
        worst = std::max(worst, std::abs(expected(world) - field.steps.at(step)[i]));
    }
    return worst;
}

}  // namespace volcast::test
