#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "renderer/base/result.h"

namespace volcast::net {

/// Where a WebSocket is.
struct WsUrl {
    bool tls = false;
    std::string host;
    std::uint16_t port = 0;
    std::string target = "/v1/ws";
};

/// Reads "ws://HOST:PORT/PATH"; also wss, http and https; without a path (or with "/") /v1/ws.
///
/// Errors: kInvalidArgument.
Result<WsUrl> parseWsUrl(const std::string& text);

/// A link that is worse than the loopback, as far as its far end can make it so.
struct LinkShape {
    double bytesPerSecond = 0;           ///< Of what is read; 0: as fast as it comes.
    std::chrono::milliseconds delay{0};  ///< Added one way, to all in each direction.
};

/// What a client hears of its socket; called on the loop's thread.
struct ClientEvents {
    std::function<void()> opened;
    std::function<void(std::span<const std::byte>)> message;
    /// The connection is over, or was never there. Last call; `why` is empty after close().
    std::function<void(const std::string& why)> closed;
};

/// One client's connection; used on the loop's thread only.
class ClientSocket {
public:
    virtual ~ClientSocket() = default;
    ClientSocket(const ClientSocket&) = delete;
    ClientSocket& operator=(const ClientSocket&) = delete;
    ClientSocket(ClientSocket&&) = delete;
    ClientSocket& operator=(ClientSocket&&) = delete;
    /// One binary message.
    virtual void send(std::string bytes) = 0;
    virtual void close() = 0;

protected:
    ClientSocket() = default;
};

/// Many WebSocket clients on one thread.
class ClientLoop {
public:
    using Clock = std::chrono::steady_clock;

    static std::unique_ptr<ClientLoop> create();
    virtual ~ClientLoop() = default;
    ClientLoop(const ClientLoop&) = delete;
    ClientLoop& operator=(const ClientLoop&) = delete;
    ClientLoop(ClientLoop&&) = delete;
    ClientLoop& operator=(ClientLoop&&) = delete;

    /// Certificates that wss trusts, as a PEM file; empty: those of the system.
    ///
    /// Errors: kIo (it cannot be read).
    virtual Result<void> trust(const std::string& file) = 0;
    virtual std::shared_ptr<ClientSocket> connect(const WsUrl& url, const LinkShape& shape,
                                                  ClientEvents events) = 0;
    /// Calls `act` in run(), not before `when`.
    virtual void at(Clock::time_point when, std::function<void()> act) = 0;
    /// Returns after stop(), or after SIGINT or SIGTERM.
    virtual void run() = 0;
    virtual void stop() = 0;

protected:
    ClientLoop() = default;
};

}  // namespace volcast::net
