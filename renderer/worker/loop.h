#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "renderer/accuracy/evidence.h"
#include "renderer/accuracy/meter.h"
#include "renderer/gpu/device.h"
#include "renderer/pick/picker.h"
#include "renderer/scene/render.h"
#include "renderer/worker/channel.h"
#include "renderer/worker/exit_codes.h"
#include "renderer/worker/faults.h"
#include "renderer/worker/slots.h"
#include "volcast/internal/v1/worker.pb.h"

namespace volcast::worker {

/// Does what the server asks for over the channel, in order, one thing at a time: datasets come,
/// pictures go. All on the device's thread.
class Loop {
public:
    /// `cacheFolder`: where what was measured of this machine is kept; empty: nowhere.
    Loop(Channel& channel, gpu::Device& device, scene::Renderer& renderer,
         const std::string& cacheFolder)
        : channel_{channel},
          device_{device},
          renderer_{renderer},
          meter_{renderer},
          evidence_{renderer, meter_,
                    accuracy::Costs{cacheFolder.empty() ? "" : cacheFolder + "/costs.txt",
                                    device.info().glRenderer + " " + device.info().glVersion}} {}

    /// Lets this worker fail. Errors: as ArmedFault::arm.
    Result<void> arm(const FaultSpec& fault);

    /// Until the server closes the channel or the device is lost.
    ExitCode run();

private:
    using Descriptors = std::vector<base::FileDescriptor>;

    /// Errors: kDeviceLost (server or device gone), kInvalidArgument (unknown message).
    Result<void> handle(const internal::v1::ToWorker& message, const Descriptors& descriptors);
    Result<void> addDataset(const std::string& id, const Descriptors& descriptors);
    Result<void> warmUp(std::uint32_t step);
    Result<void> render(const internal::v1::Render& request, const Descriptors& descriptors);
    /// Errors are the request's own, but for kDeviceLost.
    Result<internal::v1::FromWorker> draw(const internal::v1::Render& request,
                                          const Descriptors& descriptors);
    Result<void> measure(const internal::v1::Measure& request);
    /// A part of it; empty: there is more.
    Result<std::optional<accuracy::Measurement>> advance(const accuracy::Job& job);
    Result<void> pick(const internal::v1::Pick& request);
    /// Answers with `failed`; kDeviceLost where the device is lost, by `error` or by itself.
    Result<void> refuse(const Error& error, internal::v1::Failed failed);
    /// kDeviceLost where the GPU was reset.
    Result<void> checkDevice();
    /// Gives the device up; run() ends.
    Error deviceLoss(Error error);
    Result<void> reply(internal::v1::FromWorker message);

    Channel& channel_;
    gpu::Device& device_;
    scene::Renderer& renderer_;
    accuracy::Meter meter_;
    accuracy::EvidenceKeeper evidence_;
    pick::Picker picker_;
    Slots slots_;
    std::map<std::uint64_t, double> partsCpuMs_;  ///< Of unfinished pictures, by view.
    bool deviceLost_ = false;
    std::unique_ptr<ArmedFault> fault_;  ///< Null but in tests.
};

}  // namespace volcast::worker
