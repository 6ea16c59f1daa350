// Floods: of messages, of connections; and clients that do not leave.
#include <arpa/inet.h>
#include <array>
#include <csignal>
#include <memory>
#include <vector>

#include <gmock/gmock.h>
#include <ifaddrs.h>
#include <net/if.h>

#include "tests/e2e/server/raw_socket.h"
#include "tests/e2e/server/test_client.h"

namespace volcast::test {
namespace {

using testing::HasSubstr;

v1::ClientMessage ping(std::uint64_t token) {
    v1::ClientMessage message;
    message.mutable_ping()->set_token(token);
    return message;
}

/// An IPv4 address of this machine that is not the loopback's; empty where it has none.
std::string outerAddress() {
    ifaddrs* all = nullptr;
    if (::getifaddrs(&all) != 0) return {};
    std::string found;
    for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
        if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
        if ((one->ifa_flags & IFF_LOOPBACK) != 0) continue;
        std::array<char, INET_ADDRSTRLEN> text{};
        const auto& address = reinterpret_cast<const sockaddr_in&>(*one->ifa_addr);
        found = ::inet_ntop(AF_INET, &address.sin_addr, text.data(), text.size());
    }
    ::freeifaddrs(all);
    return found;
}

TEST(Limits, AClientThatSendsTooManyMessagesIsToldAndClosed) {
    const ServerProcess server{{"--max-messages-per-s", "50"}};
    ASSERT_TRUE(server.ready()) << server.log();
    TestClient hasty{server.port()};
    TestClient calm{server.port()};
    ASSERT_TRUE(hasty.ok() && calm.ok());
    for (std::uint64_t i = 1; i <= 2000; ++i) hasty.send(ping(i));
    const auto refusal = hasty.waitForError();
    ASSERT_TRUE(refusal.has_value());
    EXPECT_EQ(refusal->code(), v1::ERROR_CODE_LIMIT_EXCEEDED);
    EXPECT_EQ(refusal->message(), "more than 50 messages a second");
    while (hasty.read(kPatience)) {
    }
    EXPECT_EQ(hasty.socket().closeCode(), 1008);
    calm.send(ping(7));
    EXPECT_TRUE(calm.waitFor([](const auto& one) { return one.pong().token() == 7; }).has_value());
}

TEST(Limits, OneAddressHasItsShareOfTheClients) {
    const std::string here = outerAddress();
    if (here.empty()) GTEST_SKIP() << "this machine has no address but the loopback's";
    const ServerProcess server{{"--host", here, "--max-clients-per-address", "1"}};
    ASSERT_TRUE(server.ready()) << server.log();
    {
        RawSocket first{server.port(), here}, second{server.port(), here};
        ASSERT_TRUE(first.upgrade());
        EXPECT_THAT(second.upgradeAnswer(), testing::StartsWith("HTTP/1.1 503 "));
        EXPECT_THAT(server.log(), HasSubstr("--max-clients-per-address"));
    }
    EXPECT_TRUE(eventually([&] { return RawSocket{server.port(), here}.upgrade(); }));
}

// Idle connections are cut off after 5 s; until then those above the limit are dropped, and who
// has a WebSocket notices nothing.
TEST(Limits, AFloodOfConnectionsPasses) {
    const ServerProcess server{{"--max-clients", "2"}};
    ASSERT_TRUE(server.ready()) << server.log();
    TestClient client{server.port()};
    ASSERT_TRUE(client.ok());
    std::vector<std::unique_ptr<RawSocket>> flood;
    for (int i = 0; i < 300; ++i) flood.push_back(std::make_unique<RawSocket>(server.port()));
    client.send(ping(7));
    EXPECT_TRUE(
        client.waitFor([](const auto& one) { return one.pong().token() == 7; }).has_value());
    EXPECT_TRUE(eventually([&] { return http(server.port(), "/healthz").status == 200; }));
}

// It takes the upgrade and no picture, though it asks for more: the kernel holds less than one.
TEST(Limits, AClientThatStopsReadingIsCutOff) {
    const ServerProcess server{{"--write-patience-s", "1"}};
    ASSERT_TRUE(server.ready()) << server.log();
    RawSocket still{server.port()};
    ASSERT_TRUE(still.upgrade());
    TestClient other{server.port()};
    ASSERT_TRUE(other.ok());
    still.send(rawFrame(kText, R"({"hello":{"major":1,"client":"x","codecs":["CODEC_PNG"]}})"));
    still.send(rawFrame(kText, R"({"openView":{"view":1,"dataset":"demo:volume","inputSeq":"1",)"
                               R"("viewport":{"width":1536,"height":1536}}})"));
    const auto said = [&](const char* event) {
        still.send(rawFrame(kText, R"({"ack":{"view":1,"sequence":4294967295}})"));
        return server.log().find(event) != std::string::npos;
    };
    EXPECT_TRUE(eventually([&] { return said("event=stuck connection=1"); })) << server.log();
    EXPECT_TRUE(eventually([&] { return said("event=disconnected connection=1"); }));
    other.send(ping(7));
    EXPECT_TRUE(other.waitFor([](const auto& one) { return one.pong().token() == 7; }).has_value());
}

TEST(Limits, AFloodOfViewsIsRefusedOneByOne) {
    const ServerProcess server{{"--max-views", "2"}};
    ASSERT_TRUE(server.ready()) << server.log();
    TestClient client{server.port()};
    ASSERT_TRUE(client.ok());
    for (std::uint32_t view = 1; view <= 50; ++view) client.openView(view, "demo:volume");
    for (std::uint32_t view = 3; view <= 50; ++view) {
        const auto refusal = client.waitForError();
        ASSERT_TRUE(refusal.has_value());
        EXPECT_EQ(refusal->code(), v1::ERROR_CODE_LIMIT_EXCEEDED);
        EXPECT_EQ(refusal->view(), view);
    }
    EXPECT_TRUE(client.waitForFrame(1, 1).has_value());
}

// It never answers the close: 5 s later the server ends without it, and cleanly.
TEST(Drain, AClientThatDoesNotLeaveDoesNotHoldTheServer) {
    ServerProcess server;
    ASSERT_TRUE(server.ready()) << server.log();
    RawSocket deaf{server.port()};
    ASSERT_TRUE(deaf.upgrade());
    server.signal(SIGTERM);
    const auto ended = server.wait();
    ASSERT_TRUE(ended.has_value());
    EXPECT_EQ(ended->exitCode, 0) << ended->err;
    EXPECT_THAT(ended->err, HasSubstr("event=stopped"));
}

TEST(Drain, NobodyNewIsLetIn) {
    ServerProcess server;
    ASSERT_TRUE(server.ready()) << server.log();
    RawSocket deaf{server.port()};
    ASSERT_TRUE(deaf.upgrade());  // Its session may not have begun yet.
    server.signal(SIGTERM);
    ASSERT_TRUE(eventually([&] { return server.log().find("draining") != std::string::npos; }));
    EXPECT_EQ(http(server.port(), "/healthz").status, 0U);
    const auto close = deaf.readFrame();
    ASSERT_TRUE(close.has_value());
    EXPECT_EQ(close->opcode, kClose);
    EXPECT_EQ(close->closeCode(), 1012U);
    EXPECT_TRUE(server.wait().has_value());
}

// A browser keeps its connection; the one that does not leave keeps the server there meanwhile.
TEST(Drain, AConnectionThatIsOlderGetsNoWebSocketAnyMore) {
    ServerProcess server;
    ASSERT_TRUE(server.ready()) << server.log();
    RawSocket deaf{server.port()}, older{server.port()};
    ASSERT_TRUE(deaf.upgrade());
    ASSERT_TRUE(older.send("HEAD /healthz HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n"));
    ASSERT_TRUE(older.readHead().starts_with("HTTP/1.1 200 "));
    server.signal(SIGTERM);
    ASSERT_TRUE(eventually([&] { return server.log().find("draining") != std::string::npos; }));
    EXPECT_THAT(older.upgradeAnswer(), testing::StartsWith("HTTP/1.1 503 "));
    EXPECT_TRUE(older.readToEnd());
    const auto ended = server.wait();
    ASSERT_TRUE(ended.has_value());
    EXPECT_THAT(ended->err, testing::Not(HasSubstr("connection=2")));
}

}  // namespace
}  // namespace volcast::test
