// How a worker goes, and what follows: its successor, what to draw again, what to tell; and the GPU
// that loses too many.
#include <utility>

#include <spdlog/spdlog.h>

#include "renderer/base/printable.h"
#include "renderer/base/software_gpu.h"
#include "server/workers/gpu_given_up.h"
#include "server/workers/supervisor.h"

namespace volcast::workers {

namespace {

/// After so many workers in a row that died before they were ready, requests fail.
constexpr int kFailuresToGiveUp = 3;

}  // namespace

void Supervisor::retire(Worker& worker) {
    rehearsal_.workerLost(worker->pid());
    ChildProcess child = worker->takeChild();
    worker.reset();
    child.kill();
    dying_.push_back(std::move(child));
}

bool Supervisor::onGpu() const {
    if (settings_.gpu == base::kSoftwareGpu) return false;
    return software_ ? !*software_ : !settings_.gpu.empty();
}

void Supervisor::judgeGpu(const std::string& reason) {
    if (!onGpu() || !gpuTrust_.isLost(Clock::now())) return;
    gpuGivenUp_ = "the GPU" + (settings_.gpu.empty() ? "" : " " + settings_.gpu) + " lost " +
                  std::to_string(GpuTrust::kMostLosses) + " workers, the last of which " + reason +
                  "; new ones draw by the CPU";
    spdlog::error(R"(event=gpu_given_up reason="{}")", base::printable(gpuGivenUp_, 1000));
    noteGpuGivenUp(cacheFolder_, gpuGivenUp_);
    settings_.gpu = base::kSoftwareGpu;
    if (spare_) retire(spare_);
    backOff_.succeeded();
    startAllowed_ = spareAllowed_ = Clock::now();
}

void Supervisor::lose(Worker& worker, const std::string& reason) {
    const bool isMain = &worker == &main_;
    const bool wasReady = worker->ready();
    const int pid = worker->pid();
    retire(worker);
    if (wasReady) {
        ++losses_;
        lastLoss_ = reason;
        spdlog::warn(R"(event=worker_lost worker={} role={} view={} reason="{}")", pid,
                     isMain ? "drawing" : "spare",
                     isMain && inFlight_ && !inFlight_->request.viewId.empty()
                         ? inFlight_->request.viewId
                         : "none",
                     base::printable(reason, 1000));
        spareAllowed_ = Clock::now() + kSpareDelay;
        if (isMain) return loseMain();
    }
    if (onGpu()) gpuTrust_.lost(Clock::now());
    judgeGpu(reason);
    if (!wasReady) {
        startFailed(startError_.value_or(
            fail(reason.starts_with("was not ready") ? ErrorCode::kTimeout : ErrorCode::kIo,
                 "GL worker " + reason)));
    }
    if (isMain) main_ = std::exchange(spare_, std::nullopt);
}

void Supervisor::loseMain() {
    ++generation_;
    const auto unmeasured = measures_.lost(Clock::now());
    const auto unpicked = std::exchange(pickInHand_, std::nullopt);
    auto inFlight = std::exchange(inFlight_, std::nullopt);
    std::optional<RenderRequest> request;
    if (inFlight) request = std::move(inFlight->request);
    const std::uint64_t suspect = request ? request->view : 0;
    const ViewQueue::Loss loss = views_.lost(std::move(request), Clock::now());
    if (onGpu() && loss.proven) gpuTrust_.lost(Clock::now());
    if (onGpu() && !loss.proven) gpuTrust_.lostOver(suspect, Clock::now());
    if (!loss.givenUp.empty()) gpuTrust_.forget(suspect);
    judgeGpu(lastLoss_);
    main_ = std::exchange(spare_, std::nullopt);
    startWorkers();
    dispatch();
    if (events_.recovering && !loss.views.empty()) events_.recovering(loss.views);
    if (unpicked) {
        tell(unpicked->request,
             fail(ErrorCode::kDeviceLost, "the GL worker was lost: " + lastLoss_));
    }
    for (const MeasureRequest& givenUp : unmeasured) {
        tell(givenUp, fail(ErrorCode::kDeviceLost, "the GL worker was lost: " + lastLoss_));
    }
    for (const RenderRequest& givenUp : loss.givenUp) {
        if (!events_.failed) break;
        events_.failed(
            givenUp.view, givenUp.tag,
            fail(ErrorCode::kDeviceLost,
                 "drawing this took down two GL workers in a row; the last one " + lastLoss_,
                 "scene"));
    }
}

void Supervisor::startFailed(const Error& error) {
    startError_ = error;
    backOff_.failed();
    startAllowed_ = spareAllowed_ = Clock::now() + backOff_.delay();
    if (!everReady_) return;  // begin() hands the error to its caller.
    spdlog::error(R"(event=worker_start_failed next_try_ms={} error="{}")",
                  backOff_.delay().count(), base::printable(error.message, 1000));
    if (main_ || backOff_.failures() < kFailuresToGiveUp) return;
    const Error lost =
        fail(ErrorCode::kDeviceLost, "the lost GL worker cannot be replaced: " + error.message);
    for (const MeasureRequest& request : measures_.takeAll()) tell(request, lost);
    for (const auto& [view, request] : std::exchange(picks_, {})) tell(request, lost);
    for (const RenderRequest& request : views_.takeAll()) {
        if (!events_.failed) break;
        events_.failed(request.view, request.tag, lost);
    }
}

}  // namespace volcast::workers
