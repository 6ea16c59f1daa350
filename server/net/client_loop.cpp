#include "server/net/client_loop.h"

#include <algorithm>
#include <csignal>
#include <deque>
#include <utility>

#include "server/net/beast.h"
#include "server/net/shaped_link.h"

namespace volcast::net {

namespace {

using Clock = ClientLoop::Clock;

constexpr std::chrono::seconds kConnectWithin{10};
constexpr std::size_t kMaxMessage = std::size_t{1} << 28U;

/// One connection, behind a link where it shall have one.
template <class Layer>
class Socket final : public ClientSocket, public std::enable_shared_from_this<Socket<Layer>> {
public:
    template <class... Tls>
    Socket(ClientLoop& loop, Strand strand, LinkShape shape, ClientEvents events, Tls&... tls)
        : loop_{loop}, socket_{Stream{strand}, tls...}, shape_{shape}, events_{std::move(events)} {}

    void start(WsUrl url) {
        asio::co_spawn(socket_.get_executor(), serve(this->shared_from_this(), std::move(url)),
                       asio::detached);
    }
    void send(std::string bytes) override {
        if (leaving_) return;
        waiting_.push_back(std::move(bytes));
        flush();
    }
    void close() override {
        if (std::exchange(leaving_, true)) return;
        if (!writing_) asio::co_spawn(socket_.get_executor(), leave(), asio::detached);
    }

private:
    asio::awaitable<void> serve(std::shared_ptr<Socket> self, WsUrl url) {
        std::string why = co_await open(url);
        if (why.empty() && leaving_) co_await leave();
        if (why.empty() && !leaving_) {
            open_ = true;
            events_.opened();
            flush();
            why = co_await readAll();
        }
        open_ = false;
        loop_.at(Clock::now(), [self, why] { self->events_.closed(self->leaving_ ? "" : why); });
    }

    asio::awaitable<std::string> open(const WsUrl& url) {
        Stream& stream = beast::get_lowest_layer(socket_);
        asio::ip::tcp::resolver resolver{socket_.get_executor()};
        const auto [unknown, found] =
            co_await resolver.async_resolve(url.host, std::to_string(url.port), kAsTuple);
        if (unknown) co_return url.host + ": " + unknown.message();
        stream.expires_after(kConnectWithin);
        if (const auto refused = co_await connect(*found.begin())) {
            co_return "cannot connect: " + refused.message();
        }
        boost::system::error_code ignored;
        stream.socket().set_option(Tcp::no_delay{true}, ignored);
        if constexpr (std::is_same_v<Layer, TlsStream>) {
            auto& tls = socket_.next_layer();
            ::SSL_set_tlsext_host_name(tls.native_handle(), url.host.c_str());
            tls.set_verify_callback(asio::ssl::host_name_verification{url.host});
            const auto [untrusted] =
                co_await tls.async_handshake(asio::ssl::stream_base::client, kAsTuple);
            if (untrusted) co_return "TLS: " + untrusted.message();
        }
        stream.expires_never();
        socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::client));
        socket_.set_option(websocket::stream_base::decorator([](websocket::request_type& request) {
            request.set(http::field::sec_websocket_protocol, "volcast.v1");
            request.set(http::field::user_agent, "volcast-load");
        }));
        socket_.read_message_max(kMaxMessage);
        socket_.binary(true);
        const std::string host = url.host + ":" + std::to_string(url.port);
        websocket::response_type response;
        const auto [error] = co_await socket_.async_handshake(response, host, url.target, kAsTuple);
        if (error == websocket::error::upgrade_declined) {
            co_return "refused with HTTP " + std::to_string(response.result_int()) + ": " +
                response.body();
        }
        if (error) co_return "no WebSocket: " + error.message();
        co_return "";
    }

    asio::awaitable<boost::system::error_code> connect(Tcp::endpoint endpoint) {
        Stream& stream = beast::get_lowest_layer(socket_);
        if (shape_.bytesPerSecond > 0 || shape_.delay.count() > 0) {
            Stream server{stream.get_executor()};
            boost::system::error_code ignored;
            server.socket().open(endpoint.protocol(), ignored);
            keepLittle(server.socket(), shape_);
            server.expires_after(kConnectWithin);
            const auto [refused] = co_await server.async_connect(endpoint, kAsTuple);
            if (refused) co_return refused;
            endpoint = shapeLink(server.release_socket(), shape_);
        }
        const auto [refused] = co_await stream.async_connect(endpoint, kAsTuple);
        co_return refused;
    }

    asio::awaitable<std::string> readAll() {
        beast::flat_buffer buffer;
        while (true) {
            const auto [error, bytes] = co_await socket_.async_read(buffer, kAsTuple);
            if (error == websocket::error::closed) {
                co_return "closed by the server with code " +
                    std::to_string(socket_.reason().code) + " " + socket_.reason().reason.c_str();
            }
            if (error) co_return "connection lost: " + error.message();
            const auto data = buffer.cdata();
            const auto* begin = static_cast<const std::byte*>(data.data());
            if (!leaving_) events_.message({begin, data.size()});
            buffer.consume(buffer.size());
        }
    }

    void flush() {
        if (!open_ || writing_ || waiting_.empty()) return;
        writing_ = true;
        asio::co_spawn(socket_.get_executor(), writeAll(this->shared_from_this()), asio::detached);
    }
    asio::awaitable<void> writeAll(std::shared_ptr<Socket> /*alive*/) {
        while (!waiting_.empty() && !leaving_) {
            const std::string bytes = std::move(waiting_.front());
            waiting_.pop_front();
            const auto [error, sent] = co_await socket_.async_write(asio::buffer(bytes), kAsTuple);
            if (error) waiting_.clear();
        }
        writing_ = false;
        if (leaving_) co_await leave();
    }
    asio::awaitable<void> leave() {
        const auto self = this->shared_from_this();
        if (!socket_.is_open()) co_return;
        co_await socket_.async_close(websocket::close_code::normal, kAsTuple);
    }

    ClientLoop& loop_;
    websocket::stream<Layer> socket_;
    LinkShape shape_;
    ClientEvents events_;
    std::deque<std::string> waiting_;
    bool open_ = false;
    bool writing_ = false;
    bool leaving_ = false;
};

class BeastLoop final : public ClientLoop {
public:
    BeastLoop() {
        boost::system::error_code ignored;
        tls_.set_default_verify_paths(ignored);
        tls_.set_verify_mode(asio::ssl::verify_peer, ignored);
        signals_.async_wait([this](boost::system::error_code error, int) {
            if (!error) stop();
        });
    }
    Result<void> trust(const std::string& file) override {
        boost::system::error_code error;
        tls_.load_verify_file(file, error);
        if (error) return fail(ErrorCode::kIo, file + ": " + error.message());
        return {};
    }
    std::shared_ptr<ClientSocket> connect(const WsUrl& url, const LinkShape& shape,
                                          ClientEvents events) override {
        if (url.tls) {
            return started<TlsStream>(url, shape, std::move(events), tls_);
        }
        return started<Stream>(url, shape, std::move(events));
    }
    void at(Clock::time_point when, std::function<void()> act) override {
        auto timer = std::make_shared<asio::steady_timer>(strand_, when);
        timer->async_wait([timer, act = std::move(act)](boost::system::error_code error) {
            if (!error) act();
        });
    }
    void run() override { context_.run(); }
    void stop() override { context_.stop(); }

private:
    template <class Layer, class... Tls>
    std::shared_ptr<ClientSocket> started(const WsUrl& url, const LinkShape& shape,
                                          ClientEvents events, Tls&... tls) {
        auto socket =
            std::make_shared<Socket<Layer>>(*this, strand_, shape, std::move(events), tls...);
        socket->start(url);
        return socket;
    }

    asio::ssl::context tls_{asio::ssl::context::tls_client};
    asio::io_context context_{1};
    Strand strand_{asio::make_strand(context_)};
    asio::signal_set signals_{strand_, SIGINT, SIGTERM};
};

}  // namespace

std::unique_ptr<ClientLoop> ClientLoop::create() {
    return std::make_unique<BeastLoop>();
}

}  // namespace volcast::net
