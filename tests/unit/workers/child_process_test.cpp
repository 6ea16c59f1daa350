#include "server/workers/child_process.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace volcast::workers {
namespace {

constexpr int kPatienceMs = 20'000;

SpawnDesc shell(const std::string& script) {
    return {.program = "/bin/sh", .arguments = {"-c", script}, .environment = {}};
}

bool endsInTime(const ChildProcess& child) {
    pollfd entry{.fd = child.pidfd(), .events = POLLIN, .revents = 0};
    return ::poll(&entry, 1, kPatienceMs) == 1;
}

/// All that `script` prints.
std::string outputOf(SpawnDesc desc) {
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
    const base::FileDescriptor reading{ends[0]};
    base::FileDescriptor writing{ends[1]};
    desc.output = writing.get();
    auto child = ChildProcess::spawn(desc);
    EXPECT_TRUE(child.has_value()) << child.error().message;
    writing = {};
    std::string text;
    std::array<char, 4096> buffer{};
    for (;;) {
        const ssize_t size = ::read(reading.get(), buffer.data(), buffer.size());
        if (size <= 0) break;
        text.append(buffer.data(), static_cast<std::size_t>(size));
    }
    return text;
}

TEST(ChildProcess, ReportsTheExitCode) {
    auto child = ChildProcess::spawn(shell("exit 7"));
    ASSERT_TRUE(child.has_value()) << child.error().message;
    ASSERT_TRUE(endsInTime(*child));
    const ExitStatus status = child->reap();
    EXPECT_FALSE(status.signalled);
    EXPECT_EQ(status.value, 7);
    EXPECT_EQ(status.text(), "exited with code 7");
}

TEST(ChildProcess, ReportsTheSignal) {
    auto child = ChildProcess::spawn(shell("kill -SEGV $$"));
    ASSERT_TRUE(child.has_value());
    ASSERT_TRUE(endsInTime(*child));
    const ExitStatus status = child->reap();
    EXPECT_TRUE(status.signalled);
    EXPECT_EQ(status.value, SIGSEGV);
    EXPECT_EQ(status.text(), "killed by signal 11 (Segmentation fault)");
}

TEST(ChildProcess, IsRunningUntilItIsKilled) {
    auto child = ChildProcess::spawn(shell("exec sleep 1000"));
    ASSERT_TRUE(child.has_value());
    EXPECT_FALSE(child->tryReap().has_value());
    child->kill();
    ASSERT_TRUE(endsInTime(*child));
    EXPECT_EQ(child->reap().value, SIGKILL);
    child->kill();  // Harmless: the process is known to be gone.
}

TEST(ChildProcess, AStoppedProcessDiesToo) {
    auto child = ChildProcess::spawn(shell("kill -STOP $$"));
    ASSERT_TRUE(child.has_value());
    siginfo_t info{};
    ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(child->pid()), &info, WSTOPPED), 0);
    child->kill();
    ASSERT_TRUE(endsInTime(*child));
    EXPECT_EQ(child->reap().value, SIGKILL);
}

TEST(ChildProcess, NothingIsLeftAfterItsOwner) {
    int pid = 0;
    {
        auto child = ChildProcess::spawn(shell("exec sleep 1000"));
        ASSERT_TRUE(child.has_value());
        pid = child->pid();
        EXPECT_EQ(::kill(pid, 0), 0);
    }
    EXPECT_EQ(::kill(pid, 0), -1);
    EXPECT_EQ(errno, ESRCH);
}

TEST(ChildProcess, InheritsOnlyWhatItIsGiven) {
    const base::FileDescriptor leaked{::open("/dev/full", O_WRONLY)};  // Without O_CLOEXEC.
    const base::FileDescriptor leakedToo{::fcntl(leaked.get(), F_DUPFD, 20)};
    ASSERT_TRUE(leakedToo.valid());
    const base::FileDescriptor channel{::open("/dev/zero", O_RDONLY | O_CLOEXEC)};
    SpawnDesc desc = shell("cd /proc/self/fd; for fd in *; do readlink $fd; done; env");
    desc.channel = channel.get();
    desc.environment = {"NAME=only"};
    const std::string output = outputOf(desc);
    EXPECT_NE(output.find("/dev/zero"), std::string::npos) << output;
    EXPECT_NE(output.find("NAME=only"), std::string::npos) << output;
    EXPECT_EQ(output.find("HOME="), std::string::npos) << output;
    EXPECT_EQ(output.find("/dev/full"), std::string::npos) << output;
}

TEST(ChildProcess, HasAProcessGroupOfItsOwn) {
    auto child = ChildProcess::spawn(shell("exec sleep 1000"));
    ASSERT_TRUE(child.has_value());
    EXPECT_EQ(::getpgid(child->pid()), child->pid());
}

TEST(ChildProcess, NamesAProgramThatDoesNotExist) {
    const auto child = ChildProcess::spawn(
        {.program = "/nonexistent/volcast-worker", .arguments = {}, .environment = {}});
    ASSERT_FALSE(child.has_value());
    EXPECT_EQ(child.error().code, ErrorCode::kNotFound);
    EXPECT_NE(child.error().message.find("/nonexistent/volcast-worker"), std::string::npos);
}

TEST(InheritedEnvironment, TakesVariablesByTheBeginningOfTheirName) {
    ::setenv("VOLCAST_TEST_ONE", "1", 1);
    ::setenv("VOLCAST_TEST_TWO", "2", 1);
    ::setenv("OTHER_VOLCAST_TEST", "3", 1);
    const auto found = inheritedEnvironment({"VOLCAST_TEST_"});
    EXPECT_EQ(found.size(), 2U);
    EXPECT_EQ(std::count(found.begin(), found.end(), "VOLCAST_TEST_ONE=1"), 1);
    EXPECT_EQ(std::count(found.begin(), found.end(), "VOLCAST_TEST_TWO=2"), 1);
}

}  // namespace
}  // namespace volcast::workers
