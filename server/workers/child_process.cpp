#include "server/workers/child_process.h"

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

#include "renderer/base/subordinate.h"
#include "renderer/worker/channel.h"

namespace volcast::workers {

namespace {

/// Owns the two attribute objects of posix_spawn.
class SpawnAttributes {
public:
    SpawnAttributes() {
        posix_spawn_file_actions_init(&actions_);
        posix_spawnattr_init(&attributes_);
    }
    SpawnAttributes(const SpawnAttributes&) = delete;
    SpawnAttributes& operator=(const SpawnAttributes&) = delete;
    SpawnAttributes(SpawnAttributes&&) = delete;
    SpawnAttributes& operator=(SpawnAttributes&&) = delete;
    ~SpawnAttributes() {
        posix_spawn_file_actions_destroy(&actions_);
        posix_spawnattr_destroy(&attributes_);
    }

    /// Descriptors 0, 1, 2 and the channel; all others are closed.
    void setDescriptors(const SpawnDesc& desc) {
        posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        if (desc.output >= 0) {
            posix_spawn_file_actions_adddup2(&actions_, desc.output, STDOUT_FILENO);
        } else {
            posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        }
        int firstToClose = worker::kChannelFd;
        if (desc.channel >= 0) {
            posix_spawn_file_actions_adddup2(&actions_, desc.channel, worker::kChannelFd);
            ++firstToClose;
        }
        posix_spawn_file_actions_addclosefrom_np(&actions_, firstToClose);
    }

    /// Own process group, so that Ctrl-C in a terminal ends the server alone, which then ends its
    /// children; signals as a fresh program expects them.
    void setSignals() {
        sigset_t all;
        sigset_t none;
        sigfillset(&all);
        sigdelset(&all, SIGKILL);
        sigdelset(&all, SIGSTOP);
        sigemptyset(&none);
        posix_spawnattr_setsigdefault(&attributes_, &all);
        posix_spawnattr_setsigmask(&attributes_, &none);
        posix_spawnattr_setpgroup(&attributes_, 0);
        posix_spawnattr_setflags(
            &attributes_, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
    }

    [[nodiscard]] const posix_spawn_file_actions_t* actions() const { return &actions_; }
    [[nodiscard]] const posix_spawnattr_t* attributes() const { return &attributes_; }

private:
    posix_spawn_file_actions_t actions_{};
    posix_spawnattr_t attributes_{};
};

std::vector<char*> pointers(const std::vector<std::string>& texts) {
    std::vector<char*> result;
    result.reserve(texts.size() + 1);
    for (const std::string& text : texts) result.push_back(const_cast<char*>(text.c_str()));
    result.push_back(nullptr);
    return result;
}

}  // namespace

std::string ExitStatus::text() const {
    if (!signalled) return "exited with code " + std::to_string(value);
    const char* description = ::sigdescr_np(value);
    return "killed by signal " + std::to_string(value) +
           (description != nullptr ? std::string{" ("} + description + ")" : std::string{});
}

Result<ChildProcess> ChildProcess::spawn(const SpawnDesc& desc) {
    if (::access(desc.program.c_str(), X_OK) != 0) {
        return fail(ErrorCode::kNotFound, desc.program + ": " + std::strerror(errno));
    }
    SpawnAttributes spawn;
    spawn.setDescriptors(desc);
    spawn.setSignals();
    std::vector<std::string> words{desc.program};
    words.insert(words.end(), desc.arguments.begin(), desc.arguments.end());
    const std::vector<char*> arguments = pointers(words);
    // First, as the first of two equal names counts.
    std::vector<std::string> variables{base::kParentVariable + ("=" + std::to_string(::getpid()))};
    variables.insert(variables.end(), desc.environment.begin(), desc.environment.end());
    const std::vector<char*> environment = pointers(variables);
    pid_t pid = 0;
    const int error = ::posix_spawn(&pid, desc.program.c_str(), spawn.actions(), spawn.attributes(),
                                    arguments.data(), environment.data());
    if (error != 0) {
        return fail(ErrorCode::kIo, desc.program + ": cannot be started: " + std::strerror(error));
    }
    ChildProcess child;
    child.pid_ = pid;
    child.pidfd_ = base::FileDescriptor{static_cast<int>(::syscall(SYS_pidfd_open, pid, 0))};
    if (!child.pidfd_.valid()) {
        return fail(ErrorCode::kIo, desc.program + ": pidfd_open: " + std::strerror(errno));
    }
    return child;
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : pid_{std::exchange(other.pid_, 0)},
      pidfd_{std::move(other.pidfd_)},
      ended_{std::exchange(other.ended_, std::nullopt)} {}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
    ChildProcess taken{std::move(other)};
    std::swap(pid_, taken.pid_);
    std::swap(pidfd_, taken.pidfd_);
    std::swap(ended_, taken.ended_);
    return *this;
}

ChildProcess::~ChildProcess() {
    if (pid_ == 0 || ended_) return;
    kill();
    reap();
}

void ChildProcess::kill() noexcept {
    if (pid_ == 0 || ended_) return;
    if (pidfd_.valid()) {
        ::syscall(SYS_pidfd_send_signal, pidfd_.get(), SIGKILL, nullptr, 0);
    } else {
        ::kill(pid_, SIGKILL);  // Not reaped yet, so the id is still the child's.
    }
}

std::optional<ExitStatus> ChildProcess::wait(int options) noexcept {
    if (ended_ || pid_ == 0) return ended_;
    siginfo_t info{};
    int result = 0;
    do {
        result = ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | options);
    } while (result != 0 && errno == EINTR);
    if (result == 0 && info.si_pid == 0) return std::nullopt;
    // Where waiting fails there is no such child any more; that counts as an end, too.
    ended_ = ExitStatus{.signalled = result == 0 && info.si_code != CLD_EXITED,
                        .value = result == 0 ? info.si_status : 0};
    return ended_;
}

std::optional<ExitStatus> ChildProcess::tryReap() noexcept {
    return wait(WNOHANG);
}

ExitStatus ChildProcess::reap() noexcept {
    return wait(0).value_or(ExitStatus{});
}

std::string besideThisProgram(const std::string& program) {
    std::string self(4096, '\0');
    const ssize_t length = ::readlink("/proc/self/exe", self.data(), self.size());
    self.resize(length > 0 ? static_cast<std::size_t>(length) : 0);
    const std::size_t slash = self.rfind('/');
    return (slash == std::string::npos ? std::string{} : self.substr(0, slash + 1)) + program;
}

std::vector<std::string> inheritedEnvironment(const std::vector<std::string>& prefixes) {
    std::vector<std::string> result;
    for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
        const std::string_view variable{*entry};
        for (const std::string& prefix : prefixes) {
            if (!variable.starts_with(prefix)) continue;
            result.emplace_back(variable);
            break;
        }
    }
    return result;
}

}  // namespace volcast::workers
