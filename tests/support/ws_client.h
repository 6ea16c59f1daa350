#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace volcast::test {

/// One message as it came from the server.
struct WsMessage {
    bool text = false;
    std::vector<std::byte> bytes;
};

struct WsOptions {
    std::string target = "/v1/ws";
    std::string subprotocol = "volcast.v1";  ///< Empty: none is offered.
    std::string origin = {};                 ///< Empty: no Origin header.
    int receiveBuffer = 0;                   ///< SO_RCVBUF in bytes; 0: the system's choice.
};

/// A WebSocket client on 127.0.0.1 for tests; blocking, with a limit to every wait.
class WsClient {
public:
    /// Connects; `status` becomes the HTTP status where the upgrade was refused (null returned).
    static std::unique_ptr<WsClient> connect(std::uint16_t port, const WsOptions& options = {},
                                             unsigned* status = nullptr);
    virtual ~WsClient() = default;
    WsClient(const WsClient&) = delete;
    WsClient& operator=(const WsClient&) = delete;
    WsClient(WsClient&&) = delete;
    WsClient& operator=(WsClient&&) = delete;

    /// False where the connection is over.
    virtual bool sendText(const std::string& text) = 0;
    virtual bool sendBinary(std::span<const std::byte> bytes) = 0;
    /// The next message; nullopt after `limit`, or when the connection is over.
    virtual std::optional<WsMessage> receive(std::chrono::milliseconds limit) = 0;
    /// The server's close code once it has closed; 0 before, 1006 where it did without a word.
    [[nodiscard]] virtual std::uint16_t closeCode() const = 0;
    [[nodiscard]] virtual std::string subprotocol() const = 0;
    /// Resets the TCP connection in the middle of whatever happens.
    virtual void abort() = 0;

protected:
    WsClient() = default;
};

struct HttpReply {
    unsigned status = 0;                         ///< 0: no answer.
    std::map<std::string, std::string> headers;  ///< Names in lower case.
    std::string body;
};

/// Sends `request` as it is (with its blank line) to 127.0.0.1 and reads to the end.
HttpReply rawHttp(std::uint16_t port, const std::string& request);
/// `method target` with `headers` ("Name: value\r\n" each), on a connection of its own.
HttpReply http(std::uint16_t port, const std::string& target, const std::string& method = "GET",
               const std::string& headers = "");

}  // namespace volcast::test
