#pragma once

#include <cstdint>
#include <memory>

#include "renderer/worker/channel.h"
#include "renderer/worker/fault_names.h"
#include "volcast/internal/v1/worker.pb.h"

namespace volcast::worker {

/// A fault that waits in this worker for its chance. Without one there is no such object.
class ArmedFault {
public:
    /// Faults of the driver are in place from now on.
    ///
    /// Thread: the device's. Errors: kInvalidArgument (a fault of another kind of process).
    static Result<std::unique_ptr<ArmedFault>> arm(const FaultSpec& spec);

    /// A message has come. A fault that strikes here does not return.
    void received(const internal::v1::ToWorker& message);
    /// In place of an answer that is about to be sent; may change it. Empty: send it.
    ///
    /// Errors: kDeviceLost where the fault is that loss.
    Result<bool> answers(internal::v1::FromWorker& answer, const Channel& channel);

private:
    explicit ArmedFault(const FaultSpec& spec) : spec_{spec} {}
    /// True the one time that it is to happen.
    bool strikes();

    FaultSpec spec_;
    bool struck_ = false;
};

/// Before the device is opened: true where this worker is to lose its GPU at its start.
[[nodiscard]] bool losesGpuAtStart(const FaultSpec& spec) noexcept;

}  // namespace volcast::worker
