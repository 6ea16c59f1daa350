#pragma once

#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "server/workers/back_off.h"
#include "server/workers/gpu_trust.h"
#include "server/workers/measure_queue.h"
#include "server/workers/private_folder.h"
#include "server/workers/rehearsal.h"
#include "server/workers/view_queue.h"
#include "server/workers/worker_process.h"

namespace volcast::workers {

/// What other threads ask of the supervisor, merged so that it stays small: a newer request of a
/// view replaces an older one.
struct Inbox {
    struct DatasetChange {
        std::string id;
        SharedDescriptor packed;  ///< Empty: the dataset is removed.
    };
    std::vector<DatasetChange> datasets;
    std::vector<std::uint64_t> droppedViews;
    std::vector<std::uint64_t> stoppedMeasures;        ///< By view, before those below.
    std::vector<worker::FaultSpec> faults;             ///< Before the requests below.
    std::map<std::uint64_t, TimedRequest> requests;    ///< Newest of each view.
    std::map<std::uint64_t, MeasureRequest> measures;  ///< Newest of each view.
    std::map<std::uint64_t, PickRequest> picks;        ///< Newest of each view.
    bool stop = false;
};

/// Keeps one worker drawing and one spare waiting. Single-threaded: everything happens in run().
class Supervisor {
public:
    using Clock = std::chrono::steady_clock;

    Supervisor(RenderSettings settings, RenderEvents events, std::string cacheFolder, int wakeFd)
        : settings_{std::move(settings)},
          events_{std::move(events)},
          cacheFolder_{std::move(cacheFolder)},
          wakeFd_{wakeFd},
          measures_{settings_.frameDeadline, settings_.measureDeadline} {}

    /// Starts the first worker and waits until it is ready or has failed.
    ///
    /// Errors: as RenderService::create.
    Result<void> begin();

    /// One turn: waits until something happens, and handles it. `take` empties the inbox; false
    /// once it says stop.
    bool turn(const std::function<Inbox()>& take);

    [[nodiscard]] RenderStatus status() const;

private:
    /// A spare starts a little later, so as not to take the processor from the first pictures.
    static constexpr std::chrono::milliseconds kSpareDelay{300};

    using Worker = std::optional<WorkerProcess>;
    struct InFlight {
        RenderRequest request;
        std::uint64_t number = 0;
        double waitMs = 0.0;
        Clock::time_point submitted{};
    };

    struct PickInHand {
        PickRequest request;
        std::uint64_t number = 0;
    };

    void wait();
    void accept(Inbox& inbox);  ///< Empties it.
    void change(const Inbox::DatasetChange& change);
    void serve(Worker& worker);
    void handle(Worker& worker, const WorkerProcess::Answer& answer);
    void finish(const internal::v1::Rendered& rendered);
    void drawnInPart(std::uint64_t number);
    void refuse(const internal::v1::Failed& failed);
    void dispatch();
    void dispatchMeasure();
    void continueMeasure(std::uint64_t number);
    void finishMeasure(std::uint64_t number, const Result<accuracy::Measurement>& result);
    void stopMeasure(std::uint64_t view);
    void tell(const MeasureRequest& request, const Result<accuracy::Measurement>& result) const;
    bool dispatchPick();  ///< False: none waits.
    void finishPick(std::uint64_t number, const Result<std::optional<scene::Picked>>& result);
    void tell(const PickRequest& request, const Result<std::optional<scene::Picked>>& result) const;
    /// Lets the spare draw what the main worker drew last, where it would draw that in a new way.
    void rehearse();
    [[nodiscard]] bool spareReady() const;
    /// What is left to rehearse for the spare that is there; null: nothing.
    [[nodiscard]] const RenderRequest* toRehearse() const;
    [[nodiscard]] bool spareIdle() const;
    void checkTimes();
    void startWorkers();
    void start(Worker& worker);
    void becomeReady(Worker& worker);
    void reapDying();
    /// Where the GPU has lost too many workers, the next ones get the software device.
    void judgeGpu(const std::string& reason);
    void submit(TimedRequest timed);
    /// Refuses a request whose view has to keep to another scene; false: it may be drawn.
    bool refusePaused(const RenderRequest& request);
    /// The device of new workers may be a GPU.
    [[nodiscard]] bool onGpu() const;

    /// The worker is gone or has to go: its end, its successor, and what to draw again.
    void lose(Worker& worker, const std::string& reason);
    void retire(Worker& worker);
    void loseMain();
    void startFailed(const Error& error);
    [[nodiscard]] Clock::time_point nextTime() const;

    RenderSettings settings_;
    RenderEvents events_;
    std::string cacheFolder_;
    int wakeFd_;

    Worker main_;
    Worker spare_;
    std::vector<ChildProcess> dying_;
    std::map<std::string, SharedDescriptor> datasets_;
    ViewQueue views_;
    Rehearsal rehearsal_;
    std::optional<InFlight> inFlight_;
    MeasureQueue measures_;                       ///< Nothing is in hand beside inFlight_.
    std::uint64_t measureNumber_ = 0;             ///< Of the part in hand.
    std::map<std::uint64_t, PickRequest> picks_;  ///< That wait, by view.
    std::optional<PickInHand> pickInHand_;        ///< Nothing else is in hand then.
    bool justPicked_ = false;                     ///< A picture comes before the next pick.
    std::uint64_t nextNumber_ = 1;

    GpuTrust gpuTrust_;
    std::string gpuGivenUp_;        ///< Why; empty: it is not.
    std::optional<bool> software_;  ///< Of the newest worker that was ready.
    BackOff backOff_;
    Clock::time_point startAllowed_ = Clock::now();
    Clock::time_point spareAllowed_ = Clock::now();
    std::optional<Error> startError_;  ///< Why the last worker could not start.
    bool everReady_ = false;
    std::uint32_t generation_ = 0;
    std::uint32_t losses_ = 0;
    std::uint32_t starts_ = 0;
    std::string lastLoss_;
};

}  // namespace volcast::workers
