#pragma once

#include <string>

#include "server/session/shared.h"

namespace volcast::session {

/// The body of /metrics.
std::string metricsText(Shared& shared);

}  // namespace volcast::session
