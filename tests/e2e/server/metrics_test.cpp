// /metrics as a scraper reads it.
#include <csignal>
#include <map>
#include <sstream>

#include <gmock/gmock.h>

#include "tests/e2e/server/fault_stage.h"

namespace volcast::test {
namespace {

using testing::HasSubstr;

/// "name{labels}" -> value of the text format.
std::map<std::string, double> scrape(std::uint16_t port) {
    const HttpReply reply = http(port, "/metrics");
    EXPECT_EQ(reply.status, 200U);
    EXPECT_THAT(reply.headers.at("content-type"), HasSubstr("version=0.0.4"));
    std::map<std::string, double> values;
    std::istringstream lines{reply.body};
    for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line.front() == '#') continue;
        const auto space = line.rfind(' ');
        values[line.substr(0, space)] = std::stod(line.substr(space + 1));
    }
    return values;
}

TEST(Metrics, CountWhatAClientDid) {
    const ServerProcess server;
    ASSERT_TRUE(server.ready()) << server.log();
    const auto before = scrape(server.port());
    EXPECT_EQ(before.at("volcast_connections"), 0);
    EXPECT_EQ(before.at("volcast_views"), 0);
    EXPECT_EQ(before.at(R"(volcast_frame_stage_seconds_count{stage="draw"})"), 0);
    EXPECT_GE(before.at("volcast_worker_starts_total"), 1);
    EXPECT_EQ(before.at(R"(volcast_worker_ready{worker="drawing"})"), 1);
    {
        TestClient client{server.port()};
        ASSERT_TRUE(client.ok());
        client.openView(1, "demo:volume");
        const auto exact = client.waitForLossless(1, 1);
        ASSERT_TRUE(exact.has_value());
        client.openView(1, "demo:volume");
        ASSERT_TRUE(client.waitForError().has_value());
        const auto now = scrape(server.port());
        EXPECT_EQ(now.at("volcast_connections"), 1);
        EXPECT_EQ(now.at("volcast_connections_total"), 1);
        EXPECT_EQ(now.at("volcast_views"), 1);
        EXPECT_GE(now.at(R"(volcast_frames_total{codec="jpeg"})"), 1);
        EXPECT_EQ(now.at(R"(volcast_frames_total{codec="png"})"), 1);
        EXPECT_EQ(now.at(R"(volcast_frame_bytes_total{codec="png"})"),
                  static_cast<double>(exact->payload.size()));
        for (const char* stage : {"wait", "upload", "draw", "readback"}) {
            const std::string label = std::string{"{stage=\""} + stage + "\"}";
            EXPECT_EQ(now.at("volcast_frame_stage_seconds_count" + label),
                      now.at(R"(volcast_frames_total{codec="jpeg"})"))
                << stage;
        }
        EXPECT_GT(now.at(R"(volcast_frame_stage_seconds_sum{stage="draw"})"), 0);
        EXPECT_GT(now.at(R"(volcast_frame_stage_seconds_sum{stage="encode"})"), 0);
        EXPECT_GE(now.at("volcast_ack_round_trip_seconds_count"), 1);
        EXPECT_GE(now.at("volcast_frames_under_way_count"), 2);
        EXPECT_EQ(now.at(R"(volcast_errors_total{code="ERROR_CODE_INVALID_ARGUMENT"})"), 1);
        EXPECT_EQ(now.at(R"(volcast_imports_total{result="good"})"), 1);
        EXPECT_EQ(now.at(R"(volcast_queue_depth{queue="import"})"), 0);
        EXPECT_EQ(now.at(R"(volcast_queue_depth{queue="render"})"), 0);
        EXPECT_GT(now.at("volcast_received_bytes_total"), 0);
        EXPECT_GT(now.at("volcast_sent_bytes_total"), static_cast<double>(exact->payload.size()));
        EXPECT_EQ(now.at("volcast_worker_losses_total"), 0);
    }
    EXPECT_TRUE(eventually([&] { return scrape(server.port()).at("volcast_connections") == 0; }));
    EXPECT_EQ(scrape(server.port()).at("volcast_views"), 1) << "who was in it may come back";
}

TEST(Metrics, ViewsThatNobodyComesBackToEndByThemselves) {
    const ServerProcess server{{"--keep-views-s", "1"}};
    ASSERT_TRUE(server.ready()) << server.log();
    {
        TestClient client{server.port()};
        ASSERT_TRUE(client.ok());
        client.openView(1, "demo:volume");
        ASSERT_TRUE(client.waitForFrame(1, 1).has_value());
        EXPECT_NE(client.share(1, v1::ROLE_WATCH), "");
        EXPECT_EQ(scrape(server.port()).at("volcast_views"), 1);
    }
    EXPECT_TRUE(eventually([&] { return scrape(server.port()).at("volcast_views") == 0; }));
}

// A worker that hangs in one view's picture lets the others wait for their turn.
TEST(Metrics, ViewsThatWaitForAWorkerAreCounted) {
    const ServerProcess server{{"--allow-faults", "--frame-deadline-ms", "60000"}};
    ASSERT_TRUE(server.ready()) << server.log();
    TestClient client{server.port()};
    ASSERT_TRUE(client.ok());
    for (const std::uint32_t view : {1U, 2U, 3U}) {
        client.openView(view, "demo:volume");
        ASSERT_TRUE(client.waitForLossless(view, 1).has_value());
    }
    inject(client, "hang-in-draw");
    for (const std::uint32_t view : {1U, 2U, 3U}) client.look(view, 2, 1.0);
    const auto waiting = [&] {
        return scrape(server.port()).at(R"(volcast_queue_depth{queue="render"})");
    };
    EXPECT_TRUE(eventually([&] { return waiting() == 2; })) << waiting();
    server.signal(SIGKILL);
}

TEST(Metrics, LabelsAreBoundedWhateverClientsSend) {
    const ServerProcess server;
    ASSERT_TRUE(server.ready()) << server.log();
    const auto before = scrape(server.port());
    for (int i = 0; i < 20; ++i) {
        TestClient client{server.port()};
        ASSERT_TRUE(client.ok());
        client.openView(static_cast<std::uint32_t>(i + 1), "none" + std::to_string(i));
        ASSERT_TRUE(client.waitForError().has_value());
    }
    const auto after = scrape(server.port());
    EXPECT_EQ(after.size(), before.size());
    EXPECT_EQ(after.at(R"(volcast_errors_total{code="ERROR_CODE_NOT_FOUND"})"), 20);
}

TEST(Metrics, AreForThisMachineUnlessSaidOtherwise) {
    const std::string passedOn = "X-Forwarded-For: 192.0.2.1\r\n";
    const ServerProcess local;
    ASSERT_TRUE(local.ready()) << local.log();
    EXPECT_EQ(http(local.port(), "/metrics").status, 200U);
    EXPECT_EQ(http(local.port(), "/metrics", "GET", passedOn).status, 403U);
    EXPECT_EQ(http(local.port(), "/metrics", "GET", "Forwarded: for=192.0.2.1\r\n").status, 403U);
    const ServerProcess all{{"--metrics", "all"}};
    ASSERT_TRUE(all.ready()) << all.log();
    EXPECT_EQ(http(all.port(), "/metrics", "GET", passedOn).status, 200U);
    const ServerProcess off{{"--metrics", "off"}};
    ASSERT_TRUE(off.ready()) << off.log();
    EXPECT_EQ(http(off.port(), "/metrics").status, 404U);
    EXPECT_EQ(runVolcast({"serve", "--metrics", "some"})->exitCode, 2);
}

}  // namespace
}  // namespace volcast::test
