#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "renderer/base/result.h"

namespace volcast::commands {

/// All of a file, at most 16 MiB: cameras, maps, scenes. Errors: kIo, kLimitExceeded; both name it.
Result<std::string> readTextFile(const std::string& path);

/// Errors: kIo naming the path, before any work is spent on what goes there.
Result<void> checkWritable(const std::string& path);

/// Replaces the file as a whole or not at all. Errors: kIo naming the path.
Result<void> writeFile(const std::string& path, std::span<const std::byte> bytes);

}  // namespace volcast::commands
