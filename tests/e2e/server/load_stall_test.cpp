// `volcast load` against a server that stands still for the rest of the run.
#include <csignal>
#include <future>

#include <boost/json.hpp>
#include <gmock/gmock.h>

#include "tests/e2e/server/test_client.h"

namespace volcast::test {
namespace {

using testing::HasSubstr;
namespace json = boost::json;

bool hasSentFrames(std::uint16_t port, int count) {
    const std::string body = http(port, "/metrics").body;
    const std::string name = "\nvolcast_frames_total{codec=\"jpeg\"} ";
    const auto at = body.find(name);
    return at != std::string::npos && std::stod(body.substr(at + name.size())) >= count;
}

// The frames that came were in time; what tells of the stall is what did not come.
TEST(LoadStall, InputsThatNobodyAnswersBreakTheLimits) {
    const ServerProcess server;
    ASSERT_TRUE(server.ready()) << server.log();
    const std::string url = "ws://127.0.0.1:" + std::to_string(server.port());
    auto run = std::async(std::launch::async, [&url] {
        return runVolcast({"load",       url,
                           "--clients",  "orbit,idle",
                           "--views",    "1",
                           "--ramp-up",  "0",
                           "--width",    "64",
                           "--height",   "48",
                           "--duration", "8",
                           "--json",     "--max-p99-ms",
                           "2000",       "--max-age-ms",
                           "2000",       "--max-errors",
                           "0"});
    });
    EXPECT_TRUE(eventually([&] { return hasSentFrames(server.port(), 10); }));
    server.signal(SIGSTOP);
    const auto ran = run.get();
    server.signal(SIGCONT);
    ASSERT_TRUE(ran.has_value());
    EXPECT_EQ(ran->exitCode, 1);
    EXPECT_THAT(ran->err, HasSubstr("not kept: input to frame p99 ms"));
    EXPECT_THAT(ran->err, HasSubstr("not kept: frame age max ms"));
    boost::system::error_code error;
    const json::value report = json::parse(ran->out, error);
    ASSERT_FALSE(error) << ran->out;
    const json::value& orbit = report.at("kinds").at("orbit");
    EXPECT_GT(orbit.at("unanswered").to_number<int>(), 0);
    const json::value& watcher = report.at("kinds").at("idle, watching");
    EXPECT_GT(watcher.at("unseen_ms").at("count").to_number<int>(), 0);
    EXPECT_EQ(watcher.at("unanswered").to_number<int>(), 0);
}

}  // namespace
}  // namespace volcast::test
