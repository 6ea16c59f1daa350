// RFC 6455 over a raw TCP socket against the real server.
#include <gmock/gmock.h>

#include "tests/e2e/server/raw_frames_cases.h"
#include "tests/e2e/server/raw_socket.h"
#include "tests/e2e/server/shared_server.h"

namespace volcast::test {
namespace {

using testing::HasSubstr;

/// Reads a message that may be in fragments; control frames are handed out alone.
std::optional<RawFrame> readMessage(RawSocket& socket) {
    auto frame = socket.readFrame();
    while (frame && !frame->fin) {
        const auto more = socket.readFrame();
        if (!more) return std::nullopt;
        frame->payload += more->payload;
        frame->fin = more->fin;
    }
    return frame;
}

class RawFrames : public SharedServer {
protected:
    static void play(const RawCase& one) {
        SCOPED_TRACE(one.name);
        RawSocket socket{port()};
        ASSERT_TRUE(socket.upgrade());
        ASSERT_TRUE(socket.send(rawFrame(kText, R"({"hello":{"major":1,"client":"raw"}})")));
        ASSERT_THAT(readMessage(socket)->payload, HasSubstr("\"welcome\""));
        ASSERT_THAT(readMessage(socket)->payload, HasSubstr("\"datasetList\""));
        for (const std::string& bytes : one.sends) socket.send(bytes);
        if (one.then == RawCase::Then::kClosed) return expectClosed(socket, one.code);
        if (one.then != RawCase::Then::kAlive) {
            const auto answer = readMessage(socket);
            ASSERT_TRUE(answer.has_value());
            const bool pong = one.then == RawCase::Then::kPong;
            EXPECT_EQ(answer->opcode, pong ? kPong : kText);
            EXPECT_EQ(answer->reserved, 0U);
            if (pong) {
                EXPECT_EQ(answer->payload, one.answer);
            } else {
                EXPECT_THAT(answer->payload, HasSubstr(one.answer));
            }
        }
        socket.send(rawFrame(kPing, "still there"));
        const auto pong = readMessage(socket);
        ASSERT_TRUE(pong.has_value());
        EXPECT_EQ(pong->opcode, kPong);
        EXPECT_EQ(pong->payload, "still there");
    }

    static void expectClosed(RawSocket& socket, unsigned code) {
        const auto close = socket.readFrame();
        ASSERT_TRUE(close.has_value());
        EXPECT_EQ(close->opcode, kClose);
        EXPECT_EQ(close->closeCode(), code);
        EXPECT_LE(close->payload.size(), 125U);
        EXPECT_TRUE(socket.readToEnd());
    }
    static void playAll(const std::vector<RawCase>& cases) {
        for (const RawCase& one : cases) play(one);
        EXPECT_TRUE(readiness().at("ready").as_bool());
    }
};

TEST_F(RawFrames, Lengths) {
    playAll(lengthCases());
}
TEST_F(RawFrames, Fragments) {
    playAll(fragmentCases());
}
TEST_F(RawFrames, ControlFrames) {
    playAll(controlCases());
}
TEST_F(RawFrames, ReservedBitsOpcodesAndMasks) {
    playAll(headerBitCases());
}
TEST_F(RawFrames, Text) {
    playAll(textCases());
}
TEST_F(RawFrames, Closing) {
    playAll(closeCases());
}

TEST(RawFramesCases, AreAHundredAtLeast) {
    const std::size_t all = lengthCases().size() + fragmentCases().size() + controlCases().size() +
                            headerBitCases().size() + textCases().size() + closeCases().size();
    EXPECT_GE(all, 100U);
}

/// An opening handshake, and the status that must follow; 0: the connection ends without one.
struct Handshake {
    const char* name;
    std::string request;
    unsigned status;
};

std::string request(const std::vector<std::string>& headers,
                    const std::string& line = "GET /v1/ws HTTP/1.1") {
    std::string text = line + "\r\n";
    for (const std::string& header : headers) text += header + "\r\n";
    return text + "\r\n";
}

TEST_F(RawFrames, HandshakesThatAreWrongAreRefused) {
    const std::string host = "Host: 127.0.0.1", upgrade = "Upgrade: websocket",
                      connection = "Connection: Upgrade",
                      key = "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==",
                      version = "Sec-WebSocket-Version: 13",
                      protocol = "Sec-WebSocket-Protocol: volcast.v1";
    const std::vector<Handshake> rows{
        {"all right", request({host, upgrade, connection, key, version, protocol}), 101},
        {"names in capitals",
         request({"HOST: 127.0.0.1", "UPGRADE: WebSocket", "CONNECTION: keep-alive, Upgrade", key,
                  version, protocol}),
         101},
        {"compression offered",
         request({host, upgrade, connection, key, version, protocol,
                  "Sec-WebSocket-Extensions: permessage-deflate; client_max_window_bits"}),
         101},
        {"no host", request({upgrade, connection, key, version, protocol}), 400},
        {"no upgrade", request({host, connection, key, version, protocol}), 426},
        {"another upgrade", request({host, "Upgrade: h2c", connection, key, version, protocol}),
         426},
        {"no connection header", request({host, upgrade, key, version, protocol}), 426},
        {"no key", request({host, upgrade, connection, version, protocol}), 400},
        {"a key that is too long",
         request({host, upgrade, connection, key + std::string(64, 'A'), version, protocol}), 400},
        {"no version", request({host, upgrade, connection, key, protocol}), 400},
        {"version 8",
         request({host, upgrade, connection, key, "Sec-WebSocket-Version: 8", protocol}), 426},
        {"no subprotocol", request({host, upgrade, connection, key, version}), 400},
        {"another subprotocol",
         request({host, upgrade, connection, key, version, "Sec-WebSocket-Protocol: volcast.v2"}),
         400},
        {"HTTP/1.0",
         request({host, upgrade, connection, key, version, protocol}, "GET /v1/ws HTTP/1.0"), 426},
        {"POST",
         request({host, upgrade, connection, key, version, protocol}, "POST /v1/ws HTTP/1.1"), 405},
        {"another path",
         request({host, upgrade, connection, key, version, protocol}, "GET /ws HTTP/1.1"), 404},
        {"another origin",
         request(
             {host, upgrade, connection, key, version, protocol, "Origin: http://evil.example"}),
         403},
        {"a null origin",
         request({host, upgrade, connection, key, version, protocol, "Origin: null"}), 403},
        {"a name that was rebound",
         request({"Host: evil.example", upgrade, connection, key, version, protocol,
                  "Origin: http://evil.example"}),
         403},
        {"headers above the limit",
         request(
             {host, upgrade, connection, key, version, protocol, "X: " + std::string(9000, 'x')}),
         431},
        {"a line without a colon", request({host, "nonsense"}), 0},
        {"a bad method", "G\x01T /v1/ws HTTP/1.1\r\n\r\n", 0},
        {"a version that is none", request({host}, "GET / HTTP/9.x"), 0},
        {"TLS to a plain port", std::string{"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11}, 0},
    };
    for (const Handshake& row : rows) {
        SCOPED_TRACE(row.name);
        RawSocket socket{port()};
        ASSERT_TRUE(socket.send(row.request));
        const std::string head = socket.readHead();
        if (row.status == 0) {
            EXPECT_EQ(head, "");
            continue;
        }
        ASSERT_THAT(head, HasSubstr("HTTP/1.")) << head;
        EXPECT_EQ(std::stoul(head.substr(9, 3)), row.status) << head;
        EXPECT_THAT(head, testing::Not(HasSubstr("Sec-WebSocket-Extensions")));
        if (row.status != 101) continue;
        EXPECT_THAT(head, HasSubstr("Sec-WebSocket-Accept: s3pPLMBiTxaQ9kYGzzhZRbK+xOo="));
        EXPECT_THAT(head, HasSubstr("Sec-WebSocket-Protocol: volcast.v1"));
    }
}

// The 5 s run for the whole header, however often a byte comes.
TEST_F(RawFrames, AHeaderThatDripsIsCutOff) {
    const RawSocket socket{port()};
    ASSERT_TRUE(socket.send("GET / HTTP/1.1\r\nX: "));
    EXPECT_TRUE(eventually([&] { return !socket.send("x"); }));
}

TEST_F(RawFrames, AHandshakeThatNeverEndsIsCutOff) {
    RawSocket socket{port()};
    ASSERT_TRUE(socket.send("GET /v1/ws HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: webso"));
    EXPECT_TRUE(socket.readToEnd());
}

}  // namespace
}  // namespace volcast::test
