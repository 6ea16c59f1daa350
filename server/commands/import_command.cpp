#include "server/commands/import_command.h"

#include <cstdio>
#include <memory>
#include <sstream>
#include <string>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <boost/json.hpp>

#include "server/commands/json_text.h"
#include "server/workers/import_service.h"

namespace volcast::commands {

namespace {

namespace json = boost::json;

struct ImportOptions {
    workers::ImportRequest request;
    workers::ImportSettings settings;
    std::vector<double> spacing;
    bool asJson = false;
    double deadlineSeconds = 120.0;
    std::uint64_t maxMemoryMb = 8192;
};

const char* text(data::Association association) {
    switch (association) {
        case data::Association::kCell: return "cell";
        case data::Association::kVertex: return "vertex";
        case data::Association::kCellVertex: return "cell vertex";
    }
    return "";
}

const char* text(data::VoxelType type) {
    switch (type) {
        case data::VoxelType::kU8: return "u8";
        case data::VoxelType::kU16: return "u16";
        case data::VoxelType::kI16: return "i16";
        case data::VoxelType::kF32: return "f32";
    }
    return "";
}

json::array numbers(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

std::string number(float value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

json::object asJson(const workers::ImportedDataset& imported) {
    const data::DatasetSummary& s = imported.summary;
    json::object result{{"format", imported.format}, {"kind", s.isMesh ? "mesh" : "volume"}};
    if (s.isMesh) {
        result["cells"] = s.cells;
        result["vertices"] = s.vertices;
        result["boundary_faces"] = s.boundaryFaces;
        result["convex"] = s.convex;
        result["cells_without_volume"] = s.cellsWithoutVolume;
        result["cells_inverted"] = s.cellsInverted;
    } else {
        result["size"] = json::array{s.voxels.x, s.voxels.y, s.voxels.z};
        result["spacing"] = numbers(s.spacing);
        result["voxel_type"] = text(s.voxelType);
    }
    result["bounds"] = {{"min", numbers(s.bounds.min)}, {"max", numbers(s.bounds.max)}};
    json::array fields;
    for (const data::FieldSummary& field : s.fields) {
        json::object row{{"name", field.name},
                         {"unit", field.unit},
                         {"association", s.isMesh ? text(field.association) : "voxel"},
                         {"min", field.range.min},
                         {"max", field.range.max},
                         {"usual_min", field.spread.usual.min},
                         {"usual_max", field.spread.usual.max},
                         {"steps", field.steps}};
        row[s.isMesh ? "cells_without_value" : "voxels_without_value"] =
            s.isMesh ? field.cellsWithoutValue : field.voxelsWithoutValue;
        fields.push_back(std::move(row));
    }
    result["fields"] = std::move(fields);
    result["warnings"] = json::array(imported.warnings.begin(), imported.warnings.end());
    result["bytes"] = s.bytes;
    result["ms"] = imported.ms;
    result["peak_mb"] = imported.peakMb;
    return result;
}

void print(const workers::ImportedDataset& imported) {
    const data::DatasetSummary& s = imported.summary;
    std::printf("format    %s (%s)\n", imported.format.c_str(), s.isMesh ? "mesh" : "volume");
    if (s.isMesh) {
        std::printf("cells     %llu tetrahedra, %llu left out without volume, %llu turned round\n",
                    static_cast<unsigned long long>(s.cells),
                    static_cast<unsigned long long>(s.cellsWithoutVolume),
                    static_cast<unsigned long long>(s.cellsInverted));
        std::printf("vertices  %llu\n", static_cast<unsigned long long>(s.vertices));
        std::printf("boundary  %llu faces, %s\n", static_cast<unsigned long long>(s.boundaryFaces),
                    s.convex ? "convex" : "not convex");
    } else {
        std::printf("voxels    %d x %d x %d of %s\n", s.voxels.x, s.voxels.y, s.voxels.z,
                    text(s.voxelType));
        std::printf("spacing   %g %g %g\n", s.spacing.x, s.spacing.y, s.spacing.z);
    }
    std::printf("bounds    %g %g %g to %g %g %g\n", s.bounds.min.x, s.bounds.min.y, s.bounds.min.z,
                s.bounds.max.x, s.bounds.max.y, s.bounds.max.z);
    for (const data::FieldSummary& field : s.fields) {
        const std::string steps =
            field.steps == 1 ? "" : ", " + std::to_string(field.steps) + " steps";
        const data::Range& usual = field.spread.usual;
        const std::string outliers =
            usual == field.range
                ? ""
                : ", nearly all from " + number(usual.min) + " to " + number(usual.max);
        std::printf("field     \"%s\" per %s, %g to %g%s%s%s%s\n", field.name.c_str(),
                    s.isMesh ? text(field.association) : "voxel",
                    static_cast<double>(field.range.min), static_cast<double>(field.range.max),
                    field.unit.empty() ? "" : " ", field.unit.c_str(), outliers.c_str(),
                    steps.c_str());
    }
    for (const std::string& warning : imported.warnings)
        std::printf("note      %s\n", warning.c_str());
    std::printf("size      %.1f MB as drawn; import took %.0f ms and at most %.0f MB\n",
                static_cast<double>(s.bytes) / 1e6, imported.ms, imported.peakMb);
}

/// A bar on a terminal's stderr, nothing elsewhere.
class ProgressBar {
public:
    void operator()(const std::string& stage, double fraction) {
        if (!onTerminal_) return;
        constexpr int kWidth = 40;
        const int done = static_cast<int>(fraction * kWidth);
        std::fprintf(stderr, "\r%-8s [%.*s%.*s] %3.0f %%", stage.c_str(), done,
                     "########################################", kWidth - done,
                     "                                        ", fraction * 100.0);
        shown_ = true;
    }
    void clear() {
        if (shown_) std::fprintf(stderr, "\r%*s\r", 60, "");
        shown_ = false;
    }

private:
    bool onTerminal_ = ::isatty(STDERR_FILENO) != 0;
    bool shown_ = false;
};

int runImportCommand(ImportOptions options) {
    if (!options.spacing.empty()) {
        options.request.spacing = {options.spacing[0], options.spacing[1], options.spacing[2]};
    }
    options.settings.deadline =
        std::chrono::milliseconds{static_cast<std::int64_t>(options.deadlineSeconds * 1000.0)};
    options.settings.maxMemoryBytes = options.maxMemoryMb << 20;
    ProgressBar bar;
    const auto imported = workers::runImport(
        options.request, options.settings,
        [&](const std::string& stage, double fraction) { bar(stage, fraction); });
    bar.clear();
    if (!imported) {
        if (options.asJson) {
            const json::object error{{"error", name(imported.error().code)},
                                     {"message", imported.error().message}};
            std::printf("%s\n", jsonText(error).c_str());
        }
        std::fprintf(stderr, "volcast import: %s\n", imported.error().message.c_str());
        return 1;
    }
    if (options.asJson) {
        std::printf("%s\n", jsonText(asJson(*imported)).c_str());
    } else {
        print(*imported);
    }
    return 0;
}

}  // namespace

void addImportCommand(CLI::App& app, int& exitCode) {
    auto options = std::make_shared<ImportOptions>();
    CLI::App* command =
        app.add_subcommand("import", "Inspects a dataset: what would be drawn of it");
    command->footer("Exit code: 0 read, 1 refused, 2 wrong options.");
    command
        ->add_option("dataset", options->request.path,
                     "A file, a folder of pictures, demo:mesh or demo:volume")
        ->required();
    command
        ->add_option("--tetgen-switches", options->request.tetgenSwitches,
                     "How TetGen fills surfaces")
        ->capture_default_str();
    command
        ->add_option("--spacing", options->spacing,
                     "Distance of pixels and slices in image stacks: X Y Z")
        ->expected(3)
        ->check(CLI::PositiveNumber);
    command->add_flag("--json", options->asJson, "One line of JSON instead of text");
    command->add_option("--timeout", options->deadlineSeconds, "Seconds")
        ->check(CLI::Range(0.001, 86400.0))
        ->capture_default_str();
    command->add_option("--max-memory", options->maxMemoryMb, "MiB that the import may use")
        ->check(CLI::Range(64, 1 << 20))
        ->capture_default_str();
    command->callback([options, &exitCode] { exitCode = runImportCommand(*options); });
}

}  // namespace volcast::commands
