#pragma once

#include <string>

#include "server/workers/render_service.h"

namespace volcast::session {

/// The body of /readyz: one JSON object, in the words of RenderStatus.
std::string readinessJson(const workers::RenderStatus& status);

}  // namespace volcast::session
