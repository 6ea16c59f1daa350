#include "renderer/data/load/reader_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include "renderer/base/seccomp_filter.h"

namespace volcast::data::load {

namespace {

constexpr const char* kPython = "/usr/bin/python3";
constexpr int kRecordsFd = 3;
constexpr int kFilterFd = 4;

Error systemError(const std::string& what, int error) {
    return fail(ErrorCode::kIo, what + ": " + std::strerror(error));
}

/// The filter that the child loads before it opens the file, as a file of its own.
Result<base::FileDescriptor> filterFile() {
    auto program = base::seccompProgram({.mayExecute = false});
    if (!program) return program.error();
    base::FileDescriptor file{::memfd_create("reader-filter", MFD_CLOEXEC)};
    if (!file.valid()) return systemError("the reader's filter", errno);
    const auto size = static_cast<ssize_t>(program->size());
    if (::pwrite(file.get(), program->data(), program->size(), 0) != size) {
        return systemError("the reader's filter", errno);
    }
    return file;
}

/// Numerical libraries would each reserve memory for a pool of threads that nobody needs here.
constexpr std::array<const char*, 6> kEnvironment{
    "LC_ALL=C.UTF-8",    "HOME=/nonexistent",           "OPENBLAS_NUM_THREADS=1",
    "OMP_NUM_THREADS=1", "HDF5_USE_FILE_LOCKING=FALSE", nullptr};

int spawnPython(const std::string& program, const std::string& path, int records, int filter,
                int complaints, pid_t& pid) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, complaints, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, complaints, STDERR_FILENO);
    posix_spawn_file_actions_adddup2(&actions, records, kRecordsFd);
    posix_spawn_file_actions_adddup2(&actions, filter, kFilterFd);
    posix_spawn_file_actions_addclosefrom_np(&actions, kFilterFd + 1);
    std::vector<std::string> words{kPython,
                                   "-I",
                                   "-B",
                                   "-c",
                                   program,
                                   path,
                                   std::to_string(kRecordsFd),
                                   std::to_string(kFilterFd),
                                   std::to_string(::getpid())};
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    auto* environment = const_cast<char**>(kEnvironment.data());
    const int error =
        ::posix_spawn(&pid, kPython, &actions, nullptr, arguments.data(), environment);
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

/// The last line that is not empty.
std::string lastLine(const base::FileDescriptor& file) {
    struct stat info {};
    if (::fstat(file.get(), &info) != 0) return {};
    constexpr off_t kTail = 2000;
    std::string text(static_cast<std::size_t>(std::min(info.st_size, kTail)), '\0');
    const ssize_t got = ::pread(file.get(), text.data(), text.size(),
                                info.st_size - static_cast<off_t>(text.size()));
    text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    while (!text.empty() && text.back() == '\n') text.pop_back();
    const std::size_t start = text.rfind('\n');
    return start == std::string::npos ? text : text.substr(start + 1);
}

}  // namespace

Result<ReaderProcess> ReaderProcess::start(const std::string& program, const std::string& path) {
    if (::access(kPython, X_OK) != 0) {
        return fail(ErrorCode::kNotFound, std::string{kPython} + ": " + std::strerror(errno) +
                                              " (the package python3 is needed for this format)");
    }
    auto filter = filterFile();
    if (!filter) return filter.error();
    std::array<int, 2> ends{-1, -1};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return systemError("the reader's pipe", errno);
    base::FileDescriptor readEnd{ends[0]};
    base::FileDescriptor writeEnd{ends[1]};
    constexpr int kPipeBytes = 1 << 20;
    ::fcntl(writeEnd.get(), F_SETPIPE_SZ, kPipeBytes);  // Only for speed: may be refused.
    base::FileDescriptor complaints{::memfd_create("reader-stderr", MFD_CLOEXEC)};
    if (!complaints.valid()) return systemError("the reader's stderr", errno);
    // Targets of dup2 are low: move ours out of their way.
    const base::FileDescriptor records{::fcntl(writeEnd.get(), F_DUPFD_CLOEXEC, 10)};
    const base::FileDescriptor program4{::fcntl(filter->get(), F_DUPFD_CLOEXEC, 10)};
    if (!records.valid() || !program4.valid()) return systemError("the reader's pipe", errno);
    pid_t pid = 0;
    const int error =
        spawnPython(program, path, records.get(), program4.get(), complaints.get(), pid);
    if (error != 0) return systemError(kPython, error);
    return ReaderProcess{pid, std::move(readEnd), std::move(complaints)};
}

std::string ReaderProcess::finish() {
    records_ = {};
    int status = 0;
    pid_t ended = 0;
    do {
        ended = ::waitpid(pid_, &status, 0);
    } while (ended < 0 && errno == EINTR);
    if (ended != pid_) return "its reader is gone";
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
    const std::string how = WIFSIGNALED(status)
                                ? "killed by signal " + std::to_string(WTERMSIG(status))
                                : "exited with code " + std::to_string(WEXITSTATUS(status));
    const std::string last = lastLine(complaints_);
    return how + (last.empty() ? "" : ": " + last);
}

}  // namespace volcast::data::load
