#include "server/workers/supervisor.h"

#include <algorithm>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>
#include <utility>

#include <spdlog/spdlog.h>

#include "renderer/base/printable.h"
#include "renderer/worker/exit_codes.h"
#include "renderer/worker/frame_message.h"
#include "renderer/worker/measure_message.h"
#include "renderer/worker/pick_message.h"

namespace volcast::workers {

namespace {

using std::chrono::milliseconds;
using Clock = Supervisor::Clock;

constexpr milliseconds kFirstSpareDelay{1'000};
/// A process whose channel is closed is about to end; it has this long to say how.
constexpr milliseconds kEndGrace{200};
constexpr milliseconds kLongestWait{60'000};

double msBetween(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double, std::milli>(to - from).count();
}

std::string describe(const ExitStatus& status) {
    const char* known = status.signalled ? "" : worker::describe(status.value);
    return *known != '\0' ? known : status.text();
}

WorkDone workFrom(const internal::v1::Counters& message) {
    return {.bufferUploads = message.buffer_uploads(),
            .textureUploads = message.texture_uploads(),
            .uploadedBytes = message.uploaded_bytes(),
            .programsBuilt = message.programs_built(),
            .drawCalls = message.draw_calls(),
            .framesDrawn = message.frames_drawn()};
}

}  // namespace

Result<void> Supervisor::begin() {
    generation_ = 1;
    // A worker that dies on a GPU and does not say why may live on its next try; else the software
    // device follows. What one says of itself is the answer.
    for (std::size_t tries = 0; tries <= GpuTrust::kMostLosses && !main_; ++tries) {
        if (tries > 0 && startError_ && startError_->code != ErrorCode::kIo) break;
        if (tries > 0 && !onGpu() && gpuGivenUp_.empty()) break;
        start(main_);
        while (main_ && !main_->ready()) {
            wait();
            serve(main_);
            checkTimes();
            reapDying();
        }
    }
    if (main_) return {};
    return startError_.value_or(fail(ErrorCode::kIo, "the GL worker cannot be started"));
}

bool Supervisor::turn(const std::function<Inbox()>& take) {
    wait();
    serve(main_);
    serve(spare_);
    Inbox inbox = take();
    if (inbox.stop) return false;
    accept(inbox);
    checkTimes();
    startWorkers();
    dispatch();
    rehearse();
    reapDying();
    return true;
}

void Supervisor::wait() {
    std::vector<pollfd> entries{{.fd = wakeFd_, .events = POLLIN, .revents = 0}};
    for (const Worker* worker : {&main_, &spare_}) {
        if (!*worker) continue;
        const auto events =
            static_cast<short>((*worker)->wantsToSend() ? POLLIN | POLLOUT : POLLIN);
        entries.push_back({.fd = (*worker)->channelFd(), .events = events, .revents = 0});
        entries.push_back({.fd = (*worker)->pidfd(), .events = POLLIN, .revents = 0});
    }
    for (const ChildProcess& child : dying_) {
        entries.push_back({.fd = child.pidfd(), .events = POLLIN, .revents = 0});
    }
    const auto left = std::chrono::ceil<milliseconds>(nextTime() - Clock::now());
    const auto timeout = std::clamp(left, milliseconds{0}, kLongestWait);
    if (::poll(entries.data(), entries.size(), static_cast<int>(timeout.count())) <= 0) return;
    if ((entries.front().revents & POLLIN) != 0) {
        eventfd_t count = 0;
        ::eventfd_read(wakeFd_, &count);
    }
}

Clock::time_point Supervisor::nextTime() const {
    auto next = Clock::now() + kLongestWait;
    for (const Worker* worker : {&main_, &spare_}) {
        if (!*worker) continue;
        if (const auto deadline = (*worker)->deadline()) {
            next = std::min(next, *deadline);
        } else {
            next = std::min(next, (*worker)->lastHeard() + settings_.heartbeatInterval);
        }
    }
    if (!main_) next = std::min(next, startAllowed_);
    if (main_ && main_->ready() && !spare_ && settings_.warmSpare) {
        next = std::min(next, spareAllowed_);
    }
    return next;
}

void Supervisor::accept(Inbox& inbox) {
    for (const Inbox::DatasetChange& dataset : inbox.datasets) change(dataset);
    for (const std::uint64_t view : inbox.droppedViews) {
        views_.drop(view);
        gpuTrust_.forget(view);
        stopMeasure(view);
        picks_.erase(view);
        if (main_) main_->dropView(view);
        if (spare_) spare_->dropView(view);
    }
    for (auto& [view, timed] : inbox.requests) {
        submit(std::move(timed));
    }
    for (const worker::FaultSpec& fault : inbox.faults) {
        Worker& struck = struckBy(fault.fault) == worker::FaultyProcess::kSpare ? spare_ : main_;
        if (struck) struck->arm(fault);
    }
    for (const std::uint64_t view : inbox.stoppedMeasures) stopMeasure(view);
    for (auto& [view, request] : inbox.measures) measures_.submit(std::move(request));
    for (auto& [view, request] : inbox.picks) picks_[view] = std::move(request);
}

void Supervisor::submit(TimedRequest timed) {
    const RenderRequest& request = timed.request;
    if (!views_.holds(request)) return views_.submit(std::move(timed.request), timed.submitted);
    if (!events_.failed) return;
    events_.failed(request.view, request.tag,
                   fail(ErrorCode::kDeviceLost,
                        "this took down two GL workers before and is not drawn again", "scene"));
}

bool Supervisor::refusePaused(const RenderRequest& request) {
    const auto pause = settings_.pausesViews ? views_.pause(request, Clock::now())
                                             : std::optional<ViewQueue::Pause>{};
    if (!pause) return false;
    if (events_.failed) {
        events_.failed(request.view, request.tag,
                       fail(ErrorCode::kDeviceLost,
                            std::to_string(pause->scenes) +
                                " scenes of this view took down GL workers; it keeps to the last "
                                "one that was drawn for another " +
                                std::to_string(pause->left.count()) + " s",
                            "scene"));
    }
    return true;
}

void Supervisor::change(const Inbox::DatasetChange& change) {
    views_.forgive();
    if (change.packed) {
        datasets_[change.id] = change.packed;
    } else {
        datasets_.erase(change.id);
    }
    for (Worker* worker : {&main_, &spare_}) {
        if (!*worker) continue;
        if (change.packed) {
            (*worker)->addDataset(change.id, change.packed, settings_.datasetDeadline);
        } else {
            (*worker)->removeDataset(change.id);
        }
    }
}

void Supervisor::serve(Worker& worker) {
    while (worker) {
        auto answer = worker->flush() ? worker->receive()
                                      : fail(ErrorCode::kDeviceLost, "the channel is closed");
        if (answer && answer->has_value()) {
            handle(worker, **answer);
            continue;
        }
        if (answer) {
            if (const auto ended = worker->tryReap()) lose(worker, describe(*ended));
            return;
        }
        if (answer.error().code != ErrorCode::kDeviceLost) {
            return lose(worker, answer.error().message);
        }
        pollfd entry{.fd = worker->pidfd(), .events = POLLIN, .revents = 0};
        ::poll(&entry, 1, static_cast<int>(kEndGrace.count()));
        const auto ended = worker->tryReap();
        return lose(worker, ended ? describe(*ended) : "closed its channel");
    }
}

void Supervisor::handle(Worker& worker, const WorkerProcess::Answer& answer) {
    if (answer.has_ready()) return becomeReady(worker);
    if (answer.has_failed() && !worker->ready()) {
        startError_ = worker::errorFrom(answer.failed());
        return lose(worker, startError_->message);
    }
    if (answer.has_failed() && rehearsal_.ended(answer.failed().request())) return;
    if (answer.has_rendered() && rehearsal_.ended(answer.rendered().request())) return;
    if (answer.has_failed()) return refuse(answer.failed());
    if (answer.has_rendered()) return finish(answer.rendered());
    if (answer.has_rendering()) return drawnInPart(answer.rendering().request());
    if (answer.has_measuring()) return continueMeasure(answer.measuring().request());
    if (answer.has_measured()) {
        return finishMeasure(answer.measured().request(),
                             worker::measurementFrom(answer.measured()));
    }
    if (answer.has_picked()) {
        return finishPick(answer.picked().request(), worker::pickedFrom(answer.picked().place()));
    }
    // One step at a time, so that a spare that is needed now draws soon.
    if (answer.has_warmed_up() && answer.warmed_up().more() && &worker == &spare_) {
        worker->warmUp(answer.warmed_up().step() + 1, settings_.startDeadline);
    }
}

void Supervisor::becomeReady(Worker& worker) {
    spareAllowed_ = Clock::now() + (everReady_ ? kSpareDelay : kFirstSpareDelay);
    everReady_ = true;
    startError_.reset();
    backOff_.succeeded();
    software_ = worker->about().software();
    spdlog::info(R"(event=worker_ready worker={} role={} start_ms={:.0f} gl_renderer="{}")",
                 worker->pid(), &worker == &main_ ? "drawing" : "spare", worker->about().start_ms(),
                 base::printable(worker->about().gl_renderer()));
    if (&worker == &spare_) worker->warmUp(0, settings_.startDeadline);
}

void Supervisor::finish(const internal::v1::Rendered& rendered) {
    if (!inFlight_ || rendered.request() != inFlight_->number) {
        return lose(main_, "drew a picture nobody asked for");
    }
    // Before it counts as drawn: a worker that is lost over it is lost by this view.
    if (const auto valid = main_->checkPicture(rendered, inFlight_->request); !valid) {
        return lose(main_, valid.error().message);
    }
    const InFlight done = *std::exchange(inFlight_, std::nullopt);
    const bool wanted = views_.knows(done.request.view);
    gpuTrust_.drew(done.request.view);
    judgeGpu(lastLoss_);
    views_.succeeded(done.request);
    dispatch();  // Into the other slot, while this one is copied.
    if (!wanted) return;

    const auto before = Clock::now();
    auto picture = main_->copyPicture(rendered, done.request);
    if (!picture) {
        if (events_.failed) events_.failed(done.request.view, done.request.tag, picture.error());
        return;
    }
    RenderedFrame frame;
    frame.view = done.request.view;
    frame.tag = done.request.tag;
    frame.picture = *std::move(picture);
    frame.plan = worker::planFrom(rendered);
    frame.waitMs = done.waitMs;
    frame.uploadMs = rendered.upload_ms();
    frame.drawMs = rendered.draw_ms();
    frame.readbackMs = rendered.readback_ms();
    frame.copyMs = msBetween(before, Clock::now());
    frame.cpuMs = rendered.cpu_ms();
    frame.workerPeakMb = rendered.peak_mb();
    frame.drawn = rendered.drawn();
    frame.ready = rendered.ready();
    frame.work = workFrom(rendered.work());
    frame.generation = generation_;
    if (events_.rendered) events_.rendered(std::move(frame));
}

void Supervisor::drawnInPart(std::uint64_t number) {
    if (!inFlight_ || number != inFlight_->number || !inFlight_->request.patient) {
        return lose(main_, "drew a part of a picture nobody asked for");
    }
    InFlight part = *std::exchange(inFlight_, std::nullopt);
    views_.drawnInPart(
        {.request = std::move(part.request), .submitted = part.submitted, .waitedMs = part.waitMs});
}

void Supervisor::refuse(const internal::v1::Failed& failed) {
    Error error = worker::errorFrom(failed);
    if (failed.request() == 0) {
        spdlog::error(R"(event=dataset_refused dataset="{}" error="{}")",
                      base::printable(failed.dataset()), base::printable(error.message, 1000));
        return;
    }
    if (measures_.inHand()) return finishMeasure(failed.request(), error);
    if (pickInHand_) return finishPick(failed.request(), error);
    if (!inFlight_ || failed.request() != inFlight_->number) {
        return lose(main_, "refused a picture nobody asked for");
    }
    const InFlight done = *std::exchange(inFlight_, std::nullopt);
    views_.refused(done.request.view);
    if (events_.failed) events_.failed(done.request.view, done.request.tag, std::move(error));
}

void Supervisor::dispatch() {
    while (main_ && main_->ready() && !inFlight_ && !measures_.inHand() && !pickInHand_) {
        if (!std::exchange(justPicked_, false) && dispatchPick()) return;
        auto next = views_.next();
        if (!next && dispatchPick()) return;
        if (!next) return dispatchMeasure();
        const RenderRequest& request = next->request;
        if (refusePaused(request)) continue;
        auto asked = main_->render(nextNumber_, request, settings_.frameDeadline);
        if (!asked) {
            views_.refused(request.view);
            if (events_.failed) events_.failed(request.view, request.tag, asked.error());
            continue;
        }
        const double waitMs =
            next->waitedMs >= 0.0 ? next->waitedMs : msBetween(next->submitted, Clock::now());
        inFlight_ = {.request = std::move(next->request),
                     .number = nextNumber_,
                     .waitMs = waitMs,
                     .submitted = next->submitted};
        ++nextNumber_;
        static_cast<void>(main_->flush());  // serve() notices a closed channel.
    }
}

void Supervisor::checkTimes() {
    const auto now = Clock::now();
    for (Worker* worker : {&spare_, &main_}) {
        if (!*worker) continue;
        const auto deadline = (*worker)->deadline();
        if (deadline && *deadline <= now) {
            lose(*worker, (*worker)->deadlineMissed());
        } else if (!deadline && (*worker)->lastHeard() + settings_.heartbeatInterval <= now) {
            (*worker)->ping(settings_.heartbeatDeadline);
            static_cast<void>((*worker)->flush());
        }
    }
}

void Supervisor::startWorkers() {
    const auto now = Clock::now();
    if (!main_ && startAllowed_ <= now) start(main_);
    const bool spareWanted = settings_.warmSpare && main_ && main_->ready() && !spare_;
    if (spareWanted && spareAllowed_ <= now) start(spare_);
}

void Supervisor::start(Worker& worker) {
    auto started = WorkerProcess::start(settings_, cacheFolder_);
    if (!started) return startFailed(started.error());
    startError_.reset();
    worker = *std::move(started);
    ++starts_;
    for (const auto& [id, packed] : datasets_) {
        worker->addDataset(id, packed, settings_.datasetDeadline);
    }
    static_cast<void>(worker->flush());
}

void Supervisor::reapDying() {
    std::erase_if(dying_, [](ChildProcess& child) { return child.tryReap().has_value(); });
}

RenderStatus Supervisor::status() const {
    RenderStatus status;
    status.ready = main_ && main_->ready();
    status.generation = generation_;
    status.losses = losses_;
    status.starts = starts_;
    status.spareReady = spareReady();
    status.workerPid = main_ ? main_->pid() : 0;
    status.sparePid = spare_ ? spare_->pid() : 0;
    if (status.ready) {
        status.glRenderer = main_->about().gl_renderer();
        status.glVersion = main_->about().gl_version();
    }
    status.viewsWaiting = views_.waiting();
    status.lastLoss = lastLoss_;
    status.gpuGivenUp = gpuGivenUp_;
    return status;
}

}  // namespace volcast::workers
