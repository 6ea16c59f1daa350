#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "protocol/framing.h"
#include "tests/e2e/server/server_process.h"
#include "tests/support/ws_client.h"
#include "volcast/v1/session.pb.h"

namespace volcast::test {

/// A frame taken apart; owns its bytes.
struct TestFrame {
    protocol::FramePrefix prefix;
    v1::FrameHeader header;
    std::vector<std::byte> payload;
};

/// A client that speaks the protocol: keeps what came until a test asks for it, and acks frames.
class TestClient {
public:
    enum class Form { kBinary, kJson };

    /// Connects and says hello; check ok(). `hello`: what it says besides its version.
    explicit TestClient(std::uint16_t port, Form form = Form::kBinary,
                        const WsOptions& options = {}, v1::Hello hello = {});

    [[nodiscard]] bool ok() const { return socket_ != nullptr; }
    [[nodiscard]] WsClient& socket() { return *socket_; }
    void send(const v1::ClientMessage& message);
    void sendJson(const std::string& json) { socket_->sendText(json); }
    void ack(const protocol::FramePrefix& frame);
    /// Whether frames are acked when they are read.
    void ackFrames(bool yes) { acking_ = yes; }

    /// The next message that `accept`s, those before it dropped; nullopt after kPatience.
    std::optional<v1::ServerMessage> waitFor(
        const std::function<bool(const v1::ServerMessage&)>& accept);
    std::optional<v1::Error> waitForError();
    std::optional<v1::ViewOpened> waitForOpened(std::uint32_t view = 1);
    std::optional<v1::Welcome> waitForWelcome();
    std::optional<v1::ViewStatus> waitForState(std::uint32_t view, v1::ViewState state);
    std::optional<v1::DatasetInfo> waitForDataset(const std::string& id, v1::DatasetState state);
    std::optional<TestFrame> waitForFrame(const std::function<bool(const TestFrame&)>& accept);
    std::optional<TestFrame> waitForFrame(std::uint32_t view, std::uint64_t inputSeq);
    std::optional<TestFrame> waitForLossless(std::uint32_t view, std::uint64_t inputSeq);

    void openView(std::uint32_t view, const std::string& dataset, std::uint32_t width = 64,
                  std::uint32_t height = 48, std::uint64_t inputSeq = 1);
    void join(const std::string& link, std::uint32_t view = 1, std::uint32_t width = 64,
              std::uint32_t height = 48);
    /// A link to `view`; empty where there is none.
    std::string share(std::uint32_t view, v1::Role role);
    /// Turns view's camera: `angle` in radians about `center`, 3 units away.
    void look(std::uint32_t view, std::uint64_t inputSeq, double angle);

    /// Reads one message where there is one within `limit`; false where there is none.
    bool read(std::chrono::milliseconds limit);
    std::vector<TestFrame> frames;  ///< Read and not yet asked for.
    std::vector<v1::ServerMessage> messages;

private:
    void take(const WsMessage& message);
    template <class Item>
    std::optional<Item> wait(std::vector<Item>& items,
                             const std::function<bool(const Item&)>& accept);

    std::unique_ptr<WsClient> socket_;
    Form form_;
    bool acking_ = true;
};

/// Width and height of a decoded picture and its RGB(A) bytes; empty where it does not decode.
struct Decoded {
    int width = 0, height = 0, channels = 0;
    std::vector<unsigned char> pixels;
};
Decoded decode(const TestFrame& frame);

/// Mean of |a - b| over the first three channels, in 1/255; 255 where sizes differ.
double meanDifference(const Decoded& a, const Decoded& b);

}  // namespace volcast::test
