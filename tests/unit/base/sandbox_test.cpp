#include "renderer/base/sandbox.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <functional>
#include <linux/filter.h>
#include <sys/mman.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

#include "renderer/base/file_descriptor.h"
#include "renderer/base/seccomp_filter.h"

namespace volcast::base {
namespace {

constexpr int kSandboxFailed = 250;
constexpr int kKilled = 251;

/// Runs `body` in a child process; its result (0 to 249) is the child's exit status.
int inChild(const std::function<int()>& body) {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(body());
    int status = 0;
    if (::waitpid(child, &status, 0) != child) return kKilled;
    return WIFEXITED(status) ? WEXITSTATUS(status) : kKilled;
}

int inSandbox(const SandboxPolicy& policy, const std::function<int()>& body) {
    return inChild([&] {
        if (!enterSandbox(policy)) return kSandboxFailed;
        return body();
    });
}

/// errno of a call that failed, 0 of one that did not.
int errnoOf(long result) {
    return result < 0 ? errno : 0;
}

class Sandbox : public testing::Test {
protected:
    void SetUp() override {
        std::string pattern = testing::TempDir() + "volcast-sandbox-XXXXXX";
        ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
        std::filesystem::create_directory(folder_ + "/in");
        std::filesystem::create_directory(folder_ + "/out");
        std::ofstream{folder_ + "/in/data"} << "inside";
        std::ofstream{folder_ + "/secret"} << "outside";
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    [[nodiscard]] SandboxPolicy policy() const {
        return {.readable = {folder_ + "/in", "/usr", "/lib", "/lib64", "/bin", folder_ + "/none"},
                .writable = {folder_ + "/out"}};
    }
    [[nodiscard]] int openErrno(const std::string& name, int flags) const {
        return errnoOf(::open((folder_ + name).c_str(), flags, 0600));
    }

    std::string folder_;  // NOLINT(readability-identifier-naming)
};

TEST_F(Sandbox, RefusesTheNetwork) {
    for (const int family : {AF_INET, AF_INET6, AF_NETLINK, AF_PACKET, AF_UNIX, AF_VSOCK}) {
        EXPECT_EQ(inSandbox(policy(), [&] { return errnoOf(::socket(family, SOCK_DGRAM, 0)); }),
                  EPERM)
            << "family " << family;
    }
}

TEST_F(Sandbox, KeepsSocketPairsAndMemfds) {
    EXPECT_EQ(inSandbox(policy(),
                        [] {
                            int ends[2] = {-1, -1};
                            const int made = ::socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends);
                            const int memory = ::memfd_create("x", MFD_ALLOW_SEALING);
                            return made == 0 && memory >= 0 && ::write(ends[0], "a", 1) == 1 &&
                                           ::ftruncate(memory, 4096) == 0
                                       ? 0
                                       : 1;
                        }),
              0);
}

TEST_F(Sandbox, RefusesOtherProcessesMountsNamespacesAndKernelCalls) {
    const std::vector<std::function<long()>> calls{
        [] { return ::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr); },
        [] { return ::mount("none", "/mnt", "tmpfs", 0, nullptr); },
        [] { return ::syscall(SYS_unshare, CLONE_NEWUSER); },
        [] { return ::syscall(SYS_setns, 0, 0); },
        [] { return ::syscall(SYS_keyctl, 0, 0, 0, 0, 0); },
        [] { return ::syscall(SYS_bpf, 0, nullptr, 0); },
        [] { return ::syscall(SYS_process_vm_readv, ::getppid(), nullptr, 0, nullptr, 0, 0); },
        [] { return ::syscall(SYS_kexec_load, 0, 0, nullptr, 0); },
        [] { return ::syscall(SYS_init_module, nullptr, 0, ""); },
        [] { return ::syscall(SYS_io_uring_setup, 1, nullptr); },
        [] { return ::syscall(SYS_perf_event_open, nullptr, 0, 0, -1, 0); },
        [] { return ::syscall(SYS_open_by_handle_at, 0, nullptr, 0); },
        [] { return ::syscall(SYS_capset, nullptr, nullptr); },
        [] { return static_cast<long>(::kill(::getppid(), 0)); },
    };
    for (std::size_t i = 0; i < calls.size(); ++i) {
        EXPECT_EQ(inSandbox(policy(), [&] { return errnoOf(calls[i]()); }), EPERM) << "call " << i;
    }
}

TEST_F(Sandbox, RefusesToExecuteAndToForkUnlessAllowed) {
    const auto fork = [] { return errnoOf(::syscall(SYS_fork)); };
    const auto cloneLikeFork = [] { return errnoOf(::syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0)); };
    const auto execute = [] {
        ::execl("/bin/true", "true", nullptr);
        return errno;
    };
    EXPECT_EQ(inSandbox(policy(), fork), EPERM);
    EXPECT_EQ(inSandbox(policy(), cloneLikeFork), EPERM);
    EXPECT_EQ(inSandbox(policy(), execute), EPERM);
    SandboxPolicy generous = policy();
    generous.mayExecute = true;
    EXPECT_EQ(inSandbox(generous, execute), 0);  // The status of /bin/true itself.
    EXPECT_EQ(inSandbox(generous, [] { return WEXITSTATUS(std::system("exit 7")); }), 7);
    EXPECT_EQ(
        inSandbox(
            generous,
            [] { return errnoOf(::syscall(SYS_clone, CLONE_NEWUSER | SIGCHLD, 0, 0, 0, 0)); }),
        EPERM);
}

// Its process group is what its server ends it by, and its parent's death the other way.
TEST_F(Sandbox, NobodyLeavesTheGroupAndOnlyWhatExecutesTiesItselfToAnotherParent) {
    const auto leaveGroup = [] { return errnoOf(::setpgid(0, 0)); };
    const auto leaveSession = [] { return errnoOf(::syscall(SYS_setsid)); };
    const auto die = [] {
        return errnoOf(::syscall(SYS_prctl, (1UL << 32) | PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0));
    };
    SandboxPolicy generous = policy();
    generous.mayExecute = true;
    for (const SandboxPolicy& one : {policy(), generous}) {
        EXPECT_EQ(inSandbox(one, leaveGroup), EPERM);
        EXPECT_EQ(inSandbox(one, leaveSession), EPERM);
    }
    EXPECT_EQ(inSandbox(policy(), die), EPERM);
    EXPECT_EQ(inSandbox(generous, die), 0);
}

TEST_F(Sandbox, ASecondCallTakesExecutionAway) {
    EXPECT_EQ(inChild([&] {
                  SandboxPolicy generous = policy();
                  generous.mayExecute = true;
                  if (!enterSandbox(generous) || !enterSandbox(policy())) return kSandboxFailed;
                  ::execl("/bin/true", "true", nullptr);
                  return errno;
              }),
              EPERM);
}

TEST_F(Sandbox, ThreadsStartWhereAllowed) {
    const auto startThread = [] {
        int seen = 0;
        try {
            std::thread{[&seen] { seen = 1; }}.join();
        } catch (const std::system_error&) {
            return 2;
        }
        return seen == 1 ? 0 : 1;
    };
    EXPECT_EQ(inSandbox(policy(), startThread), 0);
    SandboxPolicy alone = policy();
    alone.mayUseThreads = false;
    EXPECT_EQ(inSandbox(alone, startThread), 2);
}

TEST_F(Sandbox, LeavesOnlyTheNamedFiles) {
    if (sandboxFeatures().landlockAbi == 0) GTEST_SKIP() << "this kernel has no Landlock";
    const auto sandboxed = [&](const char* name, int flags) {
        return inSandbox(policy(), [&] { return openErrno(name, flags); });
    };
    EXPECT_EQ(sandboxed("/in/data", O_RDONLY), 0);
    EXPECT_EQ(sandboxed("/in/data", O_WRONLY), EACCES);
    EXPECT_NE(sandboxed("/in/data", O_RDONLY | O_TRUNC), 0);
    EXPECT_EQ(sandboxed("/in/new", O_WRONLY | O_CREAT), EACCES);
    EXPECT_EQ(sandboxed("/secret", O_RDONLY), EACCES);
    EXPECT_EQ(sandboxed("/in/../secret", O_RDONLY), EACCES);
    EXPECT_EQ(sandboxed("/out/new", O_RDWR | O_CREAT), 0);
    EXPECT_EQ(std::filesystem::file_size(folder_ + "/in/data"), 6U);
}

TEST_F(Sandbox, LimitsMemoryForGood) {
    if (!kLimitsAddressSpace) GTEST_SKIP() << "a sanitizer needs more addresses than any limit";
    SandboxPolicy limited = policy();
    limited.maxAddressSpaceBytes = std::uint64_t{256} << 20;
    EXPECT_EQ(inSandbox(limited,
                        [] {
                            return ::mmap(nullptr, std::size_t{512} << 20, PROT_READ,
                                          MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) == MAP_FAILED
                                       ? errno
                                       : 0;
                        }),
              ENOMEM);
    EXPECT_EQ(inSandbox(limited,
                        [] {
                            const rlimit more{RLIM_INFINITY, RLIM_INFINITY};
                            return errnoOf(::setrlimit(RLIMIT_AS, &more));
                        }),
              EPERM);
}

TEST_F(Sandbox, LimitsFileSizeAndCpuTime) {
    SandboxPolicy limited = policy();
    limited.maxFileBytes = 4096;
    limited.maxCpuSeconds = 60;
    EXPECT_EQ(inSandbox(limited, [] { return errnoOf(::ftruncate(::memfd_create("x", 0), 4097)); }),
              EFBIG);
    EXPECT_EQ(inSandbox(limited,
                        [] {
                            rlimit cpu{};
                            ::getrlimit(RLIMIT_CPU, &cpu);
                            return static_cast<int>(cpu.rlim_max);
                        }),
              60);
}

// Mesa's JIT writes code and runs it from the same pages.
TEST_F(Sandbox, AllowsMemoryThatIsWritableAndExecutable) {
    EXPECT_EQ(inSandbox(policy(),
                        [] {
                            void* page = ::mmap(nullptr, 4096, PROT_READ | PROT_WRITE | PROT_EXEC,
                                                MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
                            return page == MAP_FAILED ? errno : 0;
                        }),
              0);
}

TEST_F(Sandbox, TheExportedProgramRefusesTheSame) {
    const auto program = seccompProgram({.mayExecute = false});
    ASSERT_TRUE(program.has_value()) << program.error().message;
    ASSERT_EQ(program->size() % sizeof(sock_filter), 0U);
    EXPECT_EQ(inChild([&] {
                  std::vector<sock_filter> filter(program->size() / sizeof(sock_filter));
                  std::memcpy(filter.data(), program->data(), program->size());
                  sock_fprog loaded{.len = static_cast<unsigned short>(filter.size()),
                                    .filter = filter.data()};
                  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
                  if (::prctl(PR_SET_SECCOMP, 2, &loaded) != 0) return kSandboxFailed;
                  ::execl("/bin/true", "true", nullptr);
                  return errno;
              }),
              EPERM);
}

TEST(SandboxFeatures, ThisKernelFiltersSystemCalls) {
    const SandboxFeatures features = sandboxFeatures();
    EXPECT_TRUE(features.seccomp);
    EXPECT_TRUE(features.noNewPrivileges);
    EXPECT_GE(features.landlockAbi, 0);
}

}  // namespace
}  // namespace volcast::base
