#pragma once

#include <cstdint>

namespace volcast::gpu {

/// What a GL driver does when it fails.
enum class DriverFault {
    kCrashInDraw,   ///< SIGSEGV.
    kHangInDraw,    ///< The call never returns.
    kHangInLink,    ///< The call never returns.
    kExitInUpload,  ///< The process ends while a buffer is filled.
    kOutOfMemory,   ///< Memory for a buffer is refused, with the driver's own error.
    kReset,         ///< The context says that it was reset.
    kReadsNothing,  ///< Pixels are read back without error, and not written.
};

/// Lets the driver fail once, after `after` more calls that would fail: puts a function of ours in
/// the place of the GL function at which the fault strikes. Before that, and for all others,
/// calls go straight to the driver.
///
/// Thread: the device's, with its context current.
void injectDriverFault(DriverFault fault, std::uint32_t after);

}  // namespace volcast::gpu
