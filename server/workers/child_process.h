#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/base/file_descriptor.h"
#include "renderer/base/result.h"

namespace volcast::workers {

/// How a child is started. It gets no descriptor but those named here and our stderr.
struct SpawnDesc {
    std::string program;                   ///< Path of the executable.
    std::vector<std::string> arguments;    ///< Without argv[0].
    std::vector<std::string> environment;  ///< "NAME=value"; the child gets no other variable
                                           ///< but base::kParentVariable.
    int channel = -1;                      ///< Becomes worker::kChannelFd in the child; -1: none.
    int output = -1;                       ///< Becomes stdout in the child; -1: /dev/null.
};

/// How a child ended.
struct ExitStatus {
    bool signalled = false;
    int value = 0;  ///< The signal, or the exit code.
    /// Such as "killed by signal 9 (Killed)" or "exited with code 3".
    [[nodiscard]] std::string text() const;
};

/// Owns one child process in a process group of its own. Kills and reaps it when destroyed, so
/// that neither a process nor a zombie is left.
class ChildProcess {
public:
    ChildProcess() = default;
    /// Errors: kNotFound (no such program), kIo (cannot be started).
    static Result<ChildProcess> spawn(const SpawnDesc& desc);
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;
    ChildProcess(ChildProcess&& other) noexcept;
    ChildProcess& operator=(ChildProcess&& other) noexcept;
    ~ChildProcess();

    [[nodiscard]] int pid() const noexcept { return pid_; }
    /// Readable once the child has ended; -1 for an empty object.
    [[nodiscard]] int pidfd() const noexcept { return pidfd_.get(); }

    /// Sends SIGKILL; harmless where the child has ended.
    void kill() noexcept;
    /// Reaps the child if it has ended. Empty: it runs.
    std::optional<ExitStatus> tryReap() noexcept;
    /// Waits for the end.
    ExitStatus reap() noexcept;

private:
    std::optional<ExitStatus> wait(int options) noexcept;

    int pid_ = 0;
    base::FileDescriptor pidfd_;
    std::optional<ExitStatus> ended_;
};

/// Path of `program` in the folder of the running executable.
std::string besideThisProgram(const std::string& program);

/// "NAME=value" of all variables of our environment whose name begins with one of `prefixes`.
std::vector<std::string> inheritedEnvironment(const std::vector<std::string>& prefixes);

}  // namespace volcast::workers
