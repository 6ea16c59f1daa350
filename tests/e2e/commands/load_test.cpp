// `volcast load` with real servers: what each kind of client reports, thresholds, bad input.
#include <chrono>

#include <boost/json.hpp>
#include <gmock/gmock.h>

#include "tests/e2e/commands/program.h"

namespace volcast::test {
namespace {

using testing::HasSubstr;
namespace json = boost::json;

std::vector<std::string> small(std::vector<std::string> more) {
    std::vector<std::string> all{"load",    "--duration", "1",        "--ramp-up", "0",
                                 "--width", "64",         "--height", "48"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

json::object parsed(const Outcome& outcome) {
    boost::system::error_code error;
    const json::value value = json::parse(outcome.out, error);
    EXPECT_FALSE(error) << outcome.out << outcome.err;
    return value.is_object() ? value.as_object() : json::object{};
}

double number(const json::value& object, const char* key) {
    return object.at(key).to_number<double>();
}

TEST(Load, EachKindOfClientReportsWhatItSaw) {
    const auto begun = std::chrono::steady_clock::now();
    const Outcome ran = runVolcast(small({"--clients", "orbit,map,model,join=2,idle,slow,shaped",
                                          "--json", "--rate", "10", "--max-errors", "0"}));
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
    ASSERT_EQ(ran.exitCode, 0) << ran.err;
    const json::object report = parsed(ran);
    EXPECT_EQ(number(report, "views"), 8);
    EXPECT_FALSE(report.at("interrupted").as_bool());
    EXPECT_TRUE(report.at("violations").as_array().empty());
    const json::object& kinds = report.at("kinds").as_object();
    for (const char* kind : {"orbit", "map", "model", "slow", "shaped"}) {
        ASSERT_TRUE(kinds.contains(kind)) << ran.out;
        const json::value& seen = kinds.at(kind);
        EXPECT_EQ(number(seen, "connects"), 1) << kind;
        EXPECT_EQ(number(seen, "failed_connects"), 0) << kind;
        EXPECT_GT(number(seen, "frames"), 0) << kind;
        EXPECT_GT(number(seen, "bytes"), 100 * number(seen, "frames")) << kind;
        EXPECT_GT(number(seen, "inputs"), 0) << kind;
        const json::value& latency = seen.at("input_to_frame_ms");
        EXPECT_GT(number(latency, "count"), 0) << kind;
        // Each input counts once, those made before measuring began among them.
        EXPECT_LE(number(latency, "count"), 10 * took.count() + 1) << kind;
        EXPECT_LE(number(latency, "p50"), number(latency, "p95")) << kind;
        EXPECT_LE(number(latency, "p95"), number(latency, "p99")) << kind;
        EXPECT_LE(number(latency, "p99"), number(latency, "max")) << kind;
        EXPECT_GT(number(seen.at("age_ms"), "count"), 0) << kind;
        EXPECT_EQ(number(seen.at("first_frame_ms"), "count"), 1) << kind;
    }
    // A round trip of 50 ms is added: no input can be answered sooner.
    EXPECT_GE(number(kinds.at("shaped").at("input_to_frame_ms"), "p50"), 50);
    EXPECT_GT(number(kinds.at("join"), "connects"), 2);
    EXPECT_EQ(number(kinds.at("join"), "lost_connections"), 0);
    EXPECT_EQ(number(kinds.at("idle"), "inputs"), 0);
    EXPECT_EQ(number(kinds.at("idle"), "connects"), 1);
    const json::value& server = report.at("server");
    EXPECT_GT(number(server, "workers_cpu_s"), 0);
    EXPECT_GT(number(server, "resident_bytes"), 1e6);
    EXPECT_GT(number(server, "resident_bytes_with_workers"), number(server, "resident_bytes"));
    EXPECT_GE(number(server, "processes"), 2);
}

// Pings take the link's time too, so the server sees a long way, not a queue in front of a thin
// one.
TEST(Load, ALongWayThatIsWideCostsNoPicture) {
    const Outcome ran =
        runVolcast({"load", "--clients", "shaped", "--link-mbit", "100", "--link-delay", "200",
                    "--rate", "10", "--duration", "4", "--json", "--max-errors", "0"});
    ASSERT_EQ(ran.exitCode, 0) << ran.err;
    const json::value seen = parsed(ran).at("kinds").at("shaped");
    EXPECT_GE(number(seen.at("input_to_frame_ms"), "p50"), 200);
    EXPECT_EQ(number(seen, "quality_least"), 90);
    EXPECT_GT(number(seen, "scale_least"), 0);
}

// A client that idles in a view of its own never sees an input, so ages show that views are shared.
TEST(Load, SixClientsShareTwoViewsThatMove) {
    const Outcome ran = runVolcast(small({"--clients", "idle=3,orbit=2,slow", "--views", "2",
                                          "--json", "--rate", "10", "--max-errors", "0"}));
    ASSERT_EQ(ran.exitCode, 0) << ran.err;
    const json::object report = parsed(ran);
    EXPECT_EQ(number(report, "views"), 2);
    const json::object& kinds = report.at("kinds").as_object();
    ASSERT_EQ(kinds.size(), 3U) << ran.out;
    const json::value& steering = kinds.at("orbit");
    EXPECT_EQ(number(steering, "clients"), 2);
    EXPECT_GT(number(steering, "inputs"), 0);
    for (const auto& [kind, clients] :
         {std::pair{"idle, watching", 3}, std::pair{"slow, watching", 1}}) {
        const json::value& seen = kinds.at(kind);
        EXPECT_EQ(number(seen, "clients"), clients) << kind;
        EXPECT_EQ(number(seen, "connects"), clients) << kind;
        EXPECT_EQ(number(seen, "inputs"), 0) << kind;
        EXPECT_GT(number(seen, "frames_per_s_slowest"), 0) << kind;
        EXPECT_GT(number(seen.at("age_ms"), "count"), 0) << kind;
        EXPECT_EQ(number(seen.at("input_to_frame_ms"), "count"), 0) << kind;
        EXPECT_EQ(number(seen.at("first_frame_ms"), "count"), clients) << kind;
    }
    const json::value& moving = report.at("views_that_move");
    EXPECT_EQ(number(moving, "count"), 2);
    EXPECT_GT(number(moving, "fairness"), 0);
    EXPECT_LE(number(moving, "fairness"), 1);
    for (const char* when : {"start", "end"}) {
        const json::value& use = report.at("server").at(when);
        EXPECT_GT(number(use, "resident_bytes"), 1e6) << when;
        EXPECT_GT(number(use, "threads_with_workers"), number(use, "threads")) << when;
        EXPECT_GT(number(use, "descriptors"), 6) << when;
    }
}

// Who watches comes back to the view that is there; who steered opens another.
TEST(Load, WatchersThatComeAndGoFindTheirView) {
    const Outcome ran = runVolcast(small({"--clients", "orbit,join=2", "--views", "1", "--json",
                                          "--rate", "10", "--max-errors", "0"}));
    ASSERT_EQ(ran.exitCode, 0) << ran.err;
    const json::object report = parsed(ran);
    EXPECT_GT(number(report.at("kinds").at("join, watching"), "connects"), 2);
}

TEST(Load, AcksMayBeHeldBackOrGivenForNothing) {
    for (const char* acks : {"full", "one", "none"}) {
        const Outcome ran = runVolcast(
            small({"--acks", acks, "--clients", "shaped", "--json", "--max-errors", "0"}));
        ASSERT_EQ(ran.exitCode, 0) << acks << ran.err;
        const json::object report = parsed(ran);
        EXPECT_GT(number(report.at("kinds").at("shaped").at("age_ms"), "count"), 0) << acks;
    }
}

TEST(Load, TheTableHasARowForEachKind) {
    const Outcome ran = runVolcast(small({"--clients", "orbit=2,idle"}));
    ASSERT_EQ(ran.exitCode, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("\norbit                  2"));
    EXPECT_THAT(ran.out, HasSubstr("\nidle                   1"));
    EXPECT_THAT(ran.out, HasSubstr("cores, its workers"));
    EXPECT_EQ(ran.err, "");
}

TEST(Load, AThresholdThatIsNotKeptIsNamedAndExitsWithOne) {
    const Outcome ran =
        runVolcast(small({"--max-p99-ms", "0.001", "--min-fps", "100000", "--max-server-mb", "1",
                          "--max-p50-ms", "1000000", "--max-age-ms", "0.001", "--min-fairness",
                          "1.1", "--max-server-cores", "0", "--max-growth-mb", "10000"}));
    EXPECT_EQ(ran.exitCode, 1);
    EXPECT_THAT(ran.err, HasSubstr("not kept: input to frame p99 ms"));
    EXPECT_THAT(ran.err, HasSubstr("not kept: frames/s of the slowest client"));
    EXPECT_THAT(ran.err, HasSubstr("not kept: server MB"));
    EXPECT_THAT(ran.err, HasSubstr("not kept: frame age max ms"));
    EXPECT_THAT(ran.err, HasSubstr("not kept: fairness of views"));
    EXPECT_THAT(ran.err, HasSubstr("not kept: server cores"));
    EXPECT_THAT(ran.err, testing::Not(HasSubstr("growth")));
    EXPECT_THAT(ran.err, testing::Not(HasSubstr("p50")));
}

// An idle client answers no input, so a limit of latency says nothing about it.
TEST(Load, ALimitOfWhatWasNotSeenIsNotKept) {
    const Outcome ran = runVolcast(small({"--clients", "idle", "--max-p99-ms", "1000000"}));
    EXPECT_EQ(ran.exitCode, 1);
    EXPECT_THAT(ran.err, HasSubstr("no frame answered an input"));
}

TEST(Load, RefusalsOfTheServerAreCounted) {
    const Outcome ran = runVolcast(
        small({"--clients", "orbit", "--dataset", "none", "--json", "--max-errors", "0"}));
    EXPECT_EQ(ran.exitCode, 1);
    const json::object report = parsed(ran);
    const auto& errors = report.at("kinds").at("orbit").at("errors").as_object();
    EXPECT_EQ(number(errors, "ERROR_CODE_NOT_FOUND"), 1);
}

TEST(Load, ClientsBeyondTheServersLimitFailToConnect) {
    const Outcome ran =
        runVolcast(small({"--clients", "idle=3", "--json", "--server-option=--max-clients=2"}));
    EXPECT_EQ(ran.exitCode, 0);
    const json::value report = parsed(ran);
    EXPECT_EQ(number(report.at("kinds").at("idle"), "connects"), 2);
    EXPECT_GE(number(report.at("kinds").at("idle"), "failed_connects"), 1);
    EXPECT_THAT(ran.out, HasSubstr("HTTP 503"));
}

TEST(Load, WrongOptionsAreNamed) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> rows{
        {{"load", "--clients", "dance"}, "dance"},
        {{"load", "--clients", "orbit=0"}, "orbit=0"},
        {{"load", "--clients", "orbit=1x"}, "orbit=1x"},
        {{"load", "--clients", ""}, "--clients"},
        {{"load", "--rate", "nan"}, "nan"},
        {{"load", "--duration", "0"}, "--duration"},
        {{"load", "--min-fps", "-1"}, "--min-fps"},
        {{"load", "--acks", "some"}, "some"},
        {{"load", "--quality", "101"}, "--quality"},
        {{"load", "ws://127.0.0.1:1", "--max-growth-mb", "1"}, "--max-growth-"},
        {{"load", "ftp://127.0.0.1"}, "ftp://127.0.0.1"},
        {{"load", "ws://127.0.0.1:99999"}, "99999"},
        {{"load", "ws://:80"}, "host"},
        {{"load", "ws://127.0.0.1:1", "--data", "."}, "--data"},
    };
    for (const auto& [arguments, named] : rows) {
        const Outcome ran = runVolcast(arguments);
        EXPECT_EQ(ran.exitCode, 2) << named;
        EXPECT_THAT(ran.err + ran.out, HasSubstr(named));
    }
}

TEST(Load, AServerThatIsNotThereIsNamed) {
    const Outcome ran = runVolcast(small({"ws://127.0.0.1:1"}));
    EXPECT_EQ(ran.exitCode, 1);
    EXPECT_EQ(ran.out, "");
    EXPECT_THAT(ran.err, HasSubstr("no client could connect"));
}

TEST(Load, AServerThatDoesNotStartIsNamed) {
    const Outcome ran = runVolcast(small({"--data", "/nonexistent"}));
    EXPECT_EQ(ran.exitCode, 1);
    EXPECT_THAT(ran.err, HasSubstr("/nonexistent"));
    EXPECT_THAT(ran.err, HasSubstr("the server did not start"));
}

TEST(Load, HelpHasExamplesAndExitCodes) {
    const Outcome ran = runVolcast({"load", "--help"});
    EXPECT_EQ(ran.exitCode, 0);
    EXPECT_THAT(ran.out, HasSubstr("Examples:"));
    EXPECT_THAT(ran.out, HasSubstr("Exit code:"));
}

}  // namespace
}  // namespace volcast::test
