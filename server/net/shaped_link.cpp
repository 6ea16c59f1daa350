#include "server/net/shaped_link.h"

#include <algorithm>
#include <deque>
#include <memory>
#include <utility>
#include <vector>

namespace volcast::net {

namespace {

using Clock = ClientLoop::Clock;

constexpr std::chrono::milliseconds kStep{20};  ///< A slow link takes so much at once.
constexpr std::size_t kLeastPiece = 512;
constexpr std::size_t kMostPiece = std::size_t{64} * 1024;

/// Both ends of a link; its three coroutines keep it alive.
class Link : public std::enable_shared_from_this<Link> {
public:
    Link(Socket server, const LinkShape& shape)
        : strand_{server.get_executor()},
          delay_{shape.delay},
          acceptor_{strand_, Tcp::endpoint{asio::ip::address_v4::loopback(), 0}},
          client_{strand_},
          server_{std::move(server)},
          down_{strand_, shape.bytesPerSecond},
          up_{strand_, 0} {}

    [[nodiscard]] Tcp::endpoint endpoint() const { return acceptor_.local_endpoint(); }
    void start() { asio::co_spawn(strand_, accept(shared_from_this()), asio::detached); }

private:
    struct Piece {
        std::vector<char> bytes;  ///< None: the end.
        Clock::time_point due;
    };
    struct Direction {
        Direction(const Strand& strand, double rate)
            : bytesPerSecond{rate}, carried{strand}, news{strand} {}

        double bytesPerSecond;
        Clock::time_point free{};  ///< When the link has carried what was read.
        std::deque<Piece> underWay;
        asio::steady_timer carried, news;
    };

    asio::awaitable<void> accept(std::shared_ptr<Link> self) {
        boost::system::error_code ignored;
        const auto [error] = co_await acceptor_.async_accept(client_, kAsTuple);
        acceptor_.close(ignored);
        if (error) co_return;
        client_.set_option(Tcp::no_delay{true}, ignored);
        server_.set_option(Tcp::no_delay{true}, ignored);
        asio::co_spawn(strand_, take(self, server_, down_), asio::detached);
        asio::co_spawn(strand_, give(self, server_, client_, down_), asio::detached);
        asio::co_spawn(strand_, take(self, client_, up_), asio::detached);
        co_await give(self, client_, server_, up_);
    }

    asio::awaitable<void> take(std::shared_ptr<Link> /*alive*/, Socket& from, Direction& way) {
        const double step = std::chrono::duration<double>{kStep}.count();
        const auto most = way.bytesPerSecond > 0
                              ? static_cast<std::size_t>(way.bytesPerSecond * step)
                              : kMostPiece;
        std::vector<char> bytes(std::clamp(most, kLeastPiece, kMostPiece));
        while (true) {
            const auto [error, size] = co_await from.async_read_some(asio::buffer(bytes), kAsTuple);
            if (way.bytesPerSecond > 0 && size > 0) {
                const std::chrono::duration<double> takes{static_cast<double>(size) /
                                                          way.bytesPerSecond};
                way.free = std::max(way.free, Clock::now()) +
                           std::chrono::duration_cast<Clock::duration>(takes);
                way.carried.expires_at(way.free);
                co_await way.carried.async_wait(kAsTuple);
            }
            const char* begin = bytes.data();
            way.underWay.push_back({{begin, begin + (error ? 0 : size)}, Clock::now() + delay_});
            way.news.cancel();
            if (error) co_return;
        }
    }

    asio::awaitable<void> give(std::shared_ptr<Link> /*alive*/, Socket& from, Socket& to,
                               Direction& way) {
        boost::system::error_code failed;
        while (!failed) {
            way.news.expires_at(way.underWay.empty() ? Clock::time_point::max()
                                                     : way.underWay.front().due);
            co_await way.news.async_wait(kAsTuple);
            if (way.underWay.empty() || way.underWay.front().due > Clock::now()) continue;
            const Piece piece = std::move(way.underWay.front());
            way.underWay.pop_front();
            if (piece.bytes.empty()) break;
            std::tie(failed, std::ignore) =
                co_await asio::async_write(to, asio::buffer(piece.bytes), kAsTuple);
        }
        boost::system::error_code ignored;
        to.shutdown(Tcp::socket::shutdown_send, ignored);
        if (failed) from.close(ignored);
    }

    Strand strand_;
    std::chrono::milliseconds delay_;
    asio::basic_socket_acceptor<Tcp, Strand> acceptor_;
    Socket client_, server_;
    Direction down_, up_;
};

}  // namespace

Tcp::endpoint shapeLink(Socket server, const LinkShape& shape) {
    const auto link = std::make_shared<Link>(std::move(server), shape);
    link->start();
    return link->endpoint();
}

void keepLittle(Socket& server, const LinkShape& shape) {
    boost::system::error_code ignored;
    if (shape.bytesPerSecond > 0) {
        server.set_option(asio::socket_base::receive_buffer_size{4096}, ignored);
    }
}

}  // namespace volcast::net
