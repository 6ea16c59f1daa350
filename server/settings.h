#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "server/net/server.h"
#include "server/session/shared.h"
#include "server/workers/import_service.h"
#include "server/workers/render_service.h"

namespace volcast {

/// All of `volcast serve`: one struct a part, defaults in place.
struct ServeSettings {
    net::ListenSettings listen;
    std::string dataFolder;  ///< Empty: the built-in demo.
    workers::RenderSettings render;
    workers::ImportSettings imports;
    unsigned importsAtOnce = 1;
    std::uint64_t maxDataBytes = 0;  ///< Of all imported data; 0: no limit.
    unsigned encodeThreads = 2;
    session::SessionLimits limits;
    bool allowUploads = false;
    session::UploadLimits uploads;
    bool allowFaults = false;  ///< Clients may let workers and imports fail.
    std::chrono::seconds keepViews{60};
    std::size_t maxOpenViews = 1024;  ///< In the whole server.
    std::size_t maxPeople = 256;      ///< In one view.
    std::string linkKeyFile;          ///< Empty: a key in stateFolder, or one of this run.
    std::string stateFolder;          ///< Empty: views end with the server.
    std::string logLevel = "info";
    std::string serverName;  ///< Told to clients, with the version.
    std::string sourceUrl;   ///< Told to clients: the AGPL asks for it.
};

}  // namespace volcast
