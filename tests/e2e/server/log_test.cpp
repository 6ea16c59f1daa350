// The log: one line an event, with the numbers of whom it concerns.
#include <csignal>
#include <regex>
#include <set>
#include <sstream>

#include <gmock/gmock.h>

#include "tests/e2e/server/test_client.h"

namespace volcast::test {
namespace {

TEST(Log, LinesAboutAClientNameItAndThoseAboutAViewBoth) {
    ServerProcess server;
    ASSERT_TRUE(server.ready()) << server.log();
    {
        TestClient client{server.port()};
        ASSERT_TRUE(client.ok());
        client.openView(1, "demo:volume");
        ASSERT_TRUE(client.waitForFrame(1, 1).has_value());
        v1::ClientMessage close;
        close.mutable_close_view()->set_view(1);
        client.send(close);
        v1::ClientMessage ping;
        ping.mutable_ping()->set_token(1);
        client.send(ping);
        ASSERT_TRUE(client.waitFor([](const auto& one) { return one.has_pong(); }).has_value());
    }
    server.signal(SIGTERM);
    const auto ended = server.wait();
    ASSERT_TRUE(ended.has_value());
    const std::set<std::string> ofClients{"connected",  "hello",       "view_opened",
                                          "view_state", "view_closed", "disconnected"};
    std::set<std::string> seen;
    std::istringstream lines{ended->err};
    const std::regex event{R"( event=([a-z_]+)( |$))"}, connection{R"( connection=[1-9]\d*( |$))"},
        person{R"( person=[1-9]\d*( |$))"}, view{R"( view=[\w-]+( |$))"};
    for (std::string line; std::getline(lines, line);) {
        std::smatch found;
        if (!std::regex_search(line, found, event) || !ofClients.contains(found[1])) continue;
        seen.insert(found[1]);
        // What happens in a view is of a person, whose connections may change.
        EXPECT_TRUE(std::regex_search(line, found[1] == "view_state" ? person : connection))
            << line;
        if (found[1].str().starts_with("view_")) {
            EXPECT_TRUE(std::regex_search(line, view)) << line;
        }
    }
    EXPECT_EQ(seen, ofClients) << ended->err;
}

}  // namespace
}  // namespace volcast::test
