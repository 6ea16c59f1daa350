#include "server/workers/render_service.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <future>
#include <mutex>
#include <sys/eventfd.h>
#include <system_error>
#include <thread>
#include <utility>

#include "renderer/scene/validate.h"
#include "server/workers/supervisor.h"

namespace volcast::workers {

namespace {

namespace fs = std::filesystem;

/// The mailbox in front of a supervisor that runs on a thread of its own.
class SupervisedService final : public RenderService {
public:
    SupervisedService(RenderSettings settings, RenderEvents events, PrivateFolder folder,
                      base::FileDescriptor wake)
        : folder_{std::move(folder)},
          wake_{std::move(wake)},
          events_{std::move(events)},
          settings_{std::move(settings)} {}
    SupervisedService(const SupervisedService&) = delete;
    SupervisedService& operator=(const SupervisedService&) = delete;
    SupervisedService(SupervisedService&&) = delete;
    SupervisedService& operator=(SupervisedService&&) = delete;

    ~SupervisedService() override {
        {
            const std::scoped_lock lock{mutex_};
            inbox_.stop = true;
        }
        wake();
        if (thread_.joinable()) thread_.join();
    }

    /// Errors: as RenderService::create.
    Result<void> begin() {
        std::promise<Result<void>> begun;
        auto outcome = begun.get_future();
        // The thread owns the promise, which must outlive its last touch.
        thread_ = std::thread{[this, begun = std::move(begun)]() mutable { run(begun); }};
        return outcome.get();
    }

    void addDataset(const std::string& id, base::FileDescriptor packed) override {
        changeDataset(
            {.id = id, .packed = std::make_shared<const base::FileDescriptor>(std::move(packed))});
    }

    void removeDataset(const std::string& id) override {
        changeDataset({.id = id, .packed = nullptr});
    }

    void submit(RenderRequest request) override {
        if (auto valid = scene::validate(request.size); !valid) {
            events_.failed(request.view, request.tag, std::move(valid).error());
            return;
        }
        {
            const std::scoped_lock lock{mutex_};
            const std::uint64_t view = request.view;
            inbox_.requests[view] = {.request = std::move(request),
                                     .submitted = std::chrono::steady_clock::now()};
        }
        wake();
    }

    void measure(MeasureRequest request) override {
        {
            const std::scoped_lock lock{mutex_};
            const std::uint64_t view = request.view;
            inbox_.measures[view] = std::move(request);
        }
        wake();
    }

    void stopMeasuring(std::uint64_t view) override {
        {
            const std::scoped_lock lock{mutex_};
            inbox_.measures.erase(view);
            inbox_.stoppedMeasures.push_back(view);
        }
        wake();
    }

    void pick(PickRequest request) override {
        {
            const std::scoped_lock lock{mutex_};
            const std::uint64_t view = request.view;
            inbox_.picks[view] = std::move(request);
        }
        wake();
    }

    void injectFault(std::uint64_t /*view*/, const worker::FaultSpec& fault) override {
        {
            const std::scoped_lock lock{mutex_};
            inbox_.faults.push_back(fault);
        }
        wake();
    }

    void dropView(std::uint64_t view) override {
        {
            const std::scoped_lock lock{mutex_};
            inbox_.picks.erase(view);
            inbox_.requests.erase(view);
            inbox_.measures.erase(view);
            inbox_.droppedViews.push_back(view);
        }
        wake();
    }

    [[nodiscard]] RenderStatus status() const override {
        const std::scoped_lock lock{mutex_};
        return status_;
    }

private:
    void changeDataset(Inbox::DatasetChange change) {
        {
            const std::scoped_lock lock{mutex_};
            inbox_.datasets.push_back(std::move(change));
        }
        wake();
    }

    void wake() const { ::eventfd_write(wake_.get(), 1); }

    /// The supervisor lives on this thread alone: its workers die with the thread that made them.
    void run(std::promise<Result<void>>& begun) {
        const Supervisor* teller = nullptr;
        Supervisor supervisor{settings_, eventsAfterStatusOf(teller), folder(), wake_.get()};
        teller = &supervisor;
        const Result<void> ready = supervisor.begin();
        publish(supervisor);
        begun.set_value(ready);
        if (!ready) return;
        const auto take = [this] {
            const std::scoped_lock lock{mutex_};
            return std::exchange(inbox_, {});
        };
        while (supervisor.turn(take)) publish(supervisor);
    }

    /// The events, of which those that speak of a loss come when status() knows of it already.
    RenderEvents eventsAfterStatusOf(const Supervisor*& teller) {
        RenderEvents events = events_;
        if (events.failed) {
            events.failed = [this, &teller](std::uint64_t view, std::uint64_t tag, Error error) {
                publish(*teller);
                events_.failed(view, tag, std::move(error));
            };
        }
        if (events.recovering) {
            events.recovering = [this, &teller](std::vector<std::uint64_t> views) {
                publish(*teller);
                events_.recovering(std::move(views));
            };
        }
        return events;
    }

    void publish(const Supervisor& supervisor) {
        RenderStatus now = supervisor.status();
        const std::scoped_lock lock{mutex_};
        status_ = std::move(now);
    }

    [[nodiscard]] std::string folder() const {
        return settings_.cacheFolder.empty() ? folder_.path().string() : settings_.cacheFolder;
    }

    PrivateFolder folder_;  ///< Empty where the settings name one.
    base::FileDescriptor wake_;
    RenderEvents events_;
    RenderSettings settings_;
    mutable std::mutex mutex_;
    Inbox inbox_;
    RenderStatus status_;
    std::thread thread_;
};

/// The driver's cache: the folder the settings name (made if need be), else a private one.
Result<PrivateFolder> prepareCache(const RenderSettings& settings) {
    if (settings.cacheFolder.empty()) return PrivateFolder::create();
    std::error_code error;
    fs::create_directories(settings.cacheFolder, error);
    if (error) {
        return fail(ErrorCode::kIo, settings.cacheFolder + ": cannot be made: " + error.message());
    }
    return PrivateFolder{};
}

}  // namespace

Result<std::unique_ptr<RenderService>> RenderService::create(RenderSettings settings,
                                                             RenderEvents events) {
    auto folder = prepareCache(settings);
    if (!folder) return std::move(folder).error();
    base::FileDescriptor wake{::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)};
    if (!wake.valid()) {
        return fail(ErrorCode::kIo, std::string{"eventfd: "} + std::strerror(errno));
    }
    auto service = std::make_unique<SupervisedService>(std::move(settings), std::move(events),
                                                       *std::move(folder), std::move(wake));
    if (auto begun = service->begin(); !begun) return std::move(begun).error();
    return std::unique_ptr<RenderService>{std::move(service)};
}

}  // namespace volcast::workers
