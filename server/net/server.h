#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/base/result.h"
#include "server/session/shared.h"

namespace volcast::net {

/// Who may read /metrics.
enum class MetricsFor { kNobody, kThisMachine, kEverybody };

/// Where the server listens and what it lets in.
struct ListenSettings {
    std::string host = "127.0.0.1";
    std::uint16_t port = 8080;  ///< 0: any free one.
    std::string clientFolder;   ///< The built web client.
    std::vector<std::string> allowedOrigins;
    std::string tlsCert, tlsKey;  ///< PEM files; empty: plain HTTP.
    unsigned maxClients = 64;     ///< WebSockets at once.
    /// Of those, with one address as ClientPlaces counts them; 0: all; none: half of them.
    std::optional<unsigned> maxClientsPerAddress = {};
    std::chrono::seconds writePatience{20};  ///< For 64 KiB of what a WebSocket is sent.
    unsigned threads = 2;                    ///< For sockets; encoding has its own.
    MetricsFor metricsFor = MetricsFor::kThisMachine;
};

/// HTTP/1.1 and WebSocket on one port: bytes in and out of sessions, the web client's files, and
/// /healthz and /readyz. One strand a connection.
class Server {
public:
    /// Listens. `shared` must outlive the server.
    ///
    /// Errors: kIo (the port is taken or not permitted), kInvalidArgument (no such address), as
    /// tlsContext().
    static Result<std::unique_ptr<Server>> create(ListenSettings settings, session::Shared& shared);
    virtual ~Server() = default;
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;
    Server(Server&&) = delete;
    Server& operator=(Server&&) = delete;

    /// The address as a browser takes it, such as "http://127.0.0.1:8080/".
    [[nodiscard]] virtual std::string url() const = 0;

    /// Serves until SIGINT or SIGTERM, then tells clients (close 1012), waits for them a few
    /// seconds and returns. A second signal ends the process at once.
    virtual void run() = 0;

protected:
    Server() = default;
};

}  // namespace volcast::net
