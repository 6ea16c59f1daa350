#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "server/metrics/metrics.h"
#include "server/session/catalogue.h"
#include "server/session/encode_pool.h"
#include "server/session/upload_folder.h"
#include "server/session/view_router.h"
#include "server/workers/fault_switch.h"
#include "server/workers/render_service.h"

namespace volcast::session {

class Thumbnails;
class Views;

/// What one connection may ask for; told to clients in the welcome.
struct SessionLimits {
    std::uint32_t maxViews = 16;
    std::uint32_t maxMessageBytes = 64 * 1024;
    std::uint32_t maxMessagesPerS = 4000;
    std::uint64_t maxViewPixels = std::uint64_t{7680} * 4320;  ///< Of one view.
    std::size_t maxWaitingMessages = 1024;  ///< Replies that the client has not read yet.
};

/// What views are made of; all of it outlives them.
struct ViewParts {
    workers::RenderService& render;
    Catalogue& catalogue;
    ViewRouter& router;
    EncodePool& encoders;
    std::uint64_t maxPixels = SessionLimits{}.maxViewPixels;
    std::size_t maxPeople = 256;  ///< In one view.
    /// The view `id` has something new to save; called without locks of views.
    std::function<void(const std::string& id)> changed = {};
};

/// What all sessions of a server share; all of it outlives them.
struct Shared {
    workers::RenderService& render;
    Catalogue& catalogue;
    Views& views;
    SessionLimits limits;
    std::string server;                      ///< Name and version.
    std::string sourceUrl;                   ///< Where the source of this server is.
    workers::FaultSwitch* faults = nullptr;  ///< Null: nobody may inject faults.
    UploadFolder* uploads = nullptr;         ///< Null: nobody may upload.
    Thumbnails* thumbnails = nullptr;        ///< Null: lists have no pictures.
    metrics::Metrics metrics = {};
};

}  // namespace volcast::session
