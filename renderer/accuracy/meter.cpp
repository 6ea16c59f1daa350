#include "renderer/accuracy/meter.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "renderer/accuracy/compare.h"

namespace volcast::accuracy {
namespace {

/// No view of a client has this number, nor has the warm-up (0).
constexpr std::uint64_t kView = ~std::uint64_t{0};
constexpr std::size_t kTruthsKept = 4;
constexpr double kTurnDegrees = 1e-3;

/// What decides the truth of a picture, all else at its default.
scene::Scene essence(scene::Scene scene) {
    scene.accuracy = {};
    scene.background = scene::Scene{}.background;
    for (scene::Layer& layer : scene.layers) {
        layer.integrator = scene::Integrator::kAuto;
        layer.evaluator = scene::MeshEvaluator::kAuto;
    }
    return scene;
}

int threadCount() {
    return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

double medianOf(std::vector<double> sorted) {
    const std::size_t half = sorted.size() / 2;
    return sorted.size() % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
}

}  // namespace

void Meter::forget(const std::string& dataset) {
    casters_.erase(dataset);
    std::erase_if(truths_, [&](const Truth& truth) {
        return std::ranges::any_of(truth.scene.layers, [&](const scene::Layer& layer) {
            return layer.dataset == dataset;
        });
    });
}

Result<const Meter::Truth*> Meter::truthOf(const scene::Scene& scene, scene::PictureSize size,
                                           std::uint64_t count) {
    scene::Scene wanted = essence(scene);
    std::vector<glm::ivec2> pixels = samplePixels(size, count);
    const auto known = std::ranges::find_if(truths_, [&](const Truth& truth) {
        return truth.size == size && truth.pixels.size() == pixels.size() && truth.scene == wanted;
    });
    if (known != truths_.end()) {
        truths_.splice(truths_.begin(), truths_, known);
        return &truths_.front();
    }
    for (const scene::Layer& layer : wanted.layers) {
        const data::Dataset* dataset = renderer_.dataset(layer.dataset);
        const auto* mesh = dataset == nullptr ? nullptr : std::get_if<data::Mesh>(dataset);
        if (mesh == nullptr || casters_.contains(layer.dataset)) continue;
        casters_[layer.dataset] = reference::makeCaster(*mesh);
    }
    auto picture = reference::draw(wanted, casters_, size, pixels, threadCount());
    if (!picture) return std::move(picture).error();
    truths_.push_front({.scene = std::move(wanted),
                        .size = size,
                        .pixels = std::move(pixels),
                        .picture = *std::move(picture)});
    if (truths_.size() > kTruthsKept) truths_.pop_back();
    return &truths_.front();
}

Result<double> Meter::cellsPerRay(const scene::Scene& scene, scene::PictureSize size,
                                  std::uint64_t pixels) {
    const auto truth = truthOf(scene, size, pixels);
    if (!truth) return truth.error();
    return static_cast<double>((*truth)->picture.piecesVisited) /
           static_cast<double>((*truth)->pixels.size());
}

Result<void> Meter::time(const Job& job, const scene::Scene& scene, Measurement& measured) {
    std::vector<double> times;
    for (int k = 1; k <= job.frames; ++k) {
        scene::Scene turned = scene;
        turned.camera = scene::orbit(scene.camera, k * kTurnDegrees);
        const auto frame = renderer_.render(kView, turned, job.size, {});
        if (!frame) return frame.error();
        times.push_back(frame->uploadMs + frame->drawMs);
    }
    if (times.empty()) return {};
    std::ranges::sort(times);
    measured.medianMs = medianOf(times);
    measured.minMs = times.front();
    measured.maxMs = times.back();
    measured.frames = job.frames;
    return {};
}

Result<void> Meter::count(const Job& job, const scene::Scene& scene, const std::string& drawn,
                          Measurement& measured) {
    const auto frame = renderer_.render(kView, scene, job.size, {.countsSteps = true});
    if (!frame) return frame.error();
    const auto steps = std::ranges::find(frame->steps, drawn, &scene::LayerSteps::layer);
    if (steps == frame->steps.end()) return {};
    measured.walkSteps = steps->walkSteps;
    measured.cellsDrawn = steps->cellsDrawn;
    return {};
}

Result<Measurement> Meter::measure(const Job& job) {
    if (job.candidate.layer >= job.scene.layers.size()) {
        return fail(ErrorCode::kInvalidArgument, "layer " + std::to_string(job.candidate.layer) +
                                                     " of a scene with " +
                                                     std::to_string(job.scene.layers.size()));
    }
    const scene::Scene scene = withCandidate(job.scene, job.candidate);
    std::vector<float> rgba(std::size_t{4} * job.size.x * job.size.y);
    const auto frame = renderer_.render(kView, scene, job.size, {.rgba8 = {}, .rgba32f = rgba});
    if (!frame) return frame.error();
    Measurement measured;
    const plan::LayerPlan& plan = frame->plan.layers.at(job.candidate.layer);
    measured.evaluator = plan.evaluator;
    measured.integrator = plan.integrator;
    Result<void> drawn = time(job, scene, measured);
    if (drawn && job.countsSteps) {
        drawn = count(job, scene, plan.drawnWith.empty() ? plan.layer : plan.drawnWith, measured);
    }
    renderer_.dropView(kView);
    if (!drawn) return drawn.error();
    const auto truth = truthOf(job.scene, job.size, job.pixels);
    if (!truth) return truth.error();
    const std::vector<glm::ivec2>& pixels = (*truth)->pixels;
    const reference::Picture& picture = (*truth)->picture;
    const Difference off = compare(picture, pixels, rgba, job.size.x);
    measured.all = off.all;
    measured.inner = off.inner;
    measured.cellsPerRay =
        static_cast<double>(picture.piecesVisited) / static_cast<double>(pixels.size());
    return measured;
}

}  // namespace volcast::accuracy
