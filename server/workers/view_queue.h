#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "server/workers/render_service.h"
#include "server/workers/scene_trust.h"

namespace volcast::workers {

/// A request and when it came.
struct TimedRequest {
    RenderRequest request;
    std::chrono::steady_clock::time_point submitted;
    double waitedMs = -1.0;  ///< Until its first part was drawn; negative: none was.
};

/// Who is drawn next: a one-slot mailbox for each view, views take turns. Remembers what to draw
/// again after a worker was lost, and which view seems to cost workers.
///
/// Not thread-safe; the supervisor's thread owns it.
class ViewQueue {
public:
    using Clock = std::chrono::steady_clock;

    /// True for what has taken two workers down: it is not to be submitted. Neither a moved camera
    /// nor what pacing changes (size, hurry) makes a scene another one, unless the view has drawn
    /// it with others.
    [[nodiscard]] bool holds(const RenderRequest& request) const;
    /// What a view may not be drawn with for a while.
    struct Pause {
        std::chrono::seconds left;
        int scenes = 0;  ///< Of the view, that took down workers.
    };
    /// Whether `request` has to wait because scenes of its view took down workers again and again.
    /// The last good one has not: from elsewhere, too, unless one was drawn well before and took
    /// them down from elsewhere.
    [[nodiscard]] std::optional<Pause> pause(const RenderRequest& request,
                                             Clock::time_point now) const;
    /// Data has changed: what was held may be another picture now.
    void forgive();

    /// Replaces the view's request that has not been taken yet.
    void submit(RenderRequest request, Clock::time_point now);
    /// Forgets the view.
    void drop(std::uint64_t view);
    [[nodiscard]] bool knows(std::uint64_t view) const { return views_.contains(view); }

    /// Views with a request that has not been taken.
    [[nodiscard]] std::size_t waiting() const noexcept { return turns_.size(); }
    /// Takes the request whose turn it is, one in the background where there is no other. It is in
    /// flight until one of the calls below.
    std::optional<TimedRequest> next();
    /// `drawn` is now the view's last good request.
    void succeeded(RenderRequest drawn);
    /// The newest good request of all views, those in the background aside; null: none.
    [[nodiscard]] const RenderRequest* lastDrawn() const;
    /// A part of what was in flight is drawn: it waits for its next turn, unless the view has a
    /// newer request or was dropped.
    void drawnInPart(TimedRequest request);
    /// The worker refused the request, and lived.
    void refused(std::uint64_t view);

    /// What to tell after a loss.
    struct Loss {
        std::vector<std::uint64_t> views;  ///< All known views; they will be drawn again.
        std::vector<RenderRequest>
            givenUp;         ///< One that lost two workers, and the same if it waited.
        bool proven = true;  ///< Nothing was in flight but what had been drawn before.
    };
    /// A worker was lost, with `inFlight` in its hands if it had one. The last request of every
    /// view waits again afterwards; the view in flight comes last.
    ///
    /// A request that has lost two workers in a row is given up and held. Its view may try others,
    /// but until one succeeds each further loss gives it up at once.
    Loss lost(std::optional<RenderRequest> inFlight, Clock::time_point now);

    /// Takes all waiting requests, to fail them.
    std::vector<RenderRequest> takeAll();

private:
    static constexpr std::size_t kMostHeld = 8;  ///< Of one view; the oldest is forgiven.
    struct Held {
        RenderRequest request;
        bool however = true;  ///< Camera, size and hurry do not matter.
    };
    struct View {
        std::optional<TimedRequest> waiting;
        std::optional<RenderRequest> lastGood;
        int lossesInARow = 0;
        std::deque<Held> held = {};
        SceneTrust trust = {};
    };
    static void hold(View& view, const RenderRequest& request);
    void wait(std::uint64_t id, View& view, TimedRequest request);

    std::map<std::uint64_t, View> views_;
    std::deque<std::uint64_t> turns_;  ///< Views with a waiting request, each once.
    std::uint64_t lastDrawn_ = 0;      ///< View of the newest good request.
};

}  // namespace volcast::workers
