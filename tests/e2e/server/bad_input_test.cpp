// Wrong, hostile and unlucky clients: each gets a clear answer, and nobody else notices.
#include <array>
#include <csignal>

#include <gmock/gmock.h>

#include "tests/e2e/server/shared_server.h"

namespace volcast::test {
namespace {

using testing::HasSubstr;

class BadInput : public SharedServer {
protected:
    /// The error to one JSON message after a hello, and that the client is still served.
    static v1::Error errorTo(const std::string& json) {
        const auto client = clientWithView(TestClient::Form::kJson);
        if (!client) return {};
        client->sendJson(json);
        const auto error = client->waitForError();
        client->look(1, 1000, 0.7);
        EXPECT_TRUE(client->waitForFrame(1, 1000).has_value()) << "after " << json;
        return error.value_or(v1::Error{});
    }
};

struct Refused {
    const char* json;
    v1::ErrorCode code;
    const char* field;
};

TEST_F(BadInput, EachWrongMessageIsRefusedWithItsFieldAndTheViewGoesOn) {
    constexpr const char* kUp = R"("center":{},"up":{"z":1},"fovyDegrees":40}}})";
    const std::string update = R"({"update":{"view":1,"inputSeq":"9",)";
    const std::string camera = update + R"("camera":{"eye":{"x":)";
    const std::string nanCamera = camera + R"("NaN"},)" + kUp;
    const std::string farCamera = camera + R"("Infinity"},)" + kUp;
    const std::string eyeInCenter = camera + "0}," + kUp;
    const std::string noWidth = update + R"("viewport":{"width":0,"height":9}}})";
    const std::string huge = update + R"("viewport":{"width":8193,"height":1}}})";
    const std::string hugest = update + R"("viewport":{"width":4294967295,"height":4294967295}}})";
    const std::string pixels = update + R"("viewport":{"width":8192,"height":8192}}})";
    const std::string noData =
        update + R"("scene":{"camera":{"eye":{"z":3},"center":{},"up":{"y":1},"fovyDegrees":30},)"
                 R"("layers":[{"id":"a","dataset":"no/such.vtu","transferFunction":)"
                 R"({"points":[{"value":0}]}}]}}})";
    const std::vector<Refused> rows{
        {"nonsense", v1::ERROR_CODE_MALFORMED_MESSAGE, ""},
        {"{}", v1::ERROR_CODE_MALFORMED_MESSAGE, ""},
        {R"({"update":{"view":1,"colour":3}})", v1::ERROR_CODE_MALFORMED_MESSAGE, ""},
        {R"({"hello":{"major":1}})", v1::ERROR_CODE_UNEXPECTED_MESSAGE, ""},
        {R"({"update":{"view":99,"inputSeq":"9"}})", v1::ERROR_CODE_NOT_FOUND, "view"},
        {R"({"closeView":{"view":99}})", v1::ERROR_CODE_NOT_FOUND, "view"},
        {R"({"openView":{"view":0,"viewport":{"width":9,"height":9}}})",
         v1::ERROR_CODE_INVALID_ARGUMENT, "view"},
        {R"({"openView":{"view":1,"viewport":{"width":9,"height":9}}})",
         v1::ERROR_CODE_INVALID_ARGUMENT, "view"},
        {R"({"openView":{"view":2,"dataset":"../etc/passwd","viewport":{"width":9,"height":9}}})",
         v1::ERROR_CODE_NOT_FOUND, "dataset"},
        {R"({"openDataset":{"dataset":"/etc/passwd"}})", v1::ERROR_CODE_NOT_FOUND, "dataset"},
        {nanCamera.c_str(), v1::ERROR_CODE_INVALID_ARGUMENT, "camera"},
        {farCamera.c_str(), v1::ERROR_CODE_INVALID_ARGUMENT, "camera"},
        {eyeInCenter.c_str(), v1::ERROR_CODE_INVALID_ARGUMENT, "camera"},
        {noWidth.c_str(), v1::ERROR_CODE_INVALID_ARGUMENT, "viewport"},
        {huge.c_str(), v1::ERROR_CODE_LIMIT_EXCEEDED, "viewport"},
        {hugest.c_str(), v1::ERROR_CODE_LIMIT_EXCEEDED, "viewport"},
        {pixels.c_str(), v1::ERROR_CODE_LIMIT_EXCEEDED, "viewport"},
        {noData.c_str(), v1::ERROR_CODE_NOT_FOUND, "scene"},
        {R"({"shareView":{"view":99,"role":"ROLE_WATCH"}})", v1::ERROR_CODE_NOT_FOUND, "view"},
        {R"({"shareView":{"view":1}})", v1::ERROR_CODE_INVALID_ARGUMENT, "role"},
        {R"({"shareView":{"view":1,"role":"ROLE_WATCH","expiresS":2592001}})",
         v1::ERROR_CODE_INVALID_ARGUMENT, "expires_s"},
        {R"({"takeControl":{"view":99}})", v1::ERROR_CODE_NOT_FOUND, "view"},
        {R"({"handOver":{"view":99,"person":1}})", v1::ERROR_CODE_NOT_FOUND, "view"},
        {R"({"handOver":{"view":1,"person":4000000000}})", v1::ERROR_CODE_NOT_PERMITTED, ""},
        {R"({"askControl":{"view":99}})", v1::ERROR_CODE_NOT_FOUND, "view"},
        {R"({"askControl":{"view":1}})", v1::ERROR_CODE_NOT_PERMITTED, ""},
        {R"({"setName":{"person":"0123456789012345678901234567890123456789012345678901234567890123X"}})",
         v1::ERROR_CODE_LIMIT_EXCEEDED, "person"},
        {R"({"undo":{"view":99}})", v1::ERROR_CODE_NOT_FOUND, "view"},
        {R"({"undo":{"view":1}})", v1::ERROR_CODE_NOT_FOUND, ""},
        {R"({"openView":{"view":2,"link":"x","viewport":{"width":9,"height":9}}})",
         v1::ERROR_CODE_NOT_PERMITTED, "link"},
        {R"({"openView":{"view":2,"link":"x","dataset":"y","viewport":{"width":9,"height":9}}})",
         v1::ERROR_CODE_INVALID_ARGUMENT, "dataset"},
        {R"({"measureDifference":{"view":99}})", v1::ERROR_CODE_NOT_FOUND, "view"},
        {R"({"measureDifference":{"view":1,"maxMs":-1}})", v1::ERROR_CODE_MALFORMED_MESSAGE, ""},
        {R"({"drawThumbnail":{"view":99}})", v1::ERROR_CODE_NOT_FOUND, "view"},
        {R"({"drawThumbnail":{"view":1,"width":96}})", v1::ERROR_CODE_INVALID_ARGUMENT,
         "draw_thumbnail.height"},
        {R"({"drawThumbnail":{"view":1,"width":257,"height":72}})", v1::ERROR_CODE_LIMIT_EXCEEDED,
         "draw_thumbnail.width"},
        {R"({"drawThumbnail":{"view":1,"width":96,"height":72}})", v1::ERROR_CODE_INVALID_ARGUMENT,
         "draw_thumbnail.scene"},
    };
    for (const Refused& row : rows) {
        const v1::Error error = errorTo(row.json);
        EXPECT_EQ(error.code(), row.code) << row.json << "\n" << error.message();
        EXPECT_THAT(error.field(), testing::StartsWith(row.field)) << row.json;
        EXPECT_FALSE(error.message().empty()) << row.json;
    }
}

TEST_F(BadInput, ARefusedUpdateEchoesItsInputAndLeavesTheView) {
    const auto client = clientWithView();
    ASSERT_TRUE(client);
    client->look(1, 2, 0.2);
    const auto before = client->waitForLossless(1, 2);
    v1::ClientMessage message;
    message.mutable_update()->set_view(1);
    message.mutable_update()->set_input_seq(3);
    message.mutable_update()->mutable_viewport();
    client->send(message);
    const auto error = client->waitForError();
    ASSERT_TRUE(error && before);
    EXPECT_EQ(error->view(), 1U);
    EXPECT_EQ(error->input_seq(), 3U);
    client->look(1, 4, 0.2);
    const auto after = client->waitForLossless(1, 4);
    ASSERT_TRUE(after.has_value());
    EXPECT_EQ(decode(*before).pixels, decode(*after).pixels);
}

TEST_F(BadInput, BinaryNonsenseIsRefusedAndTheConnectionGoesOn) {
    const auto client = clientWithView();
    ASSERT_TRUE(client);
    const std::array nonsense{std::byte{0xff}, std::byte{0xff}, std::byte{0x01}};
    client->socket().sendBinary(nonsense);
    client->socket().sendBinary({});
    for (int i = 0; i < 2; ++i) {
        const auto error = client->waitForError();
        ASSERT_TRUE(error.has_value());
        EXPECT_EQ(error->code(), v1::ERROR_CODE_MALFORMED_MESSAGE);
    }
    client->look(1, 2, 1);
    EXPECT_TRUE(client->waitForFrame(1, 2).has_value());
}

/// What a connection answers to its very first message, and how it closes it.
std::pair<v1::Error, std::uint16_t> firstMessage(std::uint16_t port, const std::string& json) {
    const auto socket = WsClient::connect(port);
    if (!socket) return {};
    socket->sendText(json);
    v1::ServerMessage message;
    if (const auto reply = socket->receive(kPatience)) {
        EXPECT_TRUE(reply->text);
        const std::string text{reinterpret_cast<const char*>(reply->bytes.data()),
                               reply->bytes.size()};
        EXPECT_THAT(text, HasSubstr("error"));
        for (const auto code :
             {v1::ERROR_CODE_UNEXPECTED_MESSAGE, v1::ERROR_CODE_UNSUPPORTED_VERSION,
              v1::ERROR_CODE_MALFORMED_MESSAGE, v1::ERROR_CODE_UNSUPPORTED}) {
            if (text.find('"' + v1::ErrorCode_Name(code) + '"') != std::string::npos) {
                message.mutable_error()->set_code(code);
            }
        }
    }
    EXPECT_FALSE(socket->receive(kPatience).has_value());
    return {message.error(), socket->closeCode()};
}

TEST_F(BadInput, WhateverComesBeforeAGoodHelloEndsTheConnection) {
    const std::vector<std::pair<const char*, v1::ErrorCode>> rows{
        {R"({"ping":{"token":"1"}})", v1::ERROR_CODE_UNEXPECTED_MESSAGE},
        {R"({"openView":{"view":1}})", v1::ERROR_CODE_UNEXPECTED_MESSAGE},
        {R"({"hello":{"major":2}})", v1::ERROR_CODE_UNSUPPORTED_VERSION},
        {R"({"hello":{}})", v1::ERROR_CODE_UNSUPPORTED_VERSION},
        {R"({"hello":{"major":1,"codecs":[9]}})", v1::ERROR_CODE_UNSUPPORTED},
        {"{", v1::ERROR_CODE_MALFORMED_MESSAGE},
    };
    for (const auto& [json, code] : rows) {
        const auto [error, close] = firstMessage(port(), json);
        EXPECT_EQ(error.code(), code) << json;
        EXPECT_EQ(close, 1008) << json;
    }
}

TEST_F(BadInput, AMessageAboveTheLimitEndsTheConnectionWith1009) {
    const auto client = clientWithView();
    ASSERT_TRUE(client);
    client->sendJson(std::string(64 * 1024 + 1, ' '));
    while (client->read(kPatience)) {
    }
    EXPECT_EQ(client->socket().closeCode(), 1009);
}

TEST_F(BadInput, ViewsBeyondTheLimitAreRefused) {
    TestClient client{port()};
    ASSERT_TRUE(client.ok());
    for (std::uint32_t view = 1; view <= 17; ++view) client.openView(view, "good.node", 8, 8);
    const auto error = client.waitForError();
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->code(), v1::ERROR_CODE_LIMIT_EXCEEDED);
    EXPECT_EQ(error->view(), 17U);
}

// The silent client gets what its first credits pay for and one probe; the other's frames keep
// coming.
TEST_F(BadInput, AClientThatNeverAcksStallsNobodyElse) {
    TestClient silent{port()};
    ASSERT_TRUE(silent.ok());
    silent.ackFrames(false);
    silent.openView(1, "good.node");
    ASSERT_TRUE(silent.waitForFrame(1, 1).has_value());
    const auto other = clientWithView();
    ASSERT_TRUE(other);
    for (std::uint64_t seq = 2; seq <= 40; ++seq) {
        silent.look(1, seq, 0.1 * static_cast<double>(seq));
        other->look(1, seq, 0.1 * static_cast<double>(seq));
        ASSERT_TRUE(other->waitForFrame(1, seq).has_value()) << seq;
    }
    const auto second = silent.waitForFrame([](const auto&) { return true; });
    ASSERT_TRUE(second.has_value());
    while (silent.read(std::chrono::milliseconds{1})) {
    }
    EXPECT_LE(silent.frames.size(), 1U) << "no more than the probe";
    // A sign of life, and the newest state comes, however long it was silent.
    silent.ackFrames(true);
    silent.ack(second->prefix);
    EXPECT_TRUE(silent.waitForFrame(1, 40).has_value());
}

TEST_F(BadInput, AClientThatDisconnectsMidFrameIsForgotten) {
    const auto other = clientWithView();
    ASSERT_TRUE(other);
    for (int i = 0; i < 5; ++i) {
        TestClient leaver{port(), TestClient::Form::kBinary, {.receiveBuffer = 4096}};
        ASSERT_TRUE(leaver.ok());
        leaver.openView(1, "good.node", 1024, 1024);
        ASSERT_TRUE(leaver.waitFor([](const auto& one) { return one.has_view_opened(); }));
        leaver.look(1, 2, i);
        leaver.socket().abort();
    }
    other->look(1, 2, 1);
    EXPECT_TRUE(other->waitForFrame(1, 2).has_value());
    EXPECT_TRUE(eventually([] {
        const std::string log = server().log();
        std::size_t ended = 0, begun = 0;
        for (auto at = log.find("event=connected"); at != std::string::npos;
             at = log.find("event=connected", at + 1)) {
            ++begun;
        }
        for (auto at = log.find("event=disconnected"); at != std::string::npos;
             at = log.find("event=disconnected", at + 1)) {
            ++ended;
        }
        return begun - ended == 1;
    })) << server().log();
}

}  // namespace
}  // namespace volcast::test
