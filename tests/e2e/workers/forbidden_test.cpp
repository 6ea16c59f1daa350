// What sandboxed processes must not be able to do is tried from inside of each.
#include "renderer/base/forbidden.h"

#include <array>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>

#include "renderer/base/sandbox.h"
#include "server/workers/child_process.h"
#include "tests/support/temporary_folder.h"

namespace volcast::test {
namespace {

using testing::HasSubstr;

struct Printed {
    int exitCode = -1;
    std::string text;
};

Printed run(const std::string& program, const std::string& arguments) {
    Printed printed;
    const std::string command = workers::besideThisProgram(program) + " " + arguments;
    FILE* output = ::popen(command.c_str(), "r");
    if (output == nullptr) return printed;
    std::array<char, 4096> part{};
    while (std::fgets(part.data(), part.size(), output) != nullptr) printed.text += part.data();
    const int status = ::pclose(output);
    printed.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return printed;
}

/// Every attempt was refused; what this kernel has no means to refuse is said.
void expectAllRefused(const Printed& printed) {
    EXPECT_EQ(printed.exitCode, 0) << printed.text;
    std::istringstream lines{printed.text};
    std::string line;
    std::size_t count = 0;
    while (std::getline(lines, line)) {
        ++count;
        if (line.find(": skipped (") != std::string::npos) {
            std::cout << "[ SKIPPED  ] " << line << '\n';
            EXPECT_EQ(base::sandboxFeatures().landlockAbi, 0) << line;
            continue;
        }
        EXPECT_NE(line.find(": refused ("), std::string::npos) << line;
    }
    EXPECT_GT(count, 50U);
    for (const char* what : {"socket of IPv4", "connect", "execve", "fork", "clone of a process",
                             "leave the process group", "leave the session", "outlive the parent",
                             "make a file", "read /etc/passwd", "list the home folder",
                             "ptrace of the parent", "tgkill of the parent", "mount", "io_uring",
                             "bpf", "keyctl", "userfaultfd", "a file past RLIMIT_FSIZE"}) {
        EXPECT_THAT(printed.text, HasSubstr(std::string{what} + ": ")) << what;
    }
}

TEST(Forbidden, IsRefusedInAWorker) {
    const support::TemporaryFolder cache;
    expectAllRefused(run("volcast-worker", "--try-forbidden --cache-dir " + cache.path().string()));
}

TEST(Forbidden, IsRefusedInAnImportOfEitherProgram) {
    expectAllRefused(run("volcast-import", "--try-forbidden demo:mesh"));
    const support::TemporaryFolder folder;
    expectAllRefused(run("volcast-import-images", "--try-forbidden " + folder.path().string()));
}

// The probe itself: without a sandbox it finds much that is let through.
TEST(Forbidden, IsFoundToBeLetThroughWithoutASandbox) {
    const support::TemporaryFolder folder;
    const pid_t child = ::fork();
    if (child == 0) {
        const std::vector<base::Tried> all = base::tryForbidden(folder.path().string());
        const std::string text = base::report(all);
        const bool found = text.find("socket of IPv4: LET THROUGH (done)") != std::string::npos &&
                           text.find("execve: LET THROUGH (ENOENT)") != std::string::npos &&
                           text.find("fork: LET THROUGH (done)") != std::string::npos &&
                           text.find("leave the process group: LET THROUGH") != std::string::npos &&
                           text.find("leave the session: LET THROUGH") != std::string::npos &&
                           text.find("outlive the parent: LET THROUGH") != std::string::npos &&
                           text.find("tgkill of the parent: LET THROUGH") != std::string::npos &&
                           text.find("make a file: LET THROUGH (done)") != std::string::npos &&
                           text.find("RLIMIT_FSIZE: LET THROUGH") != std::string::npos;
        if (!found) std::fputs(text.c_str(), stderr);
        ::_exit(found && !base::allRefused(all) ? 0 : 1);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

}  // namespace
}  // namespace volcast::test
