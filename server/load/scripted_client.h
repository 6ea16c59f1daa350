#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "server/load/settings.h"
#include "server/load/shared_view.h"
#include "server/load/stats.h"

namespace volcast::load {

/// What the clients of a run have in common; outlives them.
struct Stage {
    const LoadSettings& settings;
    net::ClientLoop& loop;
    bool measuring = false;
    std::function<void(const std::string& why)> giveUp;  ///< Ends the run.
};

/// One scripted client: connects, opens or joins its view, sends inputs, acknowledges frames.
class ScriptedClient {
public:
    using Clock = std::chrono::steady_clock;

    /// `opens`: it opens the view and steers it; else it joins by its link and watches.
    ScriptedClient(Stage& stage, Kind kind, SharedView& view, bool opens, Stats& stats)
        : stage_{stage}, kind_{kind}, view_{view}, opens_{opens}, stats_{stats} {}
    ScriptedClient(const ScriptedClient&) = delete;
    ScriptedClient& operator=(const ScriptedClient&) = delete;
    ScriptedClient(ScriptedClient&&) = delete;
    ScriptedClient& operator=(ScriptedClient&&) = delete;
    ~ScriptedClient() = default;

    void start();
    /// Counts what has not come, with the time that it has taken so far.
    void countMissing();
    [[nodiscard]] std::uint64_t frames() const noexcept { return frames_; }
    /// It has seen a frame, or why it will not.
    [[nodiscard]] bool settled() const noexcept { return settled_; }

private:
    [[nodiscard]] net::LinkShape shape() const;
    void receive(std::span<const std::byte> bytes);
    void frame(std::span<const std::byte> bytes);
    void welcome(const v1::Welcome& message);
    void openView();
    void opened(const v1::ViewOpened& message);
    void refused(const v1::Error& error);
    void closed(const std::string& why);
    void measure(std::uint64_t inputSeq, std::size_t bytes);
    void pace(const v1::FrameHeader& header);
    void input(std::uint64_t connection);
    void ack(std::uint32_t view, std::uint32_t sequence);
    void ackBlindly(std::uint64_t connection);
    void pin();
    void send(const v1::ClientMessage& message);

    Stage& stage_;
    const Kind kind_;
    SharedView& view_;
    const bool opens_;
    Stats& stats_;

    std::shared_ptr<net::ClientSocket> socket_;
    std::uint64_t connection_ = 0;  ///< How often it connected: timers of an older one are void.
    bool greeted_ = false;
    bool sharing_ = false;
    bool settled_ = false;
    Clock::time_point startedAt_{};
    Clock::time_point newAt_{};  ///< When it last saw a new state.
    v1::Welcome welcome_;
    std::map<std::string, v1::DatasetKind> datasets_;
    std::optional<Script> script_;
    std::uint64_t inputSeq_ = 0;
    std::uint64_t shownSeq_ = 0;
    struct Sent {
        std::uint64_t inputSeq;
        Clock::time_point at;
    };
    std::deque<Sent> unanswered_;
    std::uint64_t frames_ = 0;
};

}  // namespace volcast::load
