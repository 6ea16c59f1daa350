#pragma once

#include <chrono>
#include <cstdint>
#include <memory>

#include "server/net/beast.h"
#include "server/session/shared.h"

namespace volcast::net {

inline constexpr const char* kSubprotocol = "volcast.v1";

/// One WebSocket and its session: what is read goes in, what the session has to say goes out.
class WebSocket {
public:
    virtual ~WebSocket() = default;
    WebSocket(const WebSocket&) = delete;
    WebSocket& operator=(const WebSocket&) = delete;
    WebSocket(WebSocket&&) = delete;
    WebSocket& operator=(WebSocket&&) = delete;

    /// Accepts `request` and serves it to its end.
    virtual asio::awaitable<void> serve(const Request& request) = 0;
    /// Asks the client to leave (close 1012). Any thread.
    virtual void drain() = 0;
    /// Ends the session without a word. Only when no thread runs the socket any more.
    virtual void abandon() = 0;

protected:
    WebSocket() = default;
};

/// Who it is, and how long it may take nothing of what is sent to it.
struct WebSocketDesc {
    std::uint64_t number = 0;
    std::chrono::seconds writePatience{};
};
std::shared_ptr<WebSocket> makeWebSocket(Stream stream, session::Shared& shared,
                                         const WebSocketDesc& desc);
std::shared_ptr<WebSocket> makeWebSocket(TlsStream stream, session::Shared& shared,
                                         const WebSocketDesc& desc);

}  // namespace volcast::net
