// Nothing grows while views come and go and workers die. A long run:
//   VOLCAST_SOAK_ROUNDS=3000 build/release/bin/e2e_server --gtest_filter='Soak.*'
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>

#include "renderer/base/sandbox.h"
#include "tests/e2e/server/fault_stage.h"

namespace volcast::test {
namespace {

namespace fs = std::filesystem;

/// What a process holds.
struct Held {
    std::ptrdiff_t descriptors = 0, threads = 0;
    double residentMb = 0;
};

std::ostream& operator<<(std::ostream& out, const Held& held) {
    return out << held.descriptors << " descriptors, " << held.threads << " threads, "
               << held.residentMb << " MB";
}

std::ptrdiff_t entriesOf(const fs::path& folder) {
    std::error_code error;
    return std::distance(fs::directory_iterator{folder, error}, fs::directory_iterator{});
}

Held heldBy(int pid) {
    const fs::path process = fs::path{"/proc"} / std::to_string(pid);
    Held held{.descriptors = entriesOf(process / "fd"), .threads = entriesOf(process / "task")};
    std::ifstream status{process / "status"};
    for (std::string word; status >> word;) {
        if (word != "VmRSS:") continue;
        status >> held.residentMb;
        held.residentMb /= 1024.0;
    }
    return held;
}

int rounds(int usual) {
    const char* wanted = std::getenv("VOLCAST_SOAK_ROUNDS");
    return wanted != nullptr ? std::max(usual, std::atoi(wanted)) : usual;
}

/// Comes back to `before`, within what allocators keep. A picture that stays each round is 1 MB
/// for the server and, with its float targets, more than 4 MB for a worker: 20 rounds of either
/// are more than `slackMb`. Sanitizers hold on to freed memory; they tell of leaks by themselves.
void expectNoMore(int pid, const Held& before, double slackMb) {
    Held now;
    if (!base::kLimitsAddressSpace) slackMb = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(eventually([&] {
        now = heldBy(pid);
        return now.descriptors <= before.descriptors && now.threads <= before.threads &&
               now.residentMb <= before.residentMb + slackMb;
    })) << "process "
        << pid << " held " << before << " before and holds " << now;
    std::cout << "[   SOAK   ] process " << pid << ": " << before << "; then " << now << '\n';
}

constexpr std::uint32_t kSide = 512;
constexpr double kServerSlackMb = 12, kWorkerSlackMb = 24;

void lookOnce(TestClient& client, std::uint32_t view) {
    client.openView(view, "good.node", kSide, kSide);
    ASSERT_TRUE(client.waitForFrame(view, 1).has_value());
    v1::ClientMessage close;
    close.mutable_close_view()->set_view(view);
    client.send(close);
}

TEST(Soak, ViewsAndClientsThatComeAndGoLeaveNothing) {
    const FaultStage stage{{}};
    ASSERT_TRUE(stage.server->ready()) << stage.server->log();
    ASSERT_TRUE(stage.waitForSpare());
    TestClient client{stage.server->port()};
    ASSERT_TRUE(client.ok());
    Held server, worker;
    const int pid = stage.number("worker_pid");
    constexpr int kWarmUp = 8;
    const int last = kWarmUp + rounds(20);
    for (int round = 1; round <= last; ++round) {
        lookOnce(client, static_cast<std::uint32_t>(round));
        {
            TestClient guest{stage.server->port(), TestClient::Form::kJson};
            ASSERT_TRUE(guest.ok());
            lookOnce(guest, 1);
        }
        if (round != kWarmUp) continue;
        server = heldBy(stage.server->pid());
        worker = heldBy(pid);
    }
    ASSERT_EQ(stage.number("worker_pid"), pid) << stage.server->log();
    expectNoMore(stage.server->pid(), server, kServerSlackMb);
    expectNoMore(pid, worker, kWorkerSlackMb);
}

TEST(Soak, WorkersThatDieLeaveNothing) {
    const FaultStage stage{{}};
    ASSERT_TRUE(stage.server->ready()) << stage.server->log();
    TestClient client{stage.server->port()};
    ASSERT_TRUE(client.ok());
    client.openView(1, "good.node", kSide, kSide);
    ASSERT_TRUE(client.waitForFrame(1, 1).has_value());
    Held server;
    constexpr int kWarmUp = 3;
    const int last = kWarmUp + rounds(6);
    std::uint32_t generation = 1;
    for (int round = 1; round <= last; ++round) {
        ASSERT_TRUE(stage.waitForSpare()) << stage.server->log();
        ASSERT_EQ(::kill(stage.number("worker_pid"), SIGKILL), 0);
        ++generation;
        ASSERT_TRUE(client.waitForFrame([&](const TestFrame& frame) {
            return frame.header.worker_generation() >= generation;
        })) << stage.server->log();
        if (round != kWarmUp) continue;
        ASSERT_TRUE(stage.waitForSpare());
        server = heldBy(stage.server->pid());
    }
    ASSERT_TRUE(stage.waitForSpare());
    EXPECT_EQ(stage.number("losses"), last);
    // A packed dataset or a slot that stays mapped would show as a descriptor.
    expectNoMore(stage.server->pid(), server, kServerSlackMb);
}

}  // namespace
}  // namespace volcast::test
