#include "tests/e2e/server/raw_socket.h"

#include <arpa/inet.h>
#include <array>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace volcast::test {

namespace {

constexpr int kPatienceMs = 60'000;
constexpr std::array<unsigned char, 4> kMask{0x37, 0xfa, 0x21, 0x3d};  ///< RFC 6455, section 5.7.

std::string bigEndian(std::uint64_t value, int bytes) {
    std::string text;
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) {
        text += static_cast<char>(value >> static_cast<unsigned>(shift) & 0xffU);
    }
    return text;
}

}  // namespace

unsigned RawFrame::closeCode() const {
    constexpr unsigned kNone = 1005;
    if (payload.size() < 2) return kNone;
    return static_cast<unsigned char>(payload[0]) * 256U + static_cast<unsigned char>(payload[1]);
}

std::string rawFrame(unsigned opcode, const std::string& payload, const FrameForm& form) {
    const std::uint64_t length = form.saysLength.value_or(payload.size());
    int extra = form.lengthBytes;
    if (extra < 0) extra = length < 126 ? 0 : length < 65536 ? 2 : 8;
    std::string frame;
    frame += static_cast<char>((form.fin ? 0x80U : 0U) | form.reserved << 4U | opcode);
    const std::uint64_t small = extra == 0 ? length : extra == 2 ? 126 : 127;
    frame += static_cast<char>((form.masked ? 0x80U : 0U) | small);
    if (extra > 0) frame += bigEndian(length, extra);
    if (!form.masked) return frame + payload;
    for (const unsigned char byte : kMask) frame += static_cast<char>(byte);
    for (std::size_t i = 0; i < payload.size(); ++i) {
        frame += static_cast<char>(static_cast<unsigned char>(payload[i]) ^ kMask[i % 4]);
    }
    return frame;
}

std::string closeFrame(unsigned code, const std::string& reason) {
    return rawFrame(kClose, bigEndian(code, 2) + reason);
}

RawSocket::RawSocket(std::uint16_t port, const std::string& at)
    : fd_{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)} {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    ::inet_pton(AF_INET, at.c_str(), &address.sin_addr);
    const int one = 1;
    ::setsockopt(fd_, IPPROTO_TCP, TCP_NODELAY, &one, sizeof(one));
    if (::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
        ::close(fd_);
        fd_ = -1;
    }
}

RawSocket::~RawSocket() {
    if (fd_ >= 0) ::close(fd_);
}

bool RawSocket::send(const std::string& bytes) const {
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t sent = ::send(fd_, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL);
        if (sent <= 0) return false;
        done += static_cast<std::size_t>(sent);
    }
    return true;
}

bool RawSocket::fill() {
    pollfd entry{.fd = fd_, .events = POLLIN, .revents = 0};
    if (::poll(&entry, 1, kPatienceMs) <= 0) return false;
    std::array<char, 65536> bytes{};
    const ssize_t size = ::recv(fd_, bytes.data(), bytes.size(), 0);
    if (size <= 0) return false;
    buffer_.append(bytes.data(), static_cast<std::size_t>(size));
    return true;
}

std::string RawSocket::upgradeAnswer(const std::string& moreHeaders) {
    send(
        "GET /v1/ws HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\n"
        "Connection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
        "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Protocol: volcast.v1\r\n" +
        moreHeaders + "\r\n");
    return readHead();
}

bool RawSocket::upgrade(const std::string& moreHeaders) {
    return upgradeAnswer(moreHeaders).starts_with("HTTP/1.1 101 ");
}

std::string RawSocket::readHead() {
    std::size_t end = buffer_.find("\r\n\r\n");
    while (end == std::string::npos) {
        if (!fill()) return {};
        end = buffer_.find("\r\n\r\n");
    }
    std::string head = buffer_.substr(0, end + 4);
    buffer_.erase(0, end + 4);
    return head;
}

std::optional<RawFrame> RawSocket::readFrame() {
    const auto byteAt = [this](std::size_t at) {
        return std::uint64_t{static_cast<unsigned char>(buffer_[at])};
    };
    const auto has = [this](std::size_t size) {
        while (buffer_.size() < size) {
            if (!fill()) return false;
        }
        return true;
    };
    if (!has(2)) return std::nullopt;
    std::uint64_t length = byteAt(1) & 0x7fU;
    const std::size_t extra = length == 126 ? 2 : length == 127 ? 8 : 0;
    if (!has(2 + extra)) return std::nullopt;
    if (extra > 0) length = 0;
    for (std::size_t i = 0; i < extra; ++i) length = length << 8U | byteAt(2 + i);
    if (!has(2 + extra + length)) return std::nullopt;
    RawFrame frame{.fin = (byteAt(0) & 0x80U) != 0,
                   .reserved = static_cast<unsigned>(byteAt(0) >> 4U & 7U),
                   .opcode = static_cast<unsigned>(byteAt(0) & 15U),
                   .payload = buffer_.substr(2 + extra, length)};
    buffer_.erase(0, 2 + extra + length);
    if (frame.opcode == kPing) return readFrame();
    return frame;
}

bool RawSocket::readToEnd() {
    while (fill()) buffer_.clear();
    pollfd entry{.fd = fd_, .events = POLLIN, .revents = 0};
    return ::poll(&entry, 1, 0) > 0;  // Readable without data: the end, not the patience's.
}

}  // namespace volcast::test
