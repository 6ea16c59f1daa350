#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace volcast::test {

/// One frame as it came, RFC 6455 section 5.2; servers do not mask.
struct RawFrame {
    bool fin = false;
    unsigned reserved = 0;  ///< The three bits, RSV1 the highest.
    unsigned opcode = 0;
    std::string payload;
    /// Of a close frame: its code; 1005 where it has none.
    [[nodiscard]] unsigned closeCode() const;
};

/// How a frame is written where it shall not be right.
struct FrameForm {
    bool fin = true;
    bool masked = true;
    unsigned reserved = 0;
    int lengthBytes = -1;  ///< 0, 2 or 8 behind the short length; -1: as few as it takes.
    std::optional<std::uint64_t> saysLength = {};  ///< In the place of the payload's.
};

enum Opcode : unsigned { kContinue = 0, kText = 1, kBinary = 2, kClose = 8, kPing = 9, kPong = 10 };

std::string rawFrame(unsigned opcode, const std::string& payload, const FrameForm& form = {});
/// A close frame of `code` and `reason`.
std::string closeFrame(unsigned code, const std::string& reason = "");

/// A TCP connection to this machine that writes what it is told; no WebSocket library between.
class RawSocket {
public:
    explicit RawSocket(std::uint16_t port, const std::string& address = "127.0.0.1");
    RawSocket(const RawSocket&) = delete;
    RawSocket& operator=(const RawSocket&) = delete;
    RawSocket(RawSocket&&) = delete;
    RawSocket& operator=(RawSocket&&) = delete;
    ~RawSocket();

    /// False where the connection is over.
    bool send(const std::string& bytes) const;
    /// Sends a valid opening handshake and reads the answer; true for 101.
    bool upgrade(const std::string& moreHeaders = "");
    /// The head of that answer.
    std::string upgradeAnswer(const std::string& moreHeaders = "");
    /// The answer's head of an HTTP request, up to its blank line; empty where the server closed.
    std::string readHead();
    /// The next frame but the pings that the server measures the way with; nullopt where the server
    /// closed, or after a minute.
    std::optional<RawFrame> readFrame();
    /// Waits for the end of the server's data; false where a minute was not enough.
    bool readToEnd();

private:
    bool fill();

    int fd_ = -1;
    std::string buffer_;
};

}  // namespace volcast::test
