#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "renderer/base/result.h"
#include "renderer/worker/fault_names.h"

namespace volcast::worker {

/// Command line of `volcast-worker`, which the server alone starts; people look at what it finds.
struct Options {
    std::string gpu;           ///< As gpu::DeviceDesc.
    std::string cacheFolder;   ///< The driver's shader cache: the one folder it may write to.
    std::string shaderFolder;  ///< Chunks are read from here; empty: the embedded ones.
    std::uint64_t volumeBudgetBytes = std::uint64_t{1} << 30;  ///< As plan::Limits.
    bool help = false;
    bool probe = false;              ///< Print what EGL and GL offer as JSON and end.
    bool listFaults = false;         ///< Print the names that --fault takes and end.
    bool tryForbidden = false;       ///< Print what the sandbox refuses and end.
    std::optional<FaultSpec> fault;  ///< Armed from the start.
};

/// What --help prints.
extern const char* const kHelp;

/// Errors: kInvalidArgument naming the argument.
Result<Options> parseOptions(std::span<char* const> arguments);

}  // namespace volcast::worker
