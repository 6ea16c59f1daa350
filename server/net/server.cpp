#include "server/net/server.h"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include <spdlog/spdlog.h>

#include "renderer/base/printable.h"
#include "server/net/client_places.h"
#include "server/net/http_answers.h"
#include "server/net/tls.h"
#include "server/net/upload_body.h"
#include "server/net/web_socket.h"
#include "server/session/views.h"

namespace volcast::net {

namespace {

constexpr std::chrono::seconds kHeaderWithin{5};
constexpr std::chrono::seconds kKeepAlive{15};
constexpr std::chrono::seconds kTlsEndWithin{2};
constexpr std::chrono::milliseconds kDrainWithin{5000};
constexpr std::chrono::milliseconds kPlainDrain{100};  ///< For answers being sent.
constexpr std::chrono::seconds kTidyEach{2};
constexpr std::uint32_t kHeaderLimit = 8192;
constexpr unsigned kPlainConnections = 64;  ///< Besides WebSockets.

bool offersSubprotocol(const Request& request) {
    http::token_list offered{request[http::field::sec_websocket_protocol]};
    return offered.exists(kSubprotocol);
}

std::string urlOf(const std::string& host, std::uint16_t port, bool tls) {
    const bool ipv6 = host.find(':') != std::string::npos;
    return (tls ? "https://" : "http://") + (ipv6 ? "[" + host + "]" : host) + ":" +
           std::to_string(port) + "/";
}

class BeastServer final : public Server {
public:
    BeastServer(ListenSettings settings, session::Shared& shared)
        : settings_{std::move(settings)},
          shared_{shared},
          files_{settings_.clientFolder},
          answers_{files_, shared_, settings_.metricsFor},
          uploads_{shared_, origins_},
          places_{settings_.maxClients,
                  settings_.maxClientsPerAddress.value_or(std::max(1U, settings_.maxClients / 2))} {
    }

    Result<void> listen();
    [[nodiscard]] std::string url() const override {
        return urlOf(settings_.host, acceptor_.local_endpoint().port(), tls_ != nullptr);
    }
    void run() override;

private:
    asio::awaitable<void> acceptAll();
    asio::awaitable<void> serveTls(Stream stream);
    template <class Layer>
    asio::awaitable<void> serve(Layer stream);
    /// Answers a request for uploads; false where the connection is to end.
    template <class Layer>
    asio::awaitable<bool> serveUpload(Layer& stream, beast::flat_buffer& buffer,
                                      http::request_parser<http::empty_body>& head);
    template <class Layer>
    asio::awaitable<void> serveWebSocket(Layer stream, Request request, asio::ip::address peer);
    [[nodiscard]] std::optional<Response> refusal(const Request& request) const;
    /// Takes a place for one of `peer`, to be given back; what to answer where there is none.
    std::optional<Response> takePlace(const Request& request, const asio::ip::address& peer);
    /// Registers it, to be drained; one that came after the signal is drained now.
    template <class Layer>
    std::shared_ptr<WebSocket> enter(Layer stream, std::uint64_t& number);
    void onSignal();
    void stopWithin(std::chrono::milliseconds limit);
    void tidyLater();

    ListenSettings settings_;
    session::Shared& shared_;
    StaticFiles files_;
    HttpAnswers answers_;
    OriginRule origins_;
    UploadAnswers uploads_;
    asio::io_context context_;
    Strand control_{asio::make_strand(context_)};  ///< Of the five below.
    asio::basic_socket_acceptor<Tcp, Strand> acceptor_{control_};
    asio::signal_set signals_{control_};
    asio::steady_timer drained_{control_};
    asio::steady_timer pause_{control_};
    asio::steady_timer tidy_{control_};
    std::unique_ptr<asio::ssl::context> tls_;  ///< None: plain TCP.
    std::atomic<unsigned> connections_ = 0;
    std::atomic<bool> draining_ = false;
    std::mutex mutex_;
    ClientPlaces places_;
    std::uint64_t lastNumber_ = 0;
    std::map<std::uint64_t, std::weak_ptr<WebSocket>> sockets_;
};

Result<void> BeastServer::listen() {
    const auto failed = [this](const std::string& why) {
        return fail(ErrorCode::kIo,
                    urlOf(settings_.host, settings_.port, tls_ != nullptr) + ": " + why);
    };
    if (!settings_.tlsCert.empty() || !settings_.tlsKey.empty()) {
        auto made = tlsContext(settings_.tlsCert, settings_.tlsKey);
        if (!made) return made.error();
        tls_ = std::move(*made);
    }
    boost::system::error_code error;
    const std::string host = settings_.host == "localhost" ? "127.0.0.1" : settings_.host;
    const auto address = asio::ip::make_address(host, error);
    if (error) {
        return fail(ErrorCode::kInvalidArgument,
                    "--host " + settings_.host + ": not an address of this machine");
    }
    const Tcp::endpoint endpoint{address, settings_.port};
    acceptor_.open(endpoint.protocol(), error);
    if (error) return failed(error.message());
    acceptor_.set_option(asio::socket_base::reuse_address{true}, error);
    acceptor_.bind(endpoint, error);
    if (error) return failed("cannot listen: " + error.message());
    acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (error) return failed("cannot listen: " + error.message());
    origins_ = {.allowed = settings_.allowedOrigins, .loopbackOnly = address.is_loopback()};
    return boost::system::in_place_value;
}

void BeastServer::run() {
    signals_.add(SIGINT);
    signals_.add(SIGTERM);
    signals_.async_wait([this](boost::system::error_code error, int) {
        if (!error) onSignal();
    });
    asio::co_spawn(control_, acceptAll(), asio::detached);
    tidyLater();
    std::vector<std::thread> threads;
    for (unsigned i = 1; i < settings_.threads; ++i) {
        threads.emplace_back([this] { context_.run(); });
    }
    context_.run();
    for (std::thread& thread : threads) thread.join();
    // Sessions go now, while what they share exists; the sockets go with the context.
    for (const auto& [number, weak] : sockets_) {
        if (const auto socket = weak.lock()) socket->abandon();
    }
}

void BeastServer::onSignal() {
    signals_.async_wait([](boost::system::error_code error, int signal) {
        if (!error) std::_Exit(128 + signal);
    });
    boost::system::error_code ignored;
    acceptor_.close(ignored);
    const std::lock_guard lock{mutex_};
    draining_ = true;
    spdlog::info("event=draining clients={}", places_.taken());
    for (const auto& [number, weak] : sockets_) {
        if (const auto socket = weak.lock()) socket->drain();
    }
    stopWithin(places_.taken() == 0 ? kPlainDrain : kDrainWithin);
}

void BeastServer::stopWithin(std::chrono::milliseconds limit) {
    drained_.expires_after(limit);
    drained_.async_wait([this](boost::system::error_code error) {
        if (!error) context_.stop();
    });
}

/// Views that nobody comes back to end, though nobody else comes either.
void BeastServer::tidyLater() {
    tidy_.expires_after(kTidyEach);
    tidy_.async_wait([this](boost::system::error_code error) {
        if (error) return;
        shared_.views.tidy();
        tidyLater();
    });
}

asio::awaitable<void> BeastServer::acceptAll() {
    while (!draining_) {
        auto [error, socket] =
            co_await acceptor_.async_accept(asio::make_strand(context_), kAsTuple);
        if (error) {
            if (draining_) co_return;
            spdlog::warn(R"(event=accept_failed error="{}")", error.message());
            // Out of descriptors, most likely: wait for some to come back.
            pause_.expires_after(std::chrono::milliseconds{100});
            co_await pause_.async_wait(kAsTuple);
            continue;
        }
        if (connections_ >= settings_.maxClients + kPlainConnections) continue;
        ++connections_;
        const Strand strand = socket.get_executor();
        Stream stream{std::move(socket)};
        asio::co_spawn(strand, tls_ ? serveTls(std::move(stream)) : serve(std::move(stream)),
                       [this](const std::exception_ptr& thrown) {
                           if (thrown) spdlog::error("event=connection_threw");
                           --connections_;
                       });
    }
}

asio::awaitable<void> BeastServer::serveTls(Stream stream) {
    TlsStream tls{std::move(stream), *tls_};
    beast::get_lowest_layer(tls).expires_after(kHeaderWithin);
    const auto [error] = co_await tls.async_handshake(asio::ssl::stream_base::server, kAsTuple);
    if (error) {
        spdlog::debug(R"(event=tls_refused error="{}")", error.message());
        co_return;
    }
    co_await serve(std::move(tls));
}

template <class Layer>
asio::awaitable<void> BeastServer::serve(Layer stream) {
    beast::flat_buffer buffer;
    std::chrono::seconds patience = kHeaderWithin;
    boost::system::error_code unknown;
    const auto peer = beast::get_lowest_layer(stream).socket().remote_endpoint(unknown).address();
    const bool fromLoopback = !unknown && peer.is_loopback();
    while (true) {
        http::request_parser<http::empty_body> parser;
        parser.header_limit(kHeaderLimit);
        parser.body_limit(boost::none);  // No body is read here; uploads have limits of their own.
        beast::get_lowest_layer(stream).expires_after(patience);
        const auto [error, bytes] =
            co_await http::async_read_header(stream, buffer, parser, kAsTuple);
        if (error == http::error::header_limit) {
            Response tooLarge =
                HttpAnswers::plain(parser.get(), http::status::request_header_fields_too_large,
                                   "headers above " + std::to_string(kHeaderLimit) + " bytes");
            tooLarge.keep_alive(false);
            co_await http::async_write(stream, tooLarge, kAsTuple);
        }
        if (error) break;
        if (UploadAnswers::concerns(parser.get())) {
            if (!co_await serveUpload(stream, buffer, parser)) break;
            patience = kKeepAlive;
            continue;
        }
        Request request = parser.release();
        const bool upgrade = websocket::is_upgrade(request);
        auto refused = upgrade ? refusal(request) : std::nullopt;
        if (upgrade && !refused) refused = takePlace(request, peer);
        if (upgrade && !refused) {
            co_await serveWebSocket(std::move(stream), std::move(request), peer);
            co_return;
        }
        Response response = refused ? std::move(*refused) : answers_.answer(request, fromLoopback);
        const bool more = !draining_ && response.keep_alive() && !parser.chunked() &&
                          request[http::field::content_length].empty();
        response.keep_alive(more);
        const auto [failed, sent] = co_await http::async_write(stream, response, kAsTuple);
        if (failed || !more) break;
        patience = kKeepAlive;
    }
    if constexpr (std::is_same_v<Layer, TlsStream>) {
        beast::get_lowest_layer(stream).expires_after(kTlsEndWithin);
        co_await stream.async_shutdown(kAsTuple);
    }
    boost::system::error_code ignored;
    beast::get_lowest_layer(stream).socket().shutdown(Tcp::socket::shutdown_both, ignored);
}

template <class Layer>
asio::awaitable<bool> BeastServer::serveUpload(Layer& stream, beast::flat_buffer& buffer,
                                               http::request_parser<http::empty_body>& head) {
    const Request request = head.get();
    const bool hasBody = head.chunked() || head.content_length().value_or(0) > 0;
    auto refused = uploads_.refusal(request);
    bool bodyRead = !hasBody;
    Response response;
    if (refused) {
        response = std::move(*refused);
    } else if (UploadAnswers::isFile(request)) {
        UploadParser parser{std::move(head)};
        parser.body_limit(boost::none);  // The folder has limits, and says which was met.
        response = co_await receiveUpload(stream, buffer, parser, request, uploads_.folder());
        bodyRead = parser.is_done();
    } else {
        response = uploads_.answer(request);
    }
    response.keep_alive(request.keep_alive() && bodyRead);
    if (request.method() == http::verb::head) response.body().clear();  // Its length stays.
    beast::get_lowest_layer(stream).expires_after(kKeepAlive);
    const auto [failed, sent] = co_await http::async_write(stream, response, kAsTuple);
    if (!failed && !bodyRead) co_await linger(stream);
    co_return !failed && response.keep_alive();
}

std::optional<Response> BeastServer::refusal(const Request& request) const {
    if (draining_) {  // The connection may be older than the signal.
        return HttpAnswers::plain(request, http::status::service_unavailable,
                                  "this server is going down; try again later");
    }
    const std::string_view target = request.target();
    if (target.substr(0, target.find('?')) != "/v1/ws") {
        return HttpAnswers::plain(request, http::status::not_found, "the WebSocket is at /v1/ws");
    }
    const std::string_view origin = request[http::field::origin];
    if (!originAllowed(origin, request[http::field::host], origins_)) {
        spdlog::warn(R"(event=origin_refused origin="{}")", base::printable(origin));
        return HttpAnswers::plain(request, http::status::forbidden,
                                  "pages of this origin may not connect; the server's "
                                  "--allow-origin lists those that may");
    }
    if (!offersSubprotocol(request)) {
        return HttpAnswers::plain(request, http::status::bad_request,
                                  std::string{"the WebSocket subprotocol must be "} + kSubprotocol);
    }
    return std::nullopt;
}

std::optional<Response> BeastServer::takePlace(const Request& request,
                                               const asio::ip::address& peer) {
    const std::lock_guard lock{mutex_};
    auto full = places_.take(peer);
    if (!full) return std::nullopt;
    spdlog::warn(R"(event=client_refused peer={} reason="{}")", peer.to_string(), *full);
    return HttpAnswers::plain(request, http::status::service_unavailable, *std::move(full));
}

template <class Layer>
std::shared_ptr<WebSocket> BeastServer::enter(Layer stream, std::uint64_t& number) {
    const std::lock_guard lock{mutex_};
    number = ++lastNumber_;
    auto socket = makeWebSocket(std::move(stream), shared_,
                                {.number = number, .writePatience = settings_.writePatience});
    sockets_[number] = socket;
    if (draining_) socket->drain();
    return socket;
}

template <class Layer>
asio::awaitable<void> BeastServer::serveWebSocket(Layer stream, Request request,
                                                  asio::ip::address peer) {
    std::uint64_t number = 0;
    const auto socket = enter(std::move(stream), number);
    spdlog::info("event=connected connection={}", number);
    shared_.metrics.connected();
    co_await socket->serve(request);
    shared_.metrics.disconnected();
    const std::lock_guard lock{mutex_};
    sockets_.erase(number);
    places_.giveBack(peer);
    if (places_.taken() == 0 && draining_) {
        asio::post(control_, [this] { stopWithin(kPlainDrain); });
    }
}

}  // namespace

Result<std::unique_ptr<Server>> Server::create(ListenSettings settings, session::Shared& shared) {
    auto server = std::make_unique<BeastServer>(std::move(settings), shared);
    if (const auto listening = server->listen(); !listening) return listening.error();
    return std::unique_ptr<Server>{std::move(server)};
}

}  // namespace volcast::net
