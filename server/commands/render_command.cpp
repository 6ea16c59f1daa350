#include "server/commands/render_command.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <utility>

#include <CLI/CLI.hpp>
#include <boost/json.hpp>

#include "renderer/scene/ray_models.h"
#include "renderer/worker/frame_message.h"
#include "server/commands/files.h"
#include "server/commands/json_text.h"
#include "server/commands/offline_renderer.h"
#include "server/commands/preparation.h"
#include "server/commands/render_options.h"
#include "server/commands/render_scene.h"
#include "server/commands/warnings_only.h"
#include "server/video/encoder.h"

namespace volcast::commands {

namespace {

namespace json = boost::json;

/// Times of the frames after the warm-up frame, in ms.
struct Times {
    std::vector<double> draw, readback, cpu;
};

double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

/// Hundredths are enough, and more would only pretend.
double rounded(double value) {
    return std::round(value * 100.0) / 100.0;
}

/// Frame k turns the eye by k * orbit; frame 0, the warm-up, has been drawn.
Result<Times> measure(OfflineRenderer& renderer, const workers::RenderRequest& first,
                      const RenderOptions& options, Progress& progress) {
    Times times;
    for (int k = 1; k <= options.frames; ++k) {
        workers::RenderRequest request = first;
        request.tag = static_cast<std::uint64_t>(k);
        request.wantFloat = false;
        request.scene.camera = scene::orbit(first.scene.camera, k * options.orbitDegrees);
        for (scene::Layer& layer : request.scene.layers) {
            for (float& level : layer.levels.values)
                level += static_cast<float>(k) * options.levelStep;
        }
        const auto frame = renderer.draw(request);
        if (!frame) return frame.error();
        times.draw.push_back(frame->uploadMs + frame->drawMs);
        times.readback.push_back(frame->readbackMs);
        times.cpu.push_back(frame->cpuMs);
        progress.show("frames", static_cast<double>(k) / options.frames);
    }
    progress.clear();
    return times;
}

Result<void> save(const workers::Picture& picture, const RenderOptions& options) {
    if (!options.png.empty()) {
        const auto png = video::encodePng({.size = picture.size, .rgba = picture.rgba8});
        if (!png) return png.error();
        if (auto done = writeFile(options.png, *png); !done) return done;
    }
    if (options.raw.empty()) return {};
    return writeFile(options.raw, std::as_bytes(std::span{picture.rgba32f}));
}

void explain(const plan::FramePlan& plan) {
    std::printf("plan %s\n", plan.id.c_str());
    for (const plan::LayerPlan& layer : plan.layers) {
        std::printf("layer %s: %s%s%s%s\n", layer.layer.c_str(), worker::name(layer.evaluator),
                    layer.integrator.empty() ? "" : ", ", layer.integrator.c_str(),
                    layer.drawn ? "" : ", not drawn");
        if (layer.stepWorld > 0.0) std::printf("  step %g world units\n", layer.stepWorld);
        for (const plan::Effect& effect : layer.effects) {
            std::printf("  %-3s %s: %s\n", effect.on ? "on" : "off", effect.name.c_str(),
                        effect.reason.c_str());
        }
    }
}

/// The keys that the other programs' harness prints, and some more.
json::object report(const RenderOptions& options, const workers::ImportedDataset& data,
                    const scene::Scene& scene, const workers::RenderedFrame& first,
                    const Times& times, const std::string& gl, double peakMb, double loadMs) {
    json::object line{
        {"data", std::filesystem::path{options.scene.dataset}.filename().string()},
        {"model",
         scene.layers.empty() ? std::string{} : std::string{scene::name(scene.layers[0].model)}},
        {"size", {options.scene.size[0], options.scene.size[1]}},
        {"frames", options.frames},
        {"median_ms", rounded(median(times.draw))},
        {"min_ms", rounded(std::ranges::min(times.draw))},
        {"max_ms", rounded(std::ranges::max(times.draw))},
        {"cpu_ms", rounded(median(times.cpu))},
        {"first_ms", rounded(first.uploadMs + first.drawMs)},
        {"readback_ms", rounded(median(times.readback))},
        {"load_ms", rounded(loadMs)},
        {"peak_mb", rounded(peakMb)},
        {"gl", gl},
        {"plan", first.plan.id}};
    if (data.summary.isMesh) {
        line["cells"] = data.summary.cells;
    } else {
        const glm::ivec3 voxels = data.summary.voxels;
        line["voxels"] = {voxels.x, voxels.y, voxels.z};
    }
    return line;
}

Result<void> draw(const RenderOptions& options) {
    for (const std::string* path : {&options.png, &options.raw}) {
        if (path->empty()) continue;
        if (auto writable = checkWritable(*path); !writable) return writable;
    }
    Progress progress;
    const auto loadStart = std::chrono::steady_clock::now();
    auto data = importFor(options.scene, progress);
    if (!data) return std::move(data).error();
    const double loadMs =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - loadStart)
            .count();
    for (const std::string& warning : data->warnings) {
        std::fprintf(stderr, "volcast render: note: %s\n", warning.c_str());
    }
    auto scene = sceneFor(options.scene, data->summary);
    if (!scene) return std::move(scene).error();
    auto renderer = OfflineRenderer::create(settingsFor(options.scene));
    if (!renderer) return std::move(renderer).error();
    renderer->service().addDataset(kRenderDataset, std::move(data->packed));

    workers::RenderRequest request;
    request.view = 1;
    request.scene = *scene;
    request.size = {options.scene.size[0], options.scene.size[1]};
    request.wantFloat = !options.raw.empty();
    const auto first = renderer->draw(request);
    if (!first) return first.error();
    const OfflineRenderer::Effort effort = renderer->effort();
    if (auto saved = save(*first->picture, options); !saved) return saved;
    if (options.explain) explain(first->plan);
    if (options.explain && effort.pictures > 1) {
        std::printf(
            "ready after %d pictures and %.0f ms, the first after %.0f ms; %.1f MiB uploaded\n",
            effort.pictures, effort.ms, effort.firstMs,
            static_cast<double>(effort.uploadedBytes) / (1 << 20));
    }
    if (options.frames == 0) return {};
    const auto times = measure(*renderer, request, options, progress);
    if (!times) return times.error();
    const json::object line =
        report(options, *data, *scene, *first, *times, renderer->service().status().glRenderer,
               first->workerPeakMb, loadMs);
    std::printf("%s\n", jsonText(line).c_str());
    return {};
}

int run(const RenderOptions& options) {
    logWarningsOnly("volcast render");
    const Result<void> done = draw(options);
    if (done) return 0;
    std::fprintf(stderr, "volcast render: %s\n", done.error().message.c_str());
    return 1;
}

}  // namespace

void addRenderCommand(CLI::App& app, int& exitCode) {
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command =
        app.add_subcommand("render", "Draws a dataset to a file, or measures how fast it is drawn");
    command->footer("Exit code: 0 done, 1 failed, 2 wrong options.");
    addOptions(*command, *options);
    command->callback([options, &exitCode] { exitCode = run(*options); });
}

}  // namespace volcast::commands
