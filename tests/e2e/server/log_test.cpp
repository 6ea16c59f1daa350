// The log: one line an event, with the numbers of whom it concerns.
#include <csignal>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include <gmock/gmock.h>

#include "tests/e2e/server/fault_stage.h"

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

/// The value of `key` in a line; empty where it has none.
std::string valueOf(const std::string& line, const std::string& key) {
    std::smatch found;
    const std::regex pattern{" " + key + R"(=("[^"]*"|\S+))"};
    return std::regex_search(line, found, pattern) ? found[1].str() : "";
}

TEST(Log, LinesOfWorkersAreEventsTooAndNameTheViewThatWasDrawn) {
    ServerProcess server{{"--allow-faults"}};
    ASSERT_TRUE(server.ready()) << server.log();
    {
        const Looker looker{server.port(), TestClient::Form::kBinary, "demo:mesh"};
        ASSERT_TRUE(looker.before.has_value()) << server.log();
        inject(*looker.client, "gpu-reset");
        looker.client->look(1, 3, 1.1);
        ASSERT_TRUE(looker.client->waitForFrame(1, 3).has_value()) << server.log();
    }
    server.signal(SIGTERM);
    const auto ended = server.wait();
    ASSERT_TRUE(ended.has_value());
    std::map<std::string, std::string> last;  // By event.
    std::istringstream lines{ended->err};
    const std::regex stamped{R"(^\d{4}-\d\d-\d\dT.*)"},
        wellFormed{R"(^\S+ [a-z]+ event=[a-z_]+( [a-z_0-9]+=("[^"]*"|[^ "]+))*$)"};
    for (std::string line; std::getline(lines, line);) {
        if (!std::regex_match(line, stamped)) continue;  // A library's own words.
        EXPECT_TRUE(std::regex_match(line, wellFormed)) << line;
        last[valueOf(line, "event")] = line;
    }
    const std::string view = valueOf(last["view_opened"], "view");
    EXPECT_NE(view, "");
    EXPECT_EQ(valueOf(last["worker_lost"], "view"), view) << ended->err;
    EXPECT_EQ(valueOf(last["worker_lost"], "role"), "drawing");
    EXPECT_NE(valueOf(last["worker_ready"], "worker"), "");
    // Both by the worker itself.
    EXPECT_EQ(valueOf(last["fault_armed"], "worker"), valueOf(last["worker_lost"], "worker"));
    EXPECT_EQ(valueOf(last["device_lost"], "worker"), valueOf(last["worker_lost"], "worker"));
}

}  // namespace
}  // namespace volcast::test
