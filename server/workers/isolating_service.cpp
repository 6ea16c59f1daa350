#include "server/workers/isolating_service.h"

#include <deque>
#include <fcntl.h>
#include <future>
#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include <spdlog/spdlog.h>

#include "renderer/base/printable.h"
#include "renderer/scene/user_controls.h"
#include "server/workers/quarantine.h"

namespace volcast::workers {
namespace {

base::FileDescriptor copyOf(const base::FileDescriptor& descriptor) {
    return base::FileDescriptor{::fcntl(descriptor.get(), F_DUPFD_CLOEXEC, 0)};
}

// A request may fail a few newer ones later.
constexpr std::size_t kMostRemembered = 8;

/// The service of one view. It starts on a thread of its own, because that takes as long as a
/// worker does to start; until then the newest request waits here.
struct OwnService {
    std::unique_ptr<RenderService> service;  ///< Null while it starts.
    std::optional<RenderRequest> waiting;
    std::deque<std::pair<std::uint64_t, scene::Scene>> asked;  ///< Newest tags and their scenes.
    bool ended = false;  ///< While it starts: nobody wants it any more.
    std::string viewId = {};
};

/// What counts only up, and why the last worker went where `status` knows of none.
void addCounts(RenderStatus& status, const RenderStatus& more) {
    status.losses += more.losses;
    status.starts += more.starts;
    if (status.lastLoss.empty()) status.lastLoss = more.lastLoss;
}

class IsolatingService final : public RenderService {
public:
    IsolatingService(RenderSettings settings, RenderEvents events)
        : events_{std::move(events)}, settings_{std::move(settings)} {}
    IsolatingService(const IsolatingService&) = delete;
    IsolatingService& operator=(const IsolatingService&) = delete;
    IsolatingService(IsolatingService&&) = delete;
    IsolatingService& operator=(IsolatingService&&) = delete;

    ~IsolatingService() override {
        std::list<std::future<void>> tasks;
        {
            const std::scoped_lock lock{mutex_};
            for (const auto& [view, own] : own_) own->ended = true;
            tasks.swap(tasks_);
        }
        tasks.clear();  // Each waits for its end, without the lock that it may need.
    }

    Result<void> begin() {
        auto shared = RenderService::create(settings_, events_);
        if (!shared) return std::move(shared).error();
        shared_ = *std::move(shared);
        settings_.warmSpare = false;    // Of the views' own workers: one process a view,
        settings_.pausesViews = false;  // which costs no other view anything.
        return {};
    }

    void addDataset(const std::string& id, base::FileDescriptor packed) override {
        const std::scoped_lock lock{mutex_};
        shared_->addDataset(id, copyOf(packed));
        for (const auto& [view, own] : own_) {
            if (own->service) own->service->addDataset(id, copyOf(packed));
        }
        datasets_[id] = std::move(packed);
    }

    void removeDataset(const std::string& id) override {
        const std::scoped_lock lock{mutex_};
        shared_->removeDataset(id);
        for (const auto& [view, own] : own_) {
            if (own->service) own->service->removeDataset(id);
        }
        datasets_.erase(id);
    }

    void submit(RenderRequest request) override {
        if (!runsCode(request.scene)) {
            end(request.view);
            return shared_->submit(std::move(request));
        }
        if (const auto refusal = submitOwn(request)) {
            events_.failed(request.view, request.tag, *refusal);
        }
    }

    /// Layers that run code cannot be measured; the others are, without them.
    void measure(MeasureRequest request) override {
        for (scene::Layer& layer : request.job.scene.layers) {
            if (scene::runsUserCode(layer)) layer.visible = false;
        }
        shared_->measure(std::move(request));
    }

    void stopMeasuring(std::uint64_t view) override { shared_->stopMeasuring(view); }

    /// Needs no GL and runs no code.
    void pick(PickRequest request) override { shared_->pick(std::move(request)); }

    void dropView(std::uint64_t view) override {
        shared_->dropView(view);
        end(view);
    }

    void injectFault(std::uint64_t view, const worker::FaultSpec& fault) override {
        const std::scoped_lock lock{mutex_};
        const auto own = own_.find(view);
        const bool isOwn = own != own_.end() && own->second->service;
        (isOwn ? own->second->service : shared_)->injectFault(view, fault);
    }

    /// Of the worker that most views share; the counts are those of all, of workers that have ended
    /// as well.
    [[nodiscard]] RenderStatus status() const override {
        RenderStatus status = shared_->status();
        const std::scoped_lock lock{mutex_};
        for (const auto& [view, own] : own_) {
            if (own->waiting) ++status.viewsWaiting;
            if (!own->service) continue;
            const RenderStatus of = own->service->status();
            addCounts(status, of);
            status.viewsWaiting += of.viewsWaiting;
            if (status.gpuGivenUp.empty()) status.gpuGivenUp = of.gpuGivenUp;
        }
        addCounts(status, ended_);
        return status;
    }

private:
    /// Why the request is refused; nothing where it was taken.
    std::optional<Error> submitOwn(RenderRequest& request) {
        const std::scoped_lock lock{mutex_};
        if (const auto layer = quarantine_.find(request.scene)) {
            return quarantined(request.scene, *layer, {});
        }
        const std::uint64_t view = request.view;
        std::shared_ptr<OwnService>& own = own_[view];
        if (own == nullptr && own_.size() > kMaxOwnWorkers) {
            own_.erase(view);
            return fail(ErrorCode::kLimitExceeded,
                        "shader code runs in " + std::to_string(kMaxOwnWorkers) +
                            " views already, the most at a time",
                        "scene");
        }
        const bool fresh = own == nullptr;
        if (fresh) own = std::make_shared<OwnService>();
        own->viewId = request.viewId;
        own->asked.emplace_back(request.tag, request.scene);
        if (own->asked.size() > kMostRemembered) own->asked.pop_front();
        if (own->service) {
            own->service->submit(std::move(request));
        } else {
            own->waiting = std::move(request);
        }
        if (!fresh) return std::nullopt;
        shared_->dropView(view);
        run([this, view, started = own] { start(view, started); });
        return std::nullopt;
    }

    void start(std::uint64_t view, const std::shared_ptr<OwnService>& own) {
        auto made = RenderService::create(settings_, eventsOf(view));
        std::unique_ptr<RenderService> unwanted;  // Ends without the lock.
        std::optional<RenderRequest> waiting;
        std::optional<Error> failure;
        {
            const std::scoped_lock lock{mutex_};
            waiting = std::exchange(own->waiting, std::nullopt);
            if (!made) {
                failure = made.error();
                if (!own->ended) own_.erase(view);
            } else if (own->ended) {
                unwanted = *std::move(made);
                addCounts(ended_, unwanted->status());
            } else {
                own->service = *std::move(made);
                for (const auto& [id, packed] : datasets_) {
                    own->service->addDataset(id, copyOf(packed));
                }
                if (waiting) own->service->submit(*std::move(waiting));
                return;
            }
        }
        if (failure && waiting) events_.failed(view, waiting->tag, *failure);
    }

    /// Those of the view's own service. What took it down twice goes into quarantine.
    RenderEvents eventsOf(std::uint64_t view) {
        RenderEvents events = events_;
        events.failed = [this, view](std::uint64_t of, std::uint64_t tag, Error error) {
            if (error.code == ErrorCode::kDeviceLost) {
                const std::scoped_lock lock{mutex_};
                error = quarantine(view, tag, std::move(error));
                spdlog::warn(R"(event=view_failed view={} error="{}")", nameOf(view),
                             base::printable(error.message, 1000));
            }
            events_.failed(of, tag, std::move(error));
        };
        return events;
    }

    /// As the log calls it. Needs the lock.
    [[nodiscard]] std::string nameOf(std::uint64_t view) const {
        const auto own = own_.find(view);
        const bool named = own != own_.end() && !own->second->viewId.empty();
        return named ? own->second->viewId : std::to_string(view);
    }

    /// Takes the code of a request over which two workers were lost out of use; the error that
    /// names it. Needs the lock.
    Error quarantine(std::uint64_t view, std::uint64_t tag, Error error) {
        const auto own = own_.find(view);
        if (own == own_.end()) return error;
        for (const auto& [asked, scene] : own->second->asked) {
            if (asked != tag) continue;
            quarantine_.add(scene);
            if (const auto layer = quarantine_.find(scene)) {
                error = quarantined(scene, *layer, error.message);
            }
        }
        return error;
    }

    /// Ends the view's own service, if it has one, without waiting for that.
    void end(std::uint64_t view) {
        const std::scoped_lock lock{mutex_};
        const auto found = own_.find(view);
        if (found == own_.end()) return;
        const std::shared_ptr<OwnService> own = found->second;
        own_.erase(found);
        own->ended = true;
        if (!own->service) return;
        addCounts(ended_, own->service->status());
        run([own] { own->service.reset(); });
    }

    /// On a thread of its own; needs the lock.
    void run(std::function<void()> task) {
        tasks_.remove_if([](const std::future<void>& one) {
            return one.wait_for(std::chrono::seconds{0}) == std::future_status::ready;
        });
        tasks_.push_back(std::async(std::launch::async, std::move(task)));
    }

    RenderEvents events_;
    RenderSettings settings_;
    mutable std::mutex mutex_;  ///< Of all below but `shared_`; services call back without it.
    std::unique_ptr<RenderService> shared_;
    std::map<std::string, base::FileDescriptor> datasets_;
    std::map<std::uint64_t, std::shared_ptr<OwnService>> own_;
    RenderStatus ended_;  ///< The counts of services that are gone.
    Quarantine quarantine_;
    std::list<std::future<void>> tasks_;
};

}  // namespace

Result<std::unique_ptr<RenderService>> createIsolatingService(const RenderSettings& settings,
                                                              RenderEvents events) {
    auto service = std::make_unique<IsolatingService>(settings, std::move(events));
    if (auto begun = service->begin(); !begun) return std::move(begun).error();
    return std::unique_ptr<RenderService>{std::move(service)};
}

}  // namespace volcast::workers
