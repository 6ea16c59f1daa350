#pragma once

// Reads the body of an upload into its file. A template over plain and TLS streams: for server.cpp
// alone.
#include <memory>
#include <vector>

#include "server/net/beast.h"
#include "server/net/uploads.h"

namespace volcast::net {

using UploadParser = http::request_parser<http::buffer_body>;

constexpr std::size_t kUploadChunk = std::size_t{64} * 1024;
constexpr std::chrono::seconds kLingerWithin{2};
constexpr std::size_t kLingerBytes = std::size_t{64} << 20U;

/// Cancels what a stream waits for unless it is fed again in time. Beast's own time limit would
/// close the socket, and nobody could be told why.
template <class Layer>
class Patience {
public:
    Patience(Layer& stream, std::chrono::seconds limit)
        : state_{std::make_shared<State>(stream)}, limit_{limit} {
        beast::get_lowest_layer(stream).expires_never();
    }
    Patience(const Patience&) = delete;
    Patience& operator=(const Patience&) = delete;
    Patience(Patience&&) = delete;
    Patience& operator=(Patience&&) = delete;
    ~Patience() {  // NOLINT(bugprone-exception-escape): a timer that cannot be cancelled is a bug
        state_->stream = nullptr;
        state_->timer.cancel();
    }
    void feed() {
        state_->timer.expires_after(limit_);
        state_->timer.async_wait([state = state_](boost::system::error_code error) {
            if (error || state->stream == nullptr) return;
            state->late = true;
            beast::get_lowest_layer(*state->stream).cancel();
        });
    }
    [[nodiscard]] bool late() const { return state_->late; }

private:
    struct State {
        explicit State(Layer& of) : stream{&of}, timer{of.get_executor()} {}
        Layer* stream;  ///< Null: nobody waits any more.
        asio::steady_timer timer;
        bool late = false;
    };
    std::shared_ptr<State> state_;
    std::chrono::seconds limit_;
};

/// Reads what the client still sends for a while: closing with unread bytes would reset the
/// connection before the client has read why it was refused.
template <class Layer>
asio::awaitable<void> linger(Layer& stream) {
    auto& lowest = beast::get_lowest_layer(stream);
    lowest.expires_after(kLingerWithin);
    boost::system::error_code ignored;
    if constexpr (std::is_same_v<Layer, Stream>) {
        lowest.socket().shutdown(Tcp::socket::shutdown_send, ignored);
    }
    std::vector<char> sink(kUploadChunk);
    for (std::size_t all = 0; all < kLingerBytes;) {
        const auto [error, bytes] = co_await lowest.async_read_some(asio::buffer(sink), kAsTuple);
        if (error) break;
        all += bytes;
    }
}

/// The answer; where it is no 201 the body may not have been read to its end.
template <class Layer>
asio::awaitable<Response> receiveUpload(Layer& stream, beast::flat_buffer& buffer,
                                        UploadParser& parser, const Request& request,
                                        session::UploadFolder& folder) {
    const auto target = uploadTargetOf(request.target());
    std::optional<std::uint64_t> announced;
    if (const auto length = parser.content_length()) announced = *length;
    auto file = folder.begin(target->token, target->file, announced);
    if (!file) co_return UploadAnswers::refused(request, file.error());
    Patience<Layer> patience{stream, folder.limits().patience};
    if (beast::iequals(request[http::field::expect], "100-continue")) {
        const http::response<http::empty_body> goOn{http::status::continue_, request.version()};
        co_await http::async_write(stream, goOn, kAsTuple);
    }
    std::vector<std::byte> chunk(kUploadChunk);
    while (!parser.is_done()) {
        patience
            .feed();  // A chunk within the limit: who is slower than that holds a place for long.
        parser.get().body().data = chunk.data();
        parser.get().body().size = chunk.size();
        const auto [error, bytes] = co_await http::async_read(stream, buffer, parser, kAsTuple);
        if (error && error != http::error::need_buffer) {
            co_return UploadAnswers::cutShort(request, patience.late(), (*file)->bytes(),
                                              folder.limits());
        }
        const std::size_t got = chunk.size() - parser.get().body().size;
        const auto written = (*file)->write({chunk.data(), got});
        if (!written) co_return UploadAnswers::refused(request, written.error());
    }
    if (const auto finished = (*file)->finish(); !finished) {
        co_return UploadAnswers::refused(request, finished.error());
    }
    co_return UploadAnswers::received(request, (*file)->bytes());
}

}  // namespace volcast::net
