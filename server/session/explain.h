#pragma once

#include <cstdint>

#include "server/workers/render_service.h"
#include "volcast/v1/session.pb.h"

namespace volcast::session {

/// How `frame` was drawn, as clients read it; `view` is the client's number.
v1::Plan planMessage(const workers::RenderedFrame& frame, std::uint32_t view,
                     std::uint64_t inputSeq);

}  // namespace volcast::session
