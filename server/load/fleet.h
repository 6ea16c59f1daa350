#pragma once

#include <functional>
#include <string>

#include "renderer/base/result.h"
#include "server/load/settings.h"
#include "server/load/stats.h"

namespace volcast::load {

/// Called a few times a second; `fraction` of the whole run, `text` what was seen last.
using OnProgress = std::function<void(const std::string& text, double fraction)>;

/// Runs all clients to the end of the measured time, or to SIGINT.
///
/// Errors: kUnsupported (the server lacks what the run needs), kIo (no client could connect; the
/// trusted certificates cannot be read).
Result<Outcome> runFleet(const LoadSettings& settings, const OnProgress& progress);

}  // namespace volcast::load
