#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "renderer/base/result.h"

namespace volcast::worker {

/// Command line of `volcast-worker`; only the server starts it, so there is no help text.
struct Options {
    std::string gpu;           ///< As gpu::DeviceDesc.
    std::string cacheFolder;   ///< The driver's shader cache: the one folder it may write to.
    std::string shaderFolder;  ///< Chunks are read from here; empty: the embedded ones.
    std::uint64_t volumeBudgetBytes = std::uint64_t{1} << 30;  ///< As plan::Limits.
    bool probe = false;  ///< Print what EGL and GL offer as JSON and end.
};

/// Errors: kInvalidArgument naming the argument.
Result<Options> parseOptions(std::span<char* const> arguments);

}  // namespace volcast::worker
