#include "server/commands/accuracy_command.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <set>
#include <utility>

#include <CLI/CLI.hpp>

#include "renderer/scene/ray_models.h"
#include "server/commands/accuracy_options.h"
#include "server/commands/accuracy_plot.h"
#include "server/commands/accuracy_rows.h"
#include "server/commands/files.h"
#include "server/commands/json_text.h"
#include "server/commands/offline_renderer.h"
#include "server/commands/preparation.h"
#include "server/commands/render_scene.h"
#include "server/commands/warnings_only.h"

namespace volcast::commands {

namespace {

/// A row before it is measured.
struct Planned {
    AccuracyRow row;
    scene::Scene scene = {};
    accuracy::Candidate candidate = {};
};

bool among(const std::vector<std::string>& chosen, std::string_view name) {
    return chosen.empty() || std::ranges::count(chosen, name) != 0;
}

/// The words of this process, quoted for a shell.
std::string commandLine() {
    std::ifstream stream{"/proc/self/cmdline", std::ios::binary};
    const std::string words{std::istreambuf_iterator<char>{stream}, {}};
    const auto plain = [](unsigned char c) {
        constexpr std::string_view kPlain = "-_./:=,+@%";
        return std::isalnum(c) != 0 || kPlain.find(static_cast<char>(c)) != kPlain.npos;
    };
    std::string line = "volcast";
    std::size_t at = words.find('\0');
    while (at != std::string::npos && at + 1 < words.size()) {
        const std::size_t end = words.find('\0', at + 1);
        const std::string word = words.substr(at + 1, end - at - 1);
        at = end;
        if (!word.empty() && std::ranges::all_of(word, plain)) {
            line += " " + word;
            continue;
        }
        line += " '";
        for (const char c : word) line += c == '\'' ? std::string{"'\\''"} : std::string{c};
        line += "'";
    }
    return line;
}

void plan(std::vector<Planned>& rows, const scene::Scene& scene, const AccuracyOptions& options,
          const AccuracyRow& common = {}) {
    std::set<std::string> volumes;
    if (!common.sampling.empty()) volumes.insert(kRenderDataset);
    for (const accuracy::Candidate& candidate : accuracy::candidates(scene, volumes)) {
        const scene::Layer& layer = scene.layers[candidate.layer];
        const std::string integrator{scene::name(candidate.integrator)};
        const std::string evaluator{scene::name(candidate.evaluator)};
        if (!among(options.integrators, integrator) || !among(options.evaluators, evaluator)) {
            continue;
        }
        rows.push_back({.row = {.model = std::string{scene::name(layer.model)},
                                .layer = layer.id,
                                .integrator = integrator,
                                .evaluator = evaluator,
                                .sampling = common.sampling,
                                .step = common.step},
                        .scene = scene,
                        .candidate = candidate});
    }
}

/// Rows of one scene; of voxels for each way to sample them that the options leave open.
void planAll(std::vector<Planned>& rows, const scene::Scene& scene, const AccuracyOptions& options,
             const data::DatasetSummary& summary) {
    if (summary.isMesh) return plan(rows, scene, options);
    using scene::Sampling;
    constexpr std::array kSamplings{Sampling::kNearest, Sampling::kTrilinear, Sampling::kTricubic};
    constexpr std::array kSteps{2.0, 1.0, 0.5, 0.25};  // Smallest spacings.
    const glm::dvec3 spacing = summary.spacing;
    const double smallest = std::min({spacing.x, spacing.y, spacing.z});
    const bool document = !options.scene.sceneFile.empty();
    const bool stepGiven = document || options.scene.step > 0.0 || options.scene.depthSamples > 0;
    for (const Sampling sampling : kSamplings) {
        if (!options.scene.sampling.empty() && name(sampling) != options.scene.sampling) continue;
        for (const double step : kSteps) {
            scene::Scene one = scene;
            for (scene::Layer& layer : one.layers) {
                if (!document) layer.sampling = sampling;
                if (!stepGiven) layer.stepWorld = step * smallest;
            }
            const std::string named{name(document ? one.layers.front().sampling : sampling)};
            plan(rows, one, options, {.sampling = named, .step = stepGiven ? 0.0 : step});
            if (stepGiven) break;
        }
        if (document) break;
    }
}

/// One scene a model, or the one of the document.
///
/// Errors: as sceneFor(), for a model that was asked for by name; others become a refused row.
Result<std::vector<Planned>> plannedRows(const AccuracyOptions& options,
                                         const data::DatasetSummary& summary) {
    std::vector<Planned> rows;
    if (!options.scene.sceneFile.empty()) {
        const auto scene = sceneFor(options.scene, summary);
        if (!scene) return scene.error();
        planAll(rows, *scene, options, summary);
        return rows;
    }
    std::vector<std::string> models = options.models;
    if (models.empty()) {
        for (const scene::RayModelRow& row : scene::rayModels()) {
            const bool drawn = summary.isMesh ? row.onMeshes : row.onVolumes && !row.chunk.empty();
            if (drawn) models.emplace_back(row.name);
        }
    }
    for (const std::string& model : models) {
        SceneOptions one = options.scene;
        one.model = model;
        const auto scene = sceneFor(one, summary);
        if (scene) {
            planAll(rows, *scene, options, summary);
        } else if (!options.models.empty()) {
            return scene.error();
        } else {
            rows.push_back({.row = {.model = model, .refusal = scene.error().message}});
        }
    }
    return rows;
}

/// Errors: kDeviceLost; all other errors become a part of the rows.
Result<void> measure(OfflineRenderer& renderer, std::vector<Planned>& rows,
                     const AccuracyOptions& options, Progress& progress) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        Planned& planned = rows[i];
        if (!planned.row.refusal.empty()) continue;
        progress.show(
            planned.row.model + " " + planned.row.integrator + " " +
                (planned.row.sampling.empty() ? planned.row.evaluator : planned.row.sampling),
            static_cast<double>(i) / static_cast<double>(rows.size()));
        auto measured = renderer.measure({.scene = planned.scene,
                                          .size = {options.scene.size[0], options.scene.size[1]},
                                          .candidate = planned.candidate,
                                          .frames = options.frames,
                                          .pixels = options.sample,
                                          .countsSteps = true});
        if (measured) {
            planned.row.measured = *std::move(measured);
        } else if (measured.error().code == ErrorCode::kDeviceLost) {
            return measured.error();
        } else {
            planned.row.refusal = measured.error().message;
        }
    }
    progress.clear();
    return {};
}

Result<void> write(const AccuracyRun& run, const AccuracyOptions& options) {
    if (!options.json.empty()) {
        const std::string text = jsonText(jsonOf(run)) + "\n";
        if (auto done = writeFile(options.json, std::as_bytes(std::span{text})); !done) return done;
    }
    if (options.svg.empty()) return {};
    const std::string text = plotOf(run);
    return writeFile(options.svg, std::as_bytes(std::span{text}));
}

Result<void> checkFiles(const AccuracyOptions& options) {
    for (const std::string* path : {&options.json, &options.svg}) {
        if (path->empty()) continue;
        if (auto writable = checkWritable(*path); !writable) return writable;
    }
    return {};
}

std::uint64_t voxelsOf(const data::DatasetSummary& summary) {
    const glm::ivec3 size = summary.voxels;
    return static_cast<std::uint64_t>(size.x) * size.y * size.z;
}

Result<void> measureAll(const AccuracyOptions& options) {
    if (auto writable = checkFiles(options); !writable) return writable;
    Progress progress;
    auto data = importFor(options.scene, progress);
    if (!data) return std::move(data).error();
    auto rows = plannedRows(options, data->summary);
    if (!rows) return std::move(rows).error();
    if (rows->empty()) {
        return fail(ErrorCode::kUnsupported,
                    "no integrator and evaluator among those asked for serves these models");
    }
    auto renderer = OfflineRenderer::create(settingsFor(options.scene));
    if (!renderer) return std::move(renderer).error();
    renderer->service().addDataset(kRenderDataset, std::move(data->packed));
    if (auto done = measure(*renderer, *rows, options, progress); !done) return done;

    AccuracyRun run{.command = commandLine(),
                    .data = std::filesystem::path{options.scene.dataset}.filename().string(),
                    .cells = data->summary.isMesh ? data->summary.cells : voxelsOf(data->summary),
                    .unit = data->summary.isMesh ? "cells" : "voxels",
                    .size = {options.scene.size[0], options.scene.size[1]},
                    .frames = options.frames,
                    .gl = renderer->service().status().glRenderer,
                    .rows = {}};
    for (Planned& planned : *rows) run.rows.push_back(std::move(planned.row));
    markFronts(run.rows);
    std::printf("%s: %llu %s, %d x %d pixels, %d frames each, %s\n%s%s\n%s\n", run.data.c_str(),
                static_cast<unsigned long long>(run.cells), run.unit.c_str(), run.size.x,
                run.size.y, run.frames, run.gl.c_str(), tableOf(run).c_str(),
                referenceLineOf(run).c_str(), run.command.c_str());
    return write(run, options);
}

int run(const AccuracyOptions& options) {
    logWarningsOnly("volcast accuracy");
    const Result<void> done = measureAll(options);
    if (done) return 0;
    std::fprintf(stderr, "volcast accuracy: %s\n", done.error().message.c_str());
    return 1;
}

}  // namespace

void addAccuracyCommand(CLI::App& app, int& exitCode) {
    auto options = std::make_shared<AccuracyOptions>();
    CLI::App* command = app.add_subcommand(
        "accuracy", "Measures what each ray model, integrator and evaluator is worth, and costs");
    command->footer(
        "Errors are in linear light against a reference in double precision; a * marks what no\n"
        "other row of its model beats in error (rms) and time. Cells per ray are those that the\n"
        "reference's rays meet; steps per ray are what the walk's shader took (a cell crossed, "
        "one\n"
        "more part of a split piece, the search for entries where a mesh is not convex); cells\n"
        "drawn are the projection's: of isosurfaces one for each level that a cell meets.\n"
        "Voxels are drawn with each sampling and with steps of 2 to 1/4 of the smallest spacing, "
        "but\n"
        "for what --sampling, --step or --depth-samples say; each sampling has a reference of its "
        "own.\n"
        "Exit code: 0 done, 1 failed, 2 wrong options.");
    addOptions(*command, *options);
    command->callback([options, &exitCode] { exitCode = run(*options); });
}

}  // namespace volcast::commands
