#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "renderer/base/result.h"

namespace volcast::worker {

/// What can be made to fail, to see that everything else goes on.
enum class Fault {
    kCrash,
    kHangInDraw,
    kHangInCompile,
    kGpuReset,
    kOutOfGpuMemory,
    kUnwrittenSlot,
    kWrongSize,
    kGarbage,
    kExitInUpload,
    kSpareExit,
    kLoseGpu,
    kImportCrash,
    kImportHang,
};

/// Which process a fault strikes.
enum class FaultyProcess { kWorker, kSpare, kImport };

struct FaultSpec {
    Fault fault = Fault::kCrash;
    std::uint32_t after = 0;  ///< So many chances to strike pass first.
};

/// "NAME" or "NAME:AFTER".
///
/// Errors: kInvalidArgument, listing the names where it is none of them.
Result<FaultSpec> parseFault(std::string_view text);
/// What parseFault() reads.
std::string toText(const FaultSpec& spec);
[[nodiscard]] FaultyProcess struckBy(Fault fault) noexcept;

/// One line a fault, the name first.
std::string faultList();

}  // namespace volcast::worker
