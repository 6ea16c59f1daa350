#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "server/net/beast.h"
#include "server/session/session.h"

namespace volcast::net {

inline constexpr const char* kSubprotocol = "volcast.v1";

/// One WebSocket and its session: what is read goes in, what the session has to say goes out.
///
/// Lives on one strand; kept alive by its two coroutines, which end together.
class WebSocket : public std::enable_shared_from_this<WebSocket> {
public:
    WebSocket(Stream stream, session::Shared& shared, std::uint64_t number);

    /// Accepts `request` and serves it to its end.
    asio::awaitable<void> serve(const Request& request);

    /// Asks the client to leave (close 1012). Any thread.
    void drain();
    /// Ends the session without a word. Only when no thread runs the socket any more.
    void abandon() { session_.reset(); }

private:
    asio::awaitable<void> readAll();
    asio::awaitable<void> writeAll();
    /// Sends one message in slices; false where the connection is over.
    asio::awaitable<bool> write(const session::Outgoing& message);
    asio::awaitable<void> close(session::Closing closing);
    void wake() { wake_.cancel(); }
    /// Closes the socket hard unless the returned guard dies before `limit`.
    void watch(std::chrono::seconds limit);

    websocket::stream<Stream> socket_;
    session::Shared& shared_;
    const std::uint64_t number_;
    asio::steady_timer wake_;   ///< The writer sleeps on it; cancelled when there is news.
    asio::steady_timer watch_;  ///< Runs while a write or close is under way.
    std::shared_ptr<session::Session> session_;
    bool over_ = false;
};

}  // namespace volcast::net
