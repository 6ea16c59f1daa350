#pragma once

#include <cstdint>
#include <string>

#include "server/metrics/metrics.h"
#include "server/session/catalogue.h"
#include "server/session/encode_pool.h"
#include "server/session/view_router.h"
#include "server/workers/render_service.h"

namespace volcast::session {

/// What one connection may ask for; told to clients in the welcome.
struct SessionLimits {
    std::uint32_t maxViews = 16;
    std::uint32_t maxMessageBytes = 64 * 1024;
    std::uint32_t maxMessagesPerS = 4000;
    std::uint64_t maxViewPixels = std::uint64_t{7680} * 4320;  ///< Of one view.
    std::size_t maxWaitingMessages = 1024;  ///< Replies that the client has not read yet.
};

/// What all sessions of a server share; all of it outlives them.
struct Shared {
    workers::RenderService& render;
    Catalogue& catalogue;
    ViewRouter& router;
    EncodePool& encoders;
    SessionLimits limits;
    std::string server;     ///< Name and version.
    std::string sourceUrl;  ///< Where the source of this server is.
    metrics::Metrics metrics = {};
};

}  // namespace volcast::session
