#include "tests/support/ws_client.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>

namespace volcast::test {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using ErrorCode = boost::system::error_code;

constexpr std::chrono::seconds kHttpLimit{20};
constexpr std::uint16_t kAbnormal = 1006;

class BeastClient final : public WsClient {
public:
    bool open(std::uint16_t port, const WsOptions& options, unsigned* status) {
        ErrorCode error;
        auto& tcp = socket_.next_layer();
        tcp.open(Tcp::v4(), error);
        if (options.receiveBuffer > 0) {
            tcp.set_option(asio::socket_base::receive_buffer_size{options.receiveBuffer}, error);
        }
        tcp.connect({asio::ip::address_v4::loopback(), port}, error);
        if (error) return false;
        tcp.set_option(Tcp::no_delay{true}, error);
        socket_.set_option(websocket::stream_base::decorator([&](websocket::request_type& request) {
            if (!options.subprotocol.empty()) {
                request.set(beast::http::field::sec_websocket_protocol, options.subprotocol);
            }
            if (!options.origin.empty()) request.set(beast::http::field::origin, options.origin);
        }));
        socket_.read_message_max(std::size_t{1} << 30U);
        socket_.handshake(response_, "127.0.0.1:" + std::to_string(port), options.target, error);
        if (status != nullptr) *status = response_.result_int();
        return !error;
    }

    bool sendText(const std::string& text) override {
        return send(std::as_bytes(std::span{text}), true);
    }
    bool sendBinary(std::span<const std::byte> bytes) override { return send(bytes, false); }

    std::optional<WsMessage> receive(std::chrono::milliseconds limit) override {
        const auto until = std::chrono::steady_clock::now() + limit;
        if (over_) return std::nullopt;
        if (!reading_) startRead();
        while (reading_ && std::chrono::steady_clock::now() < until) {
            context_.restart();
            context_.run_one_until(until);
        }
        if (reading_ || over_) return std::nullopt;
        const auto data = buffer_.cdata();
        const auto* begin = static_cast<const std::byte*>(data.data());
        WsMessage message{.text = socket_.got_text(), .bytes = {begin, begin + data.size()}};
        buffer_.consume(buffer_.size());
        return message;
    }

    [[nodiscard]] std::uint16_t closeCode() const override {
        if (!over_) return 0;
        const auto code = static_cast<std::uint16_t>(socket_.reason().code);
        return code == 0 ? kAbnormal : code;
    }
    [[nodiscard]] std::string subprotocol() const override {
        return std::string{response_[beast::http::field::sec_websocket_protocol]};
    }
    void abort() override {
        ErrorCode ignored;
        socket_.next_layer().set_option(asio::socket_base::linger{true, 0}, ignored);
        socket_.next_layer().close(ignored);
        over_ = true;
    }

private:
    bool send(std::span<const std::byte> bytes, bool text) {
        ErrorCode error;
        socket_.text(text);
        socket_.write(asio::buffer(bytes.data(), bytes.size()), error);
        return !error;
    }
    void startRead() {
        reading_ = true;
        socket_.async_read(buffer_, [this](ErrorCode error, std::size_t) {
            reading_ = false;
            over_ = static_cast<bool>(error);
        });
    }

    asio::io_context context_;
    websocket::stream<Tcp::socket> socket_{context_};
    websocket::response_type response_;
    beast::flat_buffer buffer_;
    bool reading_ = false;
    bool over_ = false;
};

HttpReply parse(const std::string& text) {
    HttpReply reply;
    const auto blank = text.find("\r\n\r\n");
    if (blank == std::string::npos) return reply;
    std::istringstream head{text.substr(0, blank)};
    std::string version, line;
    head >> version >> reply.status;
    std::getline(head, line);
    while (std::getline(head, line)) {
        if (line.ends_with('\r')) line.pop_back();
        const auto colon = line.find(':');
        if (colon == std::string::npos) continue;
        std::string name = line.substr(0, colon);
        std::ranges::transform(name, name.begin(),
                               [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        const auto value = line.find_first_not_of(' ', colon + 1);
        reply.headers[name] = value == std::string::npos ? "" : line.substr(value);
    }
    reply.body = text.substr(blank + 4);
    return reply;
}

}  // namespace

std::unique_ptr<WsClient> WsClient::connect(std::uint16_t port, const WsOptions& options,
                                            unsigned* status) {
    auto client = std::make_unique<BeastClient>();
    if (!client->open(port, options, status)) return nullptr;
    return client;
}

HttpReply rawHttp(std::uint16_t port, const std::string& request) {
    asio::io_context context;
    Tcp::socket socket{context};
    ErrorCode error;
    socket.connect({asio::ip::address_v4::loopback(), port}, error);
    if (error) return {};
    asio::write(socket, asio::buffer(request), error);
    std::string text;
    bool done = false;
    asio::async_read(socket, asio::dynamic_buffer(text),
                     [&done](ErrorCode, std::size_t) { done = true; });
    context.run_for(kHttpLimit);
    socket.close(error);
    context.restart();
    context.run();  // Lets a read that ran into the limit end before `text` does.
    return parse(text);
}

HttpReply http(std::uint16_t port, const std::string& target, const std::string& method,
               const std::string& headers) {
    return rawHttp(port, method + " " + target + " HTTP/1.1\r\nHost: 127.0.0.1:" +
                             std::to_string(port) + "\r\nConnection: close\r\n" + headers + "\r\n");
}

}  // namespace volcast::test
