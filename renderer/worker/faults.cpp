#include "renderer/worker/faults.h"

#include <array>
#include <cstdlib>
#include <optional>
#include <sys/socket.h>
#include <unistd.h>

#include <spdlog/spdlog.h>

#include "renderer/gpu/driver_faults.h"

namespace volcast::worker {

namespace {

std::optional<gpu::DriverFault> driverFault(Fault fault) {
    switch (fault) {
        case Fault::kCrash: return gpu::DriverFault::kCrashInDraw;
        case Fault::kHangInDraw: return gpu::DriverFault::kHangInDraw;
        case Fault::kHangInCompile: return gpu::DriverFault::kHangInLink;
        case Fault::kGpuReset: return gpu::DriverFault::kReset;
        case Fault::kOutOfGpuMemory: return gpu::DriverFault::kOutOfMemory;
        case Fault::kUnwrittenSlot: return gpu::DriverFault::kReadsNothing;
        case Fault::kExitInUpload: return gpu::DriverFault::kExitInUpload;
        default: return std::nullopt;
    }
}

/// A message whose first field has the number 0, which no message has.
void sendGarbage(const Channel& channel) {
    constexpr std::array<unsigned char, 8> kBytes{0x00, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff};
    static_cast<void>(::send(channel.fd(), kBytes.data(), kBytes.size(), MSG_NOSIGNAL));
}

}  // namespace

Result<std::unique_ptr<ArmedFault>> ArmedFault::arm(const FaultSpec& spec) {
    if (struckBy(spec.fault) == FaultyProcess::kImport) {
        return fail(ErrorCode::kInvalidArgument, toText(spec) + " strikes imports, not workers");
    }
    spdlog::warn("event=fault_armed fault={}", toText(spec));
    if (const auto driver = driverFault(spec.fault)) gpu::injectDriverFault(*driver, spec.after);
    return std::unique_ptr<ArmedFault>{new ArmedFault{spec}};
}

bool ArmedFault::strikes() {
    if (struck_) return false;
    if (spec_.after > 0) {
        --spec_.after;
        return false;
    }
    return struck_ = true;
}

void ArmedFault::received(const internal::v1::ToWorker& message) {
    const bool chance = message.has_warm_up() || message.has_arm_fault();
    if (spec_.fault == Fault::kSpareExit && chance && strikes()) ::_exit(EXIT_FAILURE);
}

Result<bool> ArmedFault::answers(internal::v1::FromWorker& answer, const Channel& channel) {
    if (!answer.has_rendered()) return false;
    switch (spec_.fault) {
        case Fault::kGarbage: {
            if (!strikes()) return false;
            sendGarbage(channel);
            return true;
        }
        case Fault::kWrongSize: {
            if (strikes()) answer.mutable_rendered()->set_width(answer.rendered().width() + 1);
            return false;
        }
        case Fault::kLoseGpu: {
            if (strikes()) return fail(ErrorCode::kDeviceLost, "the GPU was lost as asked for");
            return false;
        }
        default: return false;
    }
}

bool losesGpuAtStart(const FaultSpec& spec) noexcept {
    return spec.fault == Fault::kLoseGpu && spec.after == 0;
}

}  // namespace volcast::worker
