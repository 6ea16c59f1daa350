#include "renderer/accuracy/meter.h"

#include <algorithm>
#include <ctime>
#include <sys/resource.h>
#include <thread>
#include <utility>

#include "renderer/accuracy/compare.h"

namespace volcast::accuracy {
namespace {

/// No view of a client has these numbers, nor has the warm-up (0).
constexpr std::uint64_t kView = ~std::uint64_t{0};
constexpr std::uint64_t kViewInParts = kView - 1;
constexpr std::size_t kTruthsKept = 4;  // However large; more while they are small.
constexpr std::size_t kPixelsKept = std::size_t{1} << 20;
constexpr double kTurnDegrees = 1e-3;
/// A call of advance() waits so long for the reference: little beside a picture.
constexpr std::chrono::milliseconds kPatience{5};
constexpr int kBackgroundNice = 10;  // Pictures first.

/// What decides the truth of a picture, all else at its default.
scene::Scene essence(scene::Scene scene) {
    scene.accuracy = {};
    scene.background = scene::Scene{}.background;
    for (scene::Layer& layer : scene.layers) {
        layer.integrator = scene::Integrator::kAuto;
        layer.evaluator = scene::MeshEvaluator::kAuto;
        layer.voxelEvaluator = scene::VoxelEvaluator::kAuto;
        layer.stepWorld = 0.0;
        layer.depthSamples = 0;
        layer.jitter.reset();
    }
    return scene;
}

bool uses(const scene::Scene& scene, const std::string& dataset) {
    return std::ranges::any_of(scene.layers,
                               [&](const scene::Layer& layer) { return layer.dataset == dataset; });
}

int threadCount() {
    return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

double threadCpuSeconds() {
    timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

double medianOf(const std::vector<double>& sorted) {
    const std::size_t half = sorted.size() / 2;
    return sorted.size() % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
}

}  // namespace

void Meter::forget(const std::string& dataset) {
    if (search_ && uses(search_->question.scene, dataset)) search_.reset();
    if (run_ && uses(run_->scene, dataset)) stop();
    bodies_.erase(dataset);
    std::erase_if(truths_, [&](const Truth& truth) { return uses(truth.question.scene, dataset); });
}

Meter::Question Meter::questionOf(const scene::Scene& scene, scene::PictureSize size,
                                  std::vector<glm::ivec2> pixels) {
    return {.scene = essence(scene), .size = size, .pixels = std::move(pixels)};
}

Meter::Datasets Meter::datasetsOf(const scene::Scene& scene) const {
    Datasets datasets;
    for (const scene::Layer& layer : scene.layers) {
        const data::Dataset* dataset = renderer_.dataset(layer.dataset);
        if (dataset != nullptr) datasets[layer.dataset] = dataset;
    }
    return datasets;
}

Result<Meter::Answer> Meter::ask(const Question& question, reference::Bodies bodies,
                                 const Datasets& datasets, const std::atomic<bool>* cancelled) {
    const double start = threadCpuSeconds();
    for (const auto& [id, dataset] : datasets) {
        if (!bodies.contains(id)) bodies[id] = reference::makeBody(*dataset);
    }
    const double treeSeconds = threadCpuSeconds() - start;
    auto picture = reference::draw(question.scene, bodies, question.size, question.pixels,
                                   threadCount(), cancelled);
    if (!picture) return std::move(picture).error();
    return Answer{
        .picture = *std::move(picture), .bodies = std::move(bodies), .treeSeconds = treeSeconds};
}

Meter::Truth* Meter::known(const Question& question) {
    const auto found = std::ranges::find(truths_, question, &Truth::question);
    if (found == truths_.end()) return nullptr;
    truths_.splice(truths_.begin(), truths_, found);
    return &truths_.front();
}

Meter::Truth* Meter::keep(Question question, Answer answer) {
    bodies_.merge(answer.bodies);
    const ReferenceEffort effort{.rays = answer.picture.rays,
                                 .raySeconds = answer.picture.cpuSeconds,
                                 .treeSeconds = answer.treeSeconds};
    truths_.push_front(
        {.question = std::move(question), .picture = std::move(answer.picture), .effort = effort});
    std::size_t kept = 0;
    std::size_t pixelsKept = 0;
    std::erase_if(truths_, [&](const Truth& truth) {
        pixelsKept += truth.question.pixels.size();
        return ++kept > kTruthsKept && pixelsKept > kPixelsKept;
    });
    return &truths_.front();
}

Result<Meter::Truth*> Meter::truthOf(const Question& question) {
    if (Truth* truth = known(question)) return truth;
    auto answer = ask(question, bodies_, datasetsOf(question.scene), nullptr);
    if (!answer) return std::move(answer).error();
    return keep(question, *std::move(answer));
}

Result<Meter::Truth*> Meter::searchFor(const Question& question) {
    if (Truth* truth = known(question)) return truth;
    if (!search_ || search_->question != question) {
        search_.reset();
        search_ = std::make_unique<Search>();
        search_->question = question;
        const auto work = [search = search_.get(), bodies = bodies_,
                           datasets = datasetsOf(search_->question.scene)] {
            ::setpriority(PRIO_PROCESS, 0, kBackgroundNice);  // Of this thread and its own.
            return ask(search->question, bodies, datasets, &search->cancelled);
        };
        search_->answer = std::async(std::launch::async, work);
    }
    if (search_->answer.wait_for(kPatience) != std::future_status::ready) {
        return static_cast<Truth*>(nullptr);
    }
    const std::unique_ptr<Search> ended = std::move(search_);
    auto answer = ended->answer.get();
    if (!answer) return std::move(answer).error();
    return keep(std::move(ended->question), *std::move(answer));
}

Result<double> Meter::cellsPerRay(const scene::Scene& scene, scene::PictureSize size,
                                  std::uint64_t pixels) {
    const auto truth = truthOf(questionOf(scene, size, samplePixels(size, pixels)));
    if (!truth) return truth.error();
    return static_cast<double>((*truth)->picture.piecesVisited) /
           static_cast<double>((*truth)->question.pixels.size());
}

Result<Meter::Run> Meter::begin(const Job& job, std::uint64_t view) {
    if (job.aim == Aim::kPicture) {
        auto pixels = gridPixels(job.size, job.grid);
        if (pixels.empty()) return fail(ErrorCode::kInvalidArgument, "a grid without pixels");
        return Run{.job = job,
                   .view = view,
                   .scene = job.scene,
                   .question = questionOf(job.scene, job.size, std::move(pixels))};
    }
    if (job.aim == Aim::kTime) return Run{.job = job, .view = view, .scene = job.scene};
    if (job.candidate.layer >= job.scene.layers.size()) {
        return fail(ErrorCode::kInvalidArgument, "layer " + std::to_string(job.candidate.layer) +
                                                     " of a scene with " +
                                                     std::to_string(job.scene.layers.size()));
    }
    return Run{.job = job,
               .view = view,
               .scene = withCandidate(job.scene, job.candidate),
               .question = questionOf(job.scene, job.size, samplePixels(job.size, job.pixels))};
}

Result<bool> Meter::drawNext(Run& run) {
    const Job& job = run.job;
    const int last = job.frames + (job.countsSteps ? 1 : 0);
    if (run.drawn > last) return false;
    const bool compared = run.drawn == 0 && job.aim != Aim::kTime;
    const bool timed = run.drawn > 0 && run.drawn <= job.frames;
    scene::Scene scene = run.scene;
    if (timed) scene.camera = scene::orbit(scene.camera, run.drawn * kTurnDegrees);
    if (compared) run.rgba.resize(std::size_t{4} * job.size.x * job.size.y);
    const auto frame =
        renderer_.render(run.view, scene, job.size,
                         {.rgba32f = compared ? std::span{run.rgba} : std::span<float>{},
                          .complete = true,
                          .countsSteps = !compared && !timed},
                         run.evidence);
    if (!frame) return frame.error();
    ++run.drawn;
    if (job.aim == Aim::kPicture || (job.aim == Aim::kTime && !timed)) return true;
    if (compared) {
        const plan::LayerPlan& plan = frame->plan.layers.at(job.candidate.layer);
        run.measured.evaluator = plan.evaluator;
        run.measured.integrator = plan.integrator;
        run.drawnWith = plan.drawnWith.empty() ? plan.layer : plan.drawnWith;
    } else if (timed) {
        run.times.push_back(frame->uploadMs + frame->drawMs);
    } else {
        const auto steps =
            std::ranges::find(frame->steps, run.drawnWith, &scene::LayerSteps::layer);
        if (steps == frame->steps.end()) return true;
        run.measured.walkSteps = steps->walkSteps;
        run.measured.cellsDrawn = steps->cellsDrawn;
    }
    return true;
}

Measurement Meter::finish(Run& run, Truth* truth) {
    Measurement measured = std::move(run.measured);
    if (!run.times.empty()) {
        std::ranges::sort(run.times);
        measured.medianMs = medianOf(run.times);
        measured.minMs = run.times.front();
        measured.maxMs = run.times.back();
        measured.frames = run.job.frames;
    }
    if (truth == nullptr) return measured;
    const std::vector<glm::ivec2>& pixels = truth->question.pixels;
    Difference off = compare(truth->picture, pixels, run.rgba, run.job.size.x);
    measured.all = off.all;
    measured.inner = off.inner;
    if (run.job.aim == Aim::kPicture) measured.off = std::move(off.off);
    measured.cellsPerRay =
        static_cast<double>(truth->picture.piecesVisited) / static_cast<double>(pixels.size());
    measured.reference = std::exchange(truth->effort, {});
    return measured;
}

Result<Measurement> Meter::measure(const Job& job) {
    auto run = begin(job, kView);
    if (!run) return std::move(run).error();
    Result<bool> drawn = true;
    while (drawn && *drawn) drawn = drawNext(*run);
    renderer_.dropView(kView);
    if (!drawn) return drawn.error();
    const auto truth = truthOf(run->question);
    if (!truth) return truth.error();
    return finish(*run, *truth);
}

Result<std::optional<Measurement>> Meter::advance(const Job& job,
                                                  const plan::SceneEvidence& evidence) {
    if (!run_ || run_->job != job) {
        stop();
        auto run = begin(job, kViewInParts);
        if (!run) return std::move(run).error();
        run_ = *std::move(run);
        run_->evidence = evidence;
    }
    Truth* none = nullptr;
    Result<Truth*> truth = none;
    if (run_->drawn > 0 &&
        job.aim !=
            Aim::kTime) {  // The picture to compare is drawn; times wait until no thread is busy.
        truth = searchFor(run_->question);
        if (truth && *truth == none) return std::nullopt;
    }
    const Result<bool> drawn = truth ? drawNext(*run_) : Result<bool>{truth.error()};
    if (drawn && *drawn) return std::nullopt;
    std::optional<Measurement> measured;
    if (drawn) measured = finish(*run_, *truth);
    stop();
    if (!drawn) return drawn.error();
    return measured;
}

void Meter::stop() {
    search_.reset();
    if (!run_) return;
    run_.reset();
    renderer_.dropView(kViewInParts);
}

}  // namespace volcast::accuracy
