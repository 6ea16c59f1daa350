#include "server/load/fleet.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "server/load/scripted_client.h"

namespace volcast::load {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kProgressEach{250};
constexpr std::chrono::milliseconds kSampleEach{1000};
constexpr std::chrono::milliseconds kSettledEach{20};
constexpr std::chrono::seconds kSettledWithin{60};

Clock::duration seconds(double s) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>{s});
}

class Fleet {
public:
    Fleet(const LoadSettings& settings, const OnProgress& progress)
        : settings_{settings},
          progress_{progress},
          stage_{.settings = settings, .loop = *loop_, .giveUp = [this](const std::string& why) {
                     failure_ = why;
                     loop_->stop();
                 }} {}

    Result<Outcome> run();

private:
    void cast();
    void schedule();
    void awaitSettled();
    void beginMeasuring();
    void sample();
    void showProgress();
    void gather();

    const LoadSettings& settings_;
    const OnProgress& progress_;
    std::unique_ptr<net::ClientLoop> loop_ = net::ClientLoop::create();
    Stage stage_;
    std::vector<std::unique_ptr<SharedView>> views_;
    std::vector<std::unique_ptr<ScriptedClient>> clients_;
    std::vector<Stats*> statsOf_;
    std::vector<Kind> kinds_;  ///< Of clients_; the first so many as there are views steer.
    Clock::time_point begun_ = Clock::now();
    Clock::time_point measuredFrom_{};
    std::optional<std::string> failure_;
    Outcome outcome_;
};

/// Clients in the order of their groups, those that move first; the first of each view opens it.
void Fleet::cast() {
    for (const Group& group : settings_.groups) {
        kinds_.insert(kinds_.end(), group.clients, group.kind);
    }
    std::stable_partition(kinds_.begin(), kinds_.end(), moves);
    const std::size_t wanted = settings_.views == 0 ? kinds_.size() : settings_.views;
    const std::size_t views = std::min(wanted, kinds_.size());
    for (std::size_t i = 0; i < views; ++i) views_.push_back(std::make_unique<SharedView>());
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
        const bool opens = i < views;
        SharedView& view = *views_[i % views];
        if (!opens) ++view.members;
        Stats& stats = outcome_.kinds[name(kinds_[i]) + std::string{opens ? "" : ", watching"}];
        ++stats.clients;
        clients_.push_back(std::make_unique<ScriptedClient>(stage_, kinds_[i], view, opens, stats));
        statsOf_.push_back(&stats);
    }
    outcome_.views = static_cast<unsigned>(views);
}

void Fleet::schedule() {
    for (std::size_t i = 0; i < clients_.size(); ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(clients_.size());
        loop_->at(begun_ + seconds(share * settings_.rampUpS), [this, i] { clients_[i]->start(); });
    }
    loop_->at(begun_ + seconds(settings_.rampUpS), [this] { awaitSettled(); });
    showProgress();
}

/// A first view may have to wait for an import: what is measured begins behind that.
void Fleet::awaitSettled() {
    const auto late = begun_ + seconds(settings_.rampUpS) + kSettledWithin;
    const bool settled =
        std::ranges::all_of(clients_, [](const auto& client) { return client->settled(); });
    if (settled || Clock::now() >= late) return beginMeasuring();
    loop_->at(Clock::now() + kSettledEach, [this] { awaitSettled(); });
}

void Fleet::beginMeasuring() {
    stage_.measuring = true;
    measuredFrom_ = Clock::now();
    loop_->at(measuredFrom_ + seconds(settings_.durationS), [this] {
        outcome_.interrupted = false;
        loop_->stop();
    });
    if (settings_.serverPid == 0) return;
    if (const auto use = treeUse(settings_.serverPid)) {
        outcome_.before = outcome_.after = *use;
        outcome_.serverMeasured = true;
        sample();
    }
}

void Fleet::sample() {
    const auto use = treeUse(settings_.serverPid);
    if (!use) return;
    TreeUse& most = outcome_.most;
    outcome_.after = *use;
    most.rootBytes = std::max(most.rootBytes, use->rootBytes);
    most.treeBytes = std::max(most.treeBytes, use->treeBytes);
    most.processes = std::max(most.processes, use->processes);
    most.rootThreads = std::max(most.rootThreads, use->rootThreads);
    most.rootDescriptors = std::max(most.rootDescriptors, use->rootDescriptors);
    most.treeThreads = std::max(most.treeThreads, use->treeThreads);
    most.treeDescriptors = std::max(most.treeDescriptors, use->treeDescriptors);
    loop_->at(Clock::now() + kSampleEach, [this] { sample(); });
}

void Fleet::showProgress() {
    std::uint64_t frames = 0, connects = 0, errors = 0;
    for (const auto& [kind, stats] : outcome_.kinds) {
        frames += stats.frames;
        connects += stats.connects;
        for (const auto& [what, count] : stats.errors) errors += count;
    }
    const std::chrono::duration<double> gone = Clock::now() - begun_;
    progress_(std::to_string(connects) + " connects, " + std::to_string(frames) + " frames, " +
                  std::to_string(errors) + " errors",
              gone.count() / (settings_.rampUpS + settings_.durationS));
    loop_->at(Clock::now() + kProgressEach, [this] { showProgress(); });
}

void Fleet::gather() {
    if (outcome_.serverMeasured) sample();
    const std::chrono::duration<double> measured = Clock::now() - measuredFrom_;
    outcome_.seconds = stage_.measuring ? measured.count() : 0;
    for (std::size_t i = 0; i < clients_.size(); ++i) {
        clients_[i]->countMissing();
        const std::uint64_t frames = clients_[i]->frames();
        statsOf_[i]->framesByClient.push_back(frames);
        if (!moves(kinds_[i % views_.size()])) continue;
        if (i < views_.size()) outcome_.steeredFrames.push_back(frames);
        if (kinds_[i] != Kind::kJoin) outcome_.movingFrames.push_back(frames);
    }
}

Result<Outcome> Fleet::run() {
    if (!settings_.trustFile.empty()) {
        if (const auto trusted = loop_->trust(settings_.trustFile); !trusted) {
            return trusted.error();
        }
    }
    cast();
    schedule();
    outcome_.interrupted = true;  // Until the end of the measured time says otherwise.
    loop_->run();
    if (failure_) return fail(ErrorCode::kUnsupported, *failure_);
    gather();
    const bool any = std::ranges::any_of(outcome_.kinds,
                                         [](const auto& one) { return one.second.connects > 0; });
    if (any) return std::move(outcome_);
    const auto& errors = outcome_.kinds.begin()->second.errors;
    return fail(ErrorCode::kIo,
                "no client could connect: " +
                    (errors.empty() ? "the run was too short" : errors.begin()->first));
}

}  // namespace

Result<Outcome> runFleet(const LoadSettings& settings, const OnProgress& progress) {
    Fleet fleet{settings, progress};
    return fleet.run();
}

}  // namespace volcast::load
