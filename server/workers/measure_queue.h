#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "server/workers/render_service.h"

namespace volcast::workers {

/// Which measurement goes on next: one a view, done part by part, so that pictures need not wait.
/// One that has begun comes first: the worker keeps one between parts.
///
/// Not thread-safe; the supervisor's thread owns it.
class MeasureQueue {
public:
    using Clock = std::chrono::steady_clock;

    /// `partLimit`: a part that takes longer costs its worker; `limit`: all parts of a measurement.
    MeasureQueue(std::chrono::milliseconds partLimit, std::chrono::milliseconds limit)
        : partLimit_{partLimit}, limit_{limit} {}

    /// Replaces the view's request.
    void submit(MeasureRequest request);
    /// Forgets the view's. True: the worker has begun it.
    bool stop(std::uint64_t view);

    /// Takes the next part in hand; null: none waits. It is in hand until one of the calls below.
    const MeasureRequest* next(Clock::time_point now);
    [[nodiscard]] bool inHand() const noexcept { return inHand_.has_value(); }
    /// The part in hand is done, others wait; returns the request where its parts have taken longer
    /// than the limit, and forgets it.
    std::optional<MeasureRequest> goOn(Clock::time_point now);
    /// It was the last part, or failed.
    MeasureRequest finish();

    /// A worker was lost: what it had begun begins anew. Returned and forgotten: what has lost two
    /// workers, or one by a part past its limit.
    std::vector<MeasureRequest> lost(Clock::time_point now);
    /// Takes all that wait, to fail them.
    std::vector<MeasureRequest> takeAll();

private:
    struct One {
        MeasureRequest request;
        bool begun = false;
        Clock::duration spent{0};
        int losses = 0;
    };

    std::chrono::milliseconds partLimit_, limit_;
    std::map<std::uint64_t, One> waiting_;  ///< By view.
    std::optional<One> inHand_;
    Clock::time_point since_;  ///< Of the part in hand.
    bool stopped_ = false;     ///< Nobody waits for what is in hand.
};

}  // namespace volcast::workers
