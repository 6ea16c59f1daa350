#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <random>
#include <string>

#include "renderer/base/memfd.h"
#include "renderer/worker/channel.h"
#include "renderer/worker/fault_names.h"
#include "renderer/worker/slot_layout.h"
#include "server/workers/child_process.h"
#include "server/workers/render_service.h"
#include "volcast/internal/v1/worker.pb.h"

namespace volcast::workers {

using SharedDescriptor = std::shared_ptr<const base::FileDescriptor>;

/// One `volcast-worker` process: its channel, what it still owes an answer to and by when, and the
/// shared memory its pictures come in. Never blocks. Owned by the supervisor's thread.
class WorkerProcess {
public:
    using Clock = std::chrono::steady_clock;
    using Message = internal::v1::ToWorker;
    using Answer = internal::v1::FromWorker;

    /// Starts the program; it owes its Ready by the start deadline.
    ///
    /// Errors: kNotFound (no program), kIo.
    static Result<WorkerProcess> start(const RenderSettings& settings,
                                       const std::string& cacheFolder);

    /// Queues messages; flush() sends them as far as the worker reads.
    void addDataset(const std::string& id, const SharedDescriptor& packed,
                    std::chrono::milliseconds limit);
    void removeDataset(const std::string& id);
    void dropView(std::uint64_t view);
    void ping(std::chrono::milliseconds limit);
    /// Has the worker build the shaders of one ray model; handle the answer, then ask for `step`+1.
    void warmUp(std::uint32_t step, std::chrono::milliseconds limit);
    /// Errors: kLimitExceeded (the scene is too large for the channel), kIo (no memory).
    Result<void> render(std::uint64_t number, const RenderRequest& request,
                        std::chrono::milliseconds limit);
    /// Errors: kLimitExceeded (the scene is too large for the channel).
    Result<void> measure(std::uint64_t number, const accuracy::Job& job,
                         std::chrono::milliseconds limit);
    void stopMeasuring();
    void arm(const worker::FaultSpec& fault);
    /// Errors: kLimitExceeded (the scene is too large for the channel).
    Result<void> pick(std::uint64_t number, const worker::PickJob& job,
                      std::chrono::milliseconds limit);

    /// Errors: the channel is closed or broken.
    Result<void> flush();
    /// The next answer that has come, checked to be the one that is owed; empty: none.
    ///
    /// Errors: the channel is closed or broken, or the worker does not keep to the protocol.
    Result<std::optional<Answer>> receive();

    /// Errors: kInvalidArgument (it was not asked for like this, or its slot was not written).
    Result<void> checkPicture(const internal::v1::Rendered& rendered,
                              const RenderRequest& request) const;
    /// Copies a picture, which checkPicture() accepts, out of the slot it came in.
    /// Errors: kLimitExceeded (no memory).
    Result<std::shared_ptr<const Picture>> copyPicture(const internal::v1::Rendered& rendered,
                                                       const RenderRequest& request) const;

    [[nodiscard]] bool ready() const noexcept { return ready_.has_value(); }
    [[nodiscard]] const internal::v1::Ready& about() const { return *ready_; }
    /// All its shaders are built.
    [[nodiscard]] bool warm() const noexcept { return warm_; }
    /// True where nothing is owed.
    [[nodiscard]] bool idle() const noexcept { return owed_.empty(); }
    [[nodiscard]] bool wantsToSend() const noexcept { return !outbox_.empty(); }
    [[nodiscard]] Clock::time_point lastHeard() const noexcept { return lastHeard_; }
    /// By when the oldest answer is owed.
    [[nodiscard]] std::optional<Clock::time_point> deadline() const;
    /// Such as "missed its deadline of 10000 ms for a frame".
    [[nodiscard]] std::string deadlineMissed() const;

    [[nodiscard]] int channelFd() const noexcept { return channel_.fd(); }
    [[nodiscard]] int pidfd() const noexcept { return child_.pidfd(); }
    [[nodiscard]] int pid() const noexcept { return child_.pid(); }
    /// The process itself, to be killed and reaped; this object is of no use afterwards.
    [[nodiscard]] ChildProcess takeChild() noexcept { return std::move(child_); }
    [[nodiscard]] std::optional<ExitStatus> tryReap() noexcept { return child_.tryReap(); }

private:
    enum class Owed { kReady, kDataset, kFrame, kPong, kWarmUp, kMeasure, kPick };
    struct Debt {
        Owed what;
        std::chrono::milliseconds limit;
    };
    struct Outgoing {
        Message message;
        SharedDescriptor descriptor;
    };
    /// Stands in a slot before a picture is asked for: where it still does, there is no picture.
    using Mark = std::array<std::byte, 16>;
    struct Slot {
        base::Mapping mapping;
        Mark mark{};
    };

    WorkerProcess(ChildProcess child, worker::Channel channel)
        : child_{std::move(child)}, channel_{std::move(channel)}, lastHeard_{Clock::now()} {}
    void owe(Owed what, std::chrono::milliseconds limit);
    Result<void> settle(const Answer& answer);
    /// Memory for the next picture where the slot has none that fits; empty: it has.
    Result<SharedDescriptor> prepareSlot(std::size_t bytes);
    /// Marks the first and the last pixels of a picture in the next slot.
    void markSlot(std::size_t colourBytes);

    ChildProcess child_;
    worker::Channel channel_;
    std::deque<Outgoing> outbox_;
    std::deque<Debt> owed_;          ///< Oldest first; the worker answers in order.
    Clock::time_point owedSince_{};  ///< When the oldest became the oldest.
    Clock::time_point lastHeard_;
    std::optional<internal::v1::Ready> ready_;
    bool warm_ = false;
    std::array<Slot, worker::kSlots> slots_;
    std::uint32_t slot_ = 0;  ///< Of the last picture asked for.
    std::mt19937_64 marks_{std::random_device{}()};
};

}  // namespace volcast::workers
