#include "server/net/web_socket.h"

#include <algorithm>
#include <array>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <optional>
#include <string_view>
#include <sys/socket.h>
#include <utility>

#include <spdlog/spdlog.h>

#include "server/session/session.h"

namespace volcast::net {

namespace {

using session::Clock;

constexpr std::chrono::seconds kHandshake{30};
constexpr std::chrono::seconds kIdle{60};  ///< Pinged at half of it.
constexpr std::chrono::seconds kPingEach{5};
constexpr std::chrono::seconds kCloseWithin{3};
const session::Closing kGoingDown{.code = 1012, .reason = "the server is going down"};
constexpr std::size_t kSlice = std::size_t{64} * 1024;
constexpr int kNotSentLowat = 128 * 1024;

/// The kernel queues little beyond what is on the wire: newer frames overtake in our slots instead.
void setSocketOptions(Stream& stream) {
    boost::system::error_code ignored;
    stream.socket().set_option(Tcp::no_delay{true}, ignored);
    ::setsockopt(stream.socket().native_handle(), IPPROTO_TCP, TCP_NOTSENT_LOWAT, &kNotSentLowat,
                 sizeof(kNotSentLowat));
}

/// Over TCP or TLS. Lives on one strand; kept alive by its two coroutines, which end together.
template <class Layer>
class SocketOver final : public WebSocket, public std::enable_shared_from_this<SocketOver<Layer>> {
public:
    SocketOver(Layer stream, session::Shared& shared, const WebSocketDesc& desc);
    asio::awaitable<void> serve(const Request& request) override;
    void drain() override;
    void abandon() override { session_.reset(); }

private:
    asio::awaitable<void> readAll();
    asio::awaitable<void> writeAll();
    /// Sends one message in slices; false where the connection is over.
    asio::awaitable<bool> write(const session::Outgoing& message);
    asio::awaitable<void> close(session::Closing closing);
    /// Measures the way itself: round trips of pings, which carry no picture.
    asio::awaitable<void> pingAll();
    void wake() { wake_.cancel(); }
    /// Closes the socket hard unless `watch_` is cancelled within `limit`.
    void watch(std::chrono::seconds limit);

    websocket::stream<Layer> socket_;
    session::Shared& shared_;
    const std::uint64_t number_;
    const std::chrono::seconds writePatience_;
    asio::steady_timer wake_;   ///< The writer sleeps on it; cancelled when there is news.
    asio::steady_timer watch_;  ///< Runs while a write or close is under way.
    asio::steady_timer nextPing_;
    std::optional<session::TimePoint> pingedAt_;  ///< Until it is answered.
    std::shared_ptr<session::Session> session_;
    bool over_ = false;
    bool draining_ = false;
};

template <class Layer>
SocketOver<Layer>::SocketOver(Layer stream, session::Shared& shared, const WebSocketDesc& desc)
    : socket_{std::move(stream)},
      shared_{shared},
      number_{desc.number},
      writePatience_{desc.writePatience},
      wake_{socket_.get_executor()},
      watch_{socket_.get_executor()},
      nextPing_{socket_.get_executor()} {
    beast::get_lowest_layer(socket_).expires_never();  // The WebSocket has timeouts of its own.
    websocket::stream_base::timeout timeout{};
    timeout.handshake_timeout = kHandshake;
    timeout.idle_timeout = kIdle;
    timeout.keep_alive_pings = true;
    socket_.set_option(timeout);
    socket_.set_option(websocket::stream_base::decorator([](websocket::response_type& response) {
        response.set(http::field::sec_websocket_protocol, kSubprotocol);
        response.set(http::field::server, "volcast");
    }));
    socket_.read_message_max(shared.limits.maxMessageBytes);
    socket_.auto_fragment(false);
    setSocketOptions(beast::get_lowest_layer(socket_));
}

template <class Layer>
asio::awaitable<void> SocketOver<Layer>::serve(const Request& request) {
    const auto self = this->shared_from_this();
    const auto [error] = co_await socket_.async_accept(request, kAsTuple);
    if (error) co_return;
    session_ = session::Session::create(
        shared_, number_,
        {.post = [executor = socket_.get_executor()](
                     std::function<void()> act) { asio::post(executor, std::move(act)); },
         .wake =
             [weak = this->weak_from_this()] {
                 if (const auto alive = weak.lock()) alive->wake();
             }});
    if (draining_) session_->end(kGoingDown);
    asio::co_spawn(
        socket_.get_executor(), [self]() { return self->writeAll(); }, asio::detached);
    asio::co_spawn(
        socket_.get_executor(), [self]() { return self->pingAll(); }, asio::detached);
    co_await readAll();
    over_ = true;
    wake();
    nextPing_.cancel();
    session_.reset();
    spdlog::info("event=disconnected connection={}", number_);
}

template <class Layer>
asio::awaitable<void> SocketOver<Layer>::readAll() {
    beast::flat_buffer buffer;
    while (true) {
        const auto [error, bytes] = co_await socket_.async_read(buffer, kAsTuple);
        if (error) {
            spdlog::debug(R"(event=read_ended connection={} reason="{}")", number_,
                          error.message());
            co_return;
        }
        const auto data = buffer.cdata();
        shared_.metrics.received(data.size());
        const auto form = socket_.got_text() ? session::Form::kJson : session::Form::kBinary;
        session_->receive({static_cast<const std::byte*>(data.data()), data.size()}, form,
                          Clock::now());
        buffer.consume(buffer.size());
        wake();
    }
}

template <class Layer>
asio::awaitable<void> SocketOver<Layer>::pingAll() {
    const auto self = this->shared_from_this();
    // Beast's own pings, on quiet connections, are empty; so are their pongs.
    constexpr std::string_view kPath = "path";
    const websocket::ping_data ping{kPath.data()};
    socket_.control_callback([this, kPath](websocket::frame_type type, std::string_view data) {
        if (type != websocket::frame_type::pong || data != kPath || !pingedAt_) return;
        const auto now = Clock::now();
        const auto took = now - *std::exchange(pingedAt_, std::nullopt);
        if (session_) {
            session_->ponged(std::chrono::duration_cast<std::chrono::microseconds>(took), now);
        }
    });
    while (!over_) {
        if (!pingedAt_) {
            pingedAt_ = Clock::now();
            const auto [error] = co_await socket_.async_ping(ping, kAsTuple);
            if (error || over_) break;
        }
        nextPing_.expires_after(kPingEach);
        (void)co_await nextPing_.async_wait(kAsTuple);
    }
}

template <class Layer>
asio::awaitable<void> SocketOver<Layer>::writeAll() {
    const auto self = this->shared_from_this();
    while (!over_) {
        session_->tick(Clock::now());
        bool alive = true;
        while (alive && !over_) {
            const auto message = session_->next(Clock::now());
            if (!message) break;
            alive = co_await write(*message);
        }
        if (over_ || !alive) break;
        if (session_->closing()) co_return co_await close(*session_->closing());
        const auto now = Clock::now();
        wake_.expires_at(session_->deadline(now).value_or(now + std::chrono::hours{1}));
        (void)co_await wake_.async_wait(kAsTuple);
    }
    beast::get_lowest_layer(socket_).close();
}

template <class Layer>
asio::awaitable<bool> SocketOver<Layer>::write(const session::Outgoing& message) {
    socket_.text(message.text);
    // A slice is a fragment: what matters is that a reader who stands still is noticed.
    static const std::vector<std::byte> kNothing;
    const std::vector<std::byte>& payload = message.payload ? *message.payload : kNothing;
    const std::size_t total = message.head.size() + payload.size();
    for (std::size_t done = 0; done < total || total == 0;) {
        const bool inHead = done < message.head.size();
        const auto& part = inHead ? message.head : payload;
        const std::size_t at = inHead ? done : done - message.head.size();
        const std::size_t size = std::min(kSlice, part.size() - at);
        std::array<asio::const_buffer, 2> buffers{asio::buffer(part.data() + at, size)};
        std::size_t sum = size;
        if (inHead && size == part.size() - at) {
            const std::size_t more = std::min(kSlice - size, payload.size());
            buffers[1] = asio::buffer(payload.data(), more);
            sum += more;
        }
        done += sum;
        watch(writePatience_);
        const auto [error, bytes] =
            co_await socket_.async_write_some(done >= total, buffers, kAsTuple);
        watch_.cancel();
        if (error || over_) co_return false;
        if (total == 0) break;
    }
    shared_.metrics.sent(total);
    co_return true;
}

template <class Layer>
asio::awaitable<void> SocketOver<Layer>::close(session::Closing closing) {
    watch(kCloseWithin);
    spdlog::info(R"(event=closing connection={} code={} reason="{}")", number_, closing.code,
                 closing.reason);
    const websocket::close_reason reason{static_cast<websocket::close_code>(closing.code),
                                         closing.reason};
    (void)co_await socket_.async_close(reason, kAsTuple);
    watch_.cancel();
    beast::get_lowest_layer(socket_).close();
}

template <class Layer>
void SocketOver<Layer>::watch(std::chrono::seconds limit) {
    watch_.expires_after(limit);
    watch_.async_wait([weak = this->weak_from_this()](boost::system::error_code error) {
        const auto self = weak.lock();
        if (error || !self) return;
        spdlog::warn("event=stuck connection={}", self->number_);
        beast::get_lowest_layer(self->socket_).close();
    });
}

template <class Layer>
void SocketOver<Layer>::drain() {
    asio::post(socket_.get_executor(), [weak = this->weak_from_this()] {
        const auto self = weak.lock();
        if (!self) return;
        self->draining_ = true;  // Also of one whose upgrade is under way.
        if (!self->session_) return;
        self->session_->end(kGoingDown);
        self->wake();
    });
}

}  // namespace

std::shared_ptr<WebSocket> makeWebSocket(Stream stream, session::Shared& shared,
                                         const WebSocketDesc& desc) {
    return std::make_shared<SocketOver<Stream>>(std::move(stream), shared, desc);
}

std::shared_ptr<WebSocket> makeWebSocket(TlsStream stream, session::Shared& shared,
                                         const WebSocketDesc& desc) {
    return std::make_shared<SocketOver<TlsStream>>(std::move(stream), shared, desc);
}

}  // namespace volcast::net
