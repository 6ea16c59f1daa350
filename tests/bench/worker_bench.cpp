// frame/<data>/<model>/<side>: one orbit step of the demo through a real worker, until its picture
// is here. recovery/<what>: SIGKILL to the next correct picture.
#include <algorithm>
#include <condition_variable>
#include <csignal>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include "renderer/data/mesh_builder.h"
#include "renderer/data/packed_dataset.h"
#include "renderer/scene/default_scene.h"
#include "server/workers/import_service.h"
#include "server/workers/render_service.h"

namespace volcast::bench {
namespace {

using Clock = std::chrono::steady_clock;

/// kSide^3 cubes of six tetrahedra with a linear field: 105,456 cells.
data::Dataset largeMesh() {
    constexpr int kSide = 26, kPoints = kSide + 1;
    data::MeshInput input;
    data::FieldInput field{.name = "f",
                           .unit = {},
                           .association = data::Association::kVertex,
                           .steps = {{}},
                           .times = {}};
    for (int at = 0; at < kPoints * kPoints * kPoints; ++at) {
        const glm::ivec3 cube{at % kPoints, at / kPoints % kPoints, at / (kPoints * kPoints)};
        input.points.push_back(glm::dvec3{cube} / double{kSide});
        field.steps[0].push_back((cube.x + 2 * cube.y + 3 * cube.z) / (6.0 * kSide));
    }
    // Kuhn's six: along the paths from the lowest to the highest corner.
    constexpr int kStep[3] = {1, kPoints, kPoints * kPoints};
    constexpr int kOrders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                   {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (int at = 0; at < kSide * kSide * kSide; ++at) {
        const int corner =
            at % kSide + at / kSide % kSide * kStep[1] + at / (kSide * kSide) * kStep[2];
        for (const auto& order : kOrders) {
            const int second = corner + kStep[order[0]], third = second + kStep[order[1]];
            input.cells.push_back({corner, second, third, third + kStep[order[2]]});
        }
    }
    input.fields.push_back(std::move(field));
    return data::buildMesh(std::move(input)).value();
}

/// A service with both demos and "large"; each picture is waited for.
class Stage {
public:
    explicit Stage(bool spare) {
        workers::RenderSettings settings;
        settings.warmSpare = spare;
        settings.frameDeadline = std::chrono::milliseconds{120'000};
        auto service =
            workers::RenderService::create(settings, {.rendered =
                                                          [this](workers::RenderedFrame frame) {
                                                              const std::scoped_lock lock{mutex_};
                                                              frame_ = std::move(frame);
                                                              came_.notify_all();
                                                          },
                                                      .failed = {},
                                                      .recovering = {}});
        if (!service) {
            error_ = service.error().message;
            return;
        }
        service_ = *std::move(service);
        for (const char* id : {"demo:mesh", "demo:volume"}) {
            workers::ImportRequest request;
            request.path = id;
            auto data = workers::runImport(request, {}, {});
            if (!data) {
                error_ = data.error().message;
                return;
            }
            summaries_[id] = data->summary;
            service_->addDataset(id, std::move(data->packed));
        }
        const data::Dataset large = largeMesh();
        summaries_["large"] = data::summarize(large);
        service_->addDataset("large", data::pack(large).value());
    }

    [[nodiscard]] const std::string& error() const { return error_; }
    [[nodiscard]] workers::RenderService& service() { return *service_; }

    [[nodiscard]] workers::RenderRequest request(const std::string& id, scene::RayModel model,
                                                 int side) const {
        const data::DatasetSummary& summary = summaries_.at(id);
        workers::RenderRequest request;
        request.view = 1;
        request.scene = scene::defaultScene(id, summary);
        request.scene.layers = {
            scene::defaultLayer(id, summary, summary.fields.front().name, model)};
        request.size = {side, side};
        return request;
    }

    std::optional<workers::RenderedFrame> draw(const workers::RenderRequest& request) {
        {
            const std::scoped_lock lock{mutex_};
            frame_.reset();
        }
        service_->submit(request);
        return wait();
    }

    std::optional<workers::RenderedFrame> wait() {
        std::unique_lock lock{mutex_};
        came_.wait_for(lock, std::chrono::seconds{120}, [this] { return frame_.has_value(); });
        return std::exchange(frame_, std::nullopt);
    }

private:
    std::map<std::string, data::DatasetSummary> summaries_;
    std::mutex mutex_;
    std::condition_variable came_;
    std::optional<workers::RenderedFrame> frame_;
    std::string error_;
    std::unique_ptr<workers::RenderService> service_;  // Ends first: it calls back.
};

void frame(benchmark::State& state, const std::string& id, scene::RayModel model) {
    Stage stage{false};
    if (!stage.error().empty()) return state.SkipWithError(stage.error().c_str());
    const int side = static_cast<int>(state.range(0));
    workers::RenderRequest request = stage.request(id, model, side);
    if (!stage.draw(request)) return state.SkipWithError("the first picture never came");
    double drawMs = 0.0;
    for (auto _ : state) {
        request.scene.camera = scene::orbit(request.scene.camera, 36.0);
        const auto drawn = stage.draw(request);
        if (!drawn) return state.SkipWithError("a picture never came");
        drawMs += drawn->uploadMs + drawn->drawMs;
    }
    state.counters["draw_ms"] = drawMs / static_cast<double>(state.iterations());
    state.counters["Mray/s"] =
        benchmark::Counter(1e-6 * side * side, benchmark::Counter::kIsIterationInvariantRate);
}

double percentile(std::vector<double> sorted, double share) {
    std::ranges::sort(sorted);
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

/// From SIGKILL until the same picture has come again, bit for bit. The camera has moved since the
/// spare rehearsed, so the picture is drawn and not remembered.
void recovery(benchmark::State& state, bool spare, const std::string& id, scene::RayModel model,
              int side) {
    Stage stage{spare};
    if (!stage.error().empty()) return state.SkipWithError(stage.error().c_str());
    auto request = stage.request(id, model, side);
    if (!stage.draw(request)) return state.SkipWithError("the first picture never came");
    std::vector<double> tookMs;
    for (auto _ : state) {
        while (spare && !stage.service().status().spareReady) {
            std::this_thread::sleep_for(std::chrono::milliseconds{5});
        }
        request.scene.camera = scene::orbit(request.scene.camera, 36.0);
        const auto before = stage.draw(request);
        const auto start = Clock::now();
        ::kill(stage.service().status().workerPid, SIGKILL);
        const auto after = stage.wait();
        const auto took = Clock::now() - start;
        if (!before || !after || !after->drawn || after->picture->rgba8 != before->picture->rgba8) {
            return state.SkipWithError("the next picture is not the one before");
        }
        state.SetIterationTime(std::chrono::duration<double>(took).count());
        tookMs.push_back(std::chrono::duration<double, std::milli>(took).count());
        state.counters["upload_ms"] = after->uploadMs;  // Of the last one.
        state.counters["draw_ms"] = after->drawMs;
    }
    state.counters["p50_ms"] = percentile(tookMs, 0.5);
    state.counters["p95_ms"] = percentile(tookMs, 0.95);
}

void registerAll() {
    using scene::RayModel;
    struct Row {
        const char* name;
        const char* data;
        RayModel model;
    };
    for (const Row& row : {Row{"frame/mesh/surface", "demo:mesh", RayModel::kSurface},
                           Row{"frame/mesh/mip", "demo:mesh", RayModel::kMip},
                           Row{"frame/mesh/volume", "demo:mesh", RayModel::kVolume},
                           Row{"frame/volume/mip", "demo:volume", RayModel::kMip},
                           Row{"frame/volume/volume", "demo:volume", RayModel::kVolume}}) {
        benchmark::RegisterBenchmark(
            row.name, [row](benchmark::State& state) { frame(state, row.data, row.model); })
            ->Arg(512)
            ->Arg(1024)
            ->UseRealTime()
            ->Iterations(20)
            ->Unit(benchmark::kMillisecond);
    }
    for (const bool spare : {true, false}) {
        const std::string how = spare ? "spare" : "no_spare";
        const auto add = [&](const std::string& what, const char* id, RayModel model, int side) {
            benchmark::RegisterBenchmark(
                ("recovery/sigkill/" + what + how).c_str(),
                [=](benchmark::State& state) { recovery(state, spare, id, model, side); })
                ->UseManualTime()
                ->Iterations(40)
                ->Unit(benchmark::kMillisecond);
        };
        add("demo/", "demo:mesh", RayModel::kSurface, 256);
        add("100k_cells/", "large", RayModel::kVolume, 512);
    }
}

}  // namespace
}  // namespace volcast::bench

int main(int argc, char** argv) {
    // What it measured is alone on standard output: it may be JSON.
    spdlog::set_default_logger(spdlog::stderr_logger_mt("worker_bench"));
    volcast::bench::registerAll();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
