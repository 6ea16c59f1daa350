// Imports whose server dies: by SIGKILL, which leaves it no time to end them.
#include <csignal>
#include <filesystem>
#include <poll.h>
#include <sstream>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "server/workers/child_process.h"
#include "tests/e2e/import/import_fixture.h"
#include "tests/support/processes.h"

namespace volcast::test {
namespace {

/// A process that imports, as a server does. What it leaves behind becomes ours.
class OtherServer {
public:
    OtherServer(const workers::ImportRequest& request, const workers::ImportSettings& settings) {
        ::prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0);
        pid_ = ::fork();
        if (pid_ != 0) return;
        static_cast<void>(workers::runImport(request, settings, nullptr));
        ::_exit(0);
    }
    OtherServer(const OtherServer&) = delete;
    OtherServer& operator=(const OtherServer&) = delete;
    OtherServer(OtherServer&&) = delete;
    OtherServer& operator=(OtherServer&&) = delete;
    ~OtherServer() { kill(); }

    void kill() {
        if (pid_ <= 0) return;
        ::kill(pid_, SIGKILL);
        ::waitpid(pid_, nullptr, 0);
        pid_ = 0;
    }
    [[nodiscard]] int pid() const { return pid_; }
    /// The importer once it hangs: in its sandbox, about to read.
    [[nodiscard]] int hangingImporter() const {
        int found = 0;
        eventually([&] {
            for (const int child : childrenOf(pid_)) {
                const bool inside =
                    procText(child, "status").find("Seccomp:\t2") != std::string::npos;
                if (inside && stateOf(child) == "S") found = child;
            }
            return found != 0;
        });
        return found;
    }

private:
    int pid_ = 0;
};

/// How our child `pid` ended; 0 where it goes on, which is ended then.
int signalThatEnded(int pid) {
    const base::FileDescriptor process{static_cast<int>(::syscall(SYS_pidfd_open, pid, 0))};
    pollfd entry{.fd = process.get(), .events = POLLIN, .revents = 0};
    const auto patience = std::chrono::milliseconds{kPatience}.count();
    const bool ended = ::poll(&entry, 1, static_cast<int>(patience)) == 1;
    if (!ended) ::kill(pid, SIGKILL);
    int status = 0;
    ::waitpid(pid, &status, 0);
    return ended && WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

class Orphan : public Import {
protected:
    void SetUp() override {
        settings.fault = [] { return worker::FaultSpec{.fault = worker::Fault::kImportHang}; };
    }
};

TEST_F(Orphan, AHangingImportDiesWithItsServer) {
    std::filesystem::create_directory(folder.path("slices"));
    folder.write("slices/a1.png", "x");
    for (const std::string& path : {std::string{"demo:volume"}, folder.path("slices")}) {
        request.path = path;
        OtherServer server{request, settings};
        const int importer = server.hangingImporter();
        ASSERT_GT(importer, 0) << path;
        server.kill();
        EXPECT_EQ(signalThatEnded(importer), SIGKILL) << path;
    }
}

// A death before it could ask to be told of it: it finds another parent than it was started by.
TEST_F(Orphan, AnImportThatStartsWhenItsServerIsGoneEnds) {
    const std::string importer = workers::besideThisProgram("volcast-import");
    const pid_t child = ::fork();
    if (child == 0) {
        ::setenv("VOLCAST_PARENT", std::to_string(::getppid() + 1).c_str(), 1);
        ::execl(importer.c_str(), importer.c_str(), "--list-faults", nullptr);
        ::_exit(99);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == EXIT_FAILURE) << status;
}

TEST_F(Orphan, AnImportMayUseAllProcessorsUntilItsDeadlineAndNoMore) {
    settings.deadline = std::chrono::milliseconds{59'500};
    request.path = "demo:volume";
    const OtherServer server{request, settings};
    const int importer = server.hangingImporter();
    ASSERT_GT(importer, 0);
    std::istringstream limits{procText(importer, "limits")};
    std::string line;
    while (std::getline(limits, line) && !line.starts_with("Max cpu time")) {
    }
    std::istringstream row{line};
    std::string word;
    unsigned long soft = 0;
    unsigned long hard = 0;
    row >> word >> word >> word >> soft >> hard;
    const auto processors = static_cast<unsigned long>(::sysconf(_SC_NPROCESSORS_CONF));
    EXPECT_EQ(soft, 60 * processors + 1) << line;
    EXPECT_EQ(hard, soft) << line;
}

TEST_F(Orphan, AnImportIsEndedBeforeTheServerWhereMemoryRunsOut) {
    request.path = "demo:volume";
    const OtherServer server{request, settings};
    const int importer = server.hangingImporter();
    ASSERT_GT(importer, 0);
    EXPECT_EQ(std::stoi(procText(importer, "oom_score_adj")),
              std::min(std::stoi(procText(::getpid(), "oom_score_adj")) + 500, 1000));
}

}  // namespace
}  // namespace volcast::test
