#include "tests/support/slow_link.h"

#include <arpa/inet.h>
#include <array>
#include <atomic>
#include <chrono>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace volcast::test {

namespace {

constexpr std::size_t kPiece = 4096;
constexpr int kBuffered = 16 * 1024;

class Socket {
public:
    Socket() = default;
    explicit Socket(int fd) : fd_{fd} {}
    Socket(const Socket&) = delete;
    Socket& operator=(const Socket&) = delete;
    Socket(Socket&& other) noexcept : fd_{std::exchange(other.fd_, -1)} {}
    Socket& operator=(Socket&& other) noexcept {
        std::swap(fd_, other.fd_);
        return *this;
    }
    ~Socket() {
        if (fd_ >= 0) ::close(fd_);
    }
    [[nodiscard]] int fd() const noexcept { return fd_; }

private:
    int fd_ = -1;
};

sockaddr_in loopback(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port);
    return address;
}

bool writeAll(int fd, const char* bytes, std::size_t size) {
    while (size > 0) {
        const ssize_t written = ::send(fd, bytes, size, MSG_NOSIGNAL);
        if (written <= 0) return false;
        bytes += written;
        size -= static_cast<std::size_t>(written);
    }
    return true;
}

class SlowLinkImpl final : public SlowLink {
public:
    SlowLinkImpl(Socket listener, std::uint16_t port, std::uint16_t server, double bytesPerS)
        : listener_{std::move(listener)}, port_{port}, server_{server}, bytesPerS_{bytesPerS} {
        thread_ = std::thread{[this] { carry(); }};
    }
    SlowLinkImpl(const SlowLinkImpl&) = delete;
    SlowLinkImpl& operator=(const SlowLinkImpl&) = delete;
    SlowLinkImpl(SlowLinkImpl&&) = delete;
    SlowLinkImpl& operator=(SlowLinkImpl&&) = delete;
    ~SlowLinkImpl() override {
        ended_ = true;
        thread_.join();
    }
    [[nodiscard]] std::uint16_t port() const override { return port_; }
    void widen() override { bytesPerS_ = 1e12; }

private:
    /// True where there is something to read; false when the object ends.
    bool waitFor(pollfd* sockets, nfds_t count) const {
        while (!ended_) {
            if (::poll(sockets, count, 50) > 0) return true;
        }
        return false;
    }

    void carry() {
        pollfd coming{.fd = listener_.fd(), .events = POLLIN, .revents = 0};
        if (!waitFor(&coming, 1)) return;
        const Socket client{::accept(listener_.fd(), nullptr, nullptr)};
        const Socket server{::socket(AF_INET, SOCK_STREAM, 0)};
        ::setsockopt(server.fd(), SOL_SOCKET, SO_RCVBUF, &kBuffered, sizeof kBuffered);
        ::setsockopt(client.fd(), SOL_SOCKET, SO_SNDBUF, &kBuffered, sizeof kBuffered);
        const int yes = 1;
        ::setsockopt(client.fd(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
        ::setsockopt(server.fd(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
        const sockaddr_in address = loopback(server_);
        if (::connect(server.fd(), reinterpret_cast<const sockaddr*>(&address), sizeof address) !=
            0) {
            return;
        }
        // A thread for each direction: the slow one must not hold up acks.
        std::thread up{[&] { copy(client.fd(), server.fd(), false); }};
        copy(server.fd(), client.fd(), true);
        up.join();
    }

    void copy(int from, int to, bool slowly) {
        std::array<char, kPiece> piece{};
        pollfd ready{.fd = from, .events = POLLIN, .revents = 0};
        while (waitFor(&ready, 1)) {
            const ssize_t size = ::recv(from, piece.data(), piece.size(), 0);
            if (size <= 0 || !writeAll(to, piece.data(), static_cast<std::size_t>(size))) break;
            if (!slowly) continue;
            std::this_thread::sleep_for(
                std::chrono::duration<double>{static_cast<double>(size) / bytesPerS_});
        }
        ::shutdown(to, SHUT_WR);
        ended_ = true;
    }

    Socket listener_;
    const std::uint16_t port_, server_;
    std::atomic<double> bytesPerS_;
    std::atomic<bool> ended_{false};
    std::thread thread_;
};

}  // namespace

std::unique_ptr<SlowLink> SlowLink::create(std::uint16_t serverPort, double bytesPerS) {
    Socket listener{::socket(AF_INET, SOCK_STREAM, 0)};
    sockaddr_in address = loopback(0);
    socklen_t size = sizeof address;
    auto* raw = reinterpret_cast<sockaddr*>(&address);
    if (::bind(listener.fd(), raw, size) != 0 || ::listen(listener.fd(), 1) != 0 ||
        ::getsockname(listener.fd(), raw, &size) != 0) {
        return nullptr;
    }
    const std::uint16_t port = ntohs(address.sin_port);
    return std::make_unique<SlowLinkImpl>(std::move(listener), port, serverPort, bytesPerS);
}

}  // namespace volcast::test
