#include "renderer/base/forbidden.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <functional>
#include <netinet/in.h>
#include <sched.h>
#include <sys/inotify.h>
#include <sys/ipc.h>
#include <sys/mman.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "renderer/base/landlock.h"

namespace volcast::base {

namespace {

/// Numbers that Debian 12's headers lack; the same on all architectures.
constexpr long kFchmodat2 = 452;
constexpr long kSetxattrat = 463;

enum class Needs { kSeccomp, kLandlock };

struct Attempt {
    const char* what;
    Needs needs;
    std::function<long()> act;  ///< Negative, with errno, where it was refused.
};

/// What is refused only after it was looked at shows the kernel's reason, not the sandbox's: such
/// calls get arguments that would do nothing.
long call(long number, long a = 0, long b = 0, long c = 0, long d = 0, long e = 0) {
    return ::syscall(number, a, b, c, d, e, 0L);
}

/// A child that was made all the same ends at once.
long unlessChild(long pid) {
    if (pid == 0) ::_exit(EXIT_SUCCESS);
    return pid;
}

long connectTo(sa_family_t family) {
    int ends[2] = {-1, -1};
    if (::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) return -1;
    sockaddr_storage address{};
    address.ss_family = family;
    const int result =
        ::connect(ends[0], reinterpret_cast<const sockaddr*>(&address), sizeof(address));
    const int error = errno;
    ::close(ends[0]);
    ::close(ends[1]);
    errno = error;
    return result;
}

/// Sets the signal that the parent's death sends to what it is.
long keepParentDeathSignal() {
    int now = 0;
    ::prctl(PR_GET_PDEATHSIG, &now, 0, 0, 0);
    return ::prctl(PR_SET_PDEATHSIG, now, 0, 0, 0);
}

long openIn(const std::string& path, int flags) {
    const int fd = ::open(path.c_str(), flags | O_CLOEXEC, 0600);
    if (fd >= 0) ::close(fd);
    return fd;
}

long makeIn(const std::string& path) {
    const long made = openIn(path, O_WRONLY | O_CREAT | O_EXCL);
    if (made >= 0) ::unlink(path.c_str());
    return made;
}

std::vector<Attempt> network() {
    return {
        {"socket of IPv4", Needs::kSeccomp, [] { return ::socket(AF_INET, SOCK_STREAM, 0); }},
        {"socket of IPv6", Needs::kSeccomp, [] { return ::socket(AF_INET6, SOCK_DGRAM, 0); }},
        {"socket of netlink", Needs::kSeccomp, [] { return ::socket(AF_NETLINK, SOCK_RAW, 0); }},
        {"socket of Unix", Needs::kSeccomp, [] { return ::socket(AF_UNIX, SOCK_STREAM, 0); }},
        {"connect", Needs::kSeccomp, [] { return connectTo(AF_INET); }},
        {"bind", Needs::kSeccomp, [] { return call(SYS_bind, -1); }},
        {"listen", Needs::kSeccomp, [] { return call(SYS_listen, -1); }},
    };
}

std::vector<Attempt> processes() {
    const long parent = ::getppid();
    return {
        {"execve", Needs::kSeccomp,
         [] {
             char* none[] = {nullptr};
             return ::execve("/nowhere", none, none);
         }},
        {"execveat", Needs::kSeccomp, [] { return call(SYS_execveat, -1); }},
        {"fork", Needs::kSeccomp, [] { return unlessChild(call(SYS_fork)); }},
        {"clone of a process", Needs::kSeccomp,
         [] { return unlessChild(call(SYS_clone, SIGCHLD)); }},
        {"clone3", Needs::kSeccomp, [] { return call(SYS_clone3); }},
        {"leave the process group", Needs::kSeccomp,
         [] { return call(SYS_setpgid, 0, ::getpgrp()); }},
        {"leave the session", Needs::kSeccomp, [] { return call(SYS_setsid); }},
        {"outlive the parent", Needs::kSeccomp, [] { return keepParentDeathSignal(); }},
        {"kill of the parent", Needs::kSeccomp, [=] { return call(SYS_kill, parent, 0); }},
        {"tkill of the parent", Needs::kSeccomp, [=] { return call(SYS_tkill, parent, 0); }},
        {"tgkill of the parent", Needs::kSeccomp,
         [=] { return call(SYS_tgkill, parent, parent, 0); }},
        {"queued signal to the parent", Needs::kSeccomp,
         [=] { return call(SYS_rt_sigqueueinfo, parent, 0); }},
        {"ptrace of the parent", Needs::kSeccomp,
         [=] { return ::ptrace(PTRACE_SEIZE, static_cast<pid_t>(parent), nullptr, nullptr); }},
        {"memory of the parent", Needs::kSeccomp,
         [=] { return call(SYS_process_vm_readv, parent); }},
        {"limits of the parent", Needs::kSeccomp,
         [=] { return call(SYS_prlimit64, parent, RLIMIT_NOFILE); }},
        {"priority of the parent", Needs::kSeccomp,
         [=] {
             const int now = ::getpriority(PRIO_PROCESS, static_cast<id_t>(parent));
             return call(SYS_setpriority, PRIO_PROCESS, parent, now);
         }},
        {"processors of the parent", Needs::kSeccomp,
         [=] { return call(SYS_sched_setaffinity, parent); }},
        {"pages of the parent", Needs::kSeccomp, [=] { return call(SYS_move_pages, parent); }},
        {"descriptors of the parent", Needs::kSeccomp, [] { return call(SYS_pidfd_getfd, -1); }},
        {"environment of the parent", Needs::kLandlock,
         [=] { return openIn("/proc/" + std::to_string(parent) + "/environ", O_RDONLY); }},
        {"shared memory of System V", Needs::kSeccomp,
         [] { return call(SYS_shmget, IPC_PRIVATE, 4096, 0600); }},
    };
}

std::vector<Attempt> files(const std::string& outside) {
    const char* home = std::getenv("HOME");
    const std::string user = home != nullptr && *home == '/' ? home : "/root";
    return {
        {"read /etc/passwd", Needs::kLandlock, [] { return openIn("/etc/passwd", O_RDONLY); }},
        {"list the home folder", Needs::kLandlock,
         [=] { return openIn(user, O_RDONLY | O_DIRECTORY); }},
        {"list /tmp", Needs::kLandlock, [] { return openIn("/tmp", O_RDONLY | O_DIRECTORY); }},
        {"make a file", Needs::kLandlock, [=] { return makeIn(outside + "/made-inside"); }},
        {"make a folder", Needs::kLandlock,
         [=] {
             const std::string made = outside + "/made-inside";
             const int result = ::mkdir(made.c_str(), 0700);
             if (result == 0) ::rmdir(made.c_str());
             return result;
         }},
        {"make a link", Needs::kLandlock,
         [=] {
             const std::string made = outside + "/made-inside";
             const int result = ::symlink("/etc/passwd", made.c_str());
             if (result == 0) ::unlink(made.c_str());
             return result;
         }},
        {"write to a program", Needs::kLandlock, [] { return openIn("/usr/bin/env", O_WRONLY); }},
        {"watch files", Needs::kSeccomp, [] { return ::inotify_init1(IN_CLOEXEC); }},
        {"chmod", Needs::kSeccomp, [=] { return ::chmod((outside + "/none").c_str(), 0700); }},
        {"fchmodat2", Needs::kSeccomp, [] { return call(kFchmodat2, -1); }},
        {"setxattr", Needs::kSeccomp, [] { return call(SYS_setxattr); }},
        {"setxattrat", Needs::kSeccomp, [] { return call(kSetxattrat, -1); }},
        {"truncate", Needs::kSeccomp, [=] { return ::truncate((outside + "/none").c_str(), 0); }},
        {"openat2", Needs::kSeccomp, [] { return call(SYS_openat2, -1); }},
        {"open by handle", Needs::kSeccomp, [] { return call(SYS_open_by_handle_at, -1); }},
    };
}

std::vector<Attempt> kernel() {
    return {
        {"mount", Needs::kSeccomp, [] { return ::mount("none", "/mnt", "tmpfs", 0, nullptr); }},
        {"umount", Needs::kSeccomp, [] { return ::umount2("/nowhere", 0); }},
        {"chroot", Needs::kSeccomp, [] { return ::chroot("/nowhere"); }},
        {"user namespace", Needs::kSeccomp, [] { return ::unshare(CLONE_NEWUSER); }},
        {"setns", Needs::kSeccomp, [] { return call(SYS_setns, -1); }},
        {"io_uring", Needs::kSeccomp, [] { return call(SYS_io_uring_setup, 1); }},
        {"bpf", Needs::kSeccomp, [] { return call(SYS_bpf); }},
        {"keyctl", Needs::kSeccomp, [] { return call(SYS_keyctl); }},
        {"add_key", Needs::kSeccomp, [] { return call(SYS_add_key); }},
        {"userfaultfd", Needs::kSeccomp, [] { return call(SYS_userfaultfd); }},
        {"perf_event_open", Needs::kSeccomp,
         [] { return call(SYS_perf_event_open, 0, 0, -1, -1); }},
        {"kernel module", Needs::kSeccomp, [] { return call(SYS_finit_module, -1); }},
        {"kexec", Needs::kSeccomp, [] { return call(SYS_kexec_load); }},
        {"set the clock", Needs::kSeccomp, [] { return call(SYS_clock_settime, -1); }},
        {"capset", Needs::kSeccomp, [] { return call(SYS_capset); }},
        {"setuid", Needs::kSeccomp, [] { return ::setuid(::getuid()); }},
        {"personality", Needs::kSeccomp, [] { return call(SYS_personality, 0xffffffff); }},
        {"type into the terminal", Needs::kSeccomp,
         [] { return call(SYS_ioctl, -1, 0x5412 /* TIOCSTI */); }},
    };
}

/// Writes past a limit into memory of its own; raises a limit that was lowered.
std::vector<Attempt> limits() {
    return {
        {"raise a limit", Needs::kSeccomp,
         [] {
             const rlimit more{RLIM_INFINITY, RLIM_INFINITY};
             return ::setrlimit(RLIMIT_CORE, &more);
         }},
        {"a file past RLIMIT_FSIZE", Needs::kSeccomp,
         []() -> long {
             rlimit now{};
             ::getrlimit(RLIMIT_FSIZE, &now);
             if (now.rlim_cur == RLIM_INFINITY) return 0;
             const int memory = ::memfd_create("large", MFD_CLOEXEC);
             const int result = ::ftruncate(memory, static_cast<off_t>(now.rlim_cur) + 1);
             const int error = errno;
             ::close(memory);
             errno = error;
             return result;
         }},
    };
}

Tried tried(const Attempt& attempt, bool landlock) {
    Tried result{.what = attempt.what, .refused = false, .how = {}, .skipped = false};
    if (attempt.needs == Needs::kLandlock && !landlock) {
        result.skipped = true;
        result.how = "this kernel has no Landlock";
        return result;
    }
    errno = 0;
    const long outcome = attempt.act();
    // What the sandbox refuses; any other error is of a call that was let through.
    result.refused =
        outcome < 0 && (errno == EPERM || errno == EACCES || errno == ENOSYS || errno == EFBIG);
    result.how = outcome < 0 ? ::strerrorname_np(errno) : "done";
    return result;
}

}  // namespace

std::vector<Tried> tryForbidden(const std::string& outside) {
    const bool landlock = landlockAbi() > 0;
    std::vector<Tried> all;
    for (const auto& group : {network(), processes(), files(outside), kernel(), limits()}) {
        for (const Attempt& attempt : group) all.push_back(tried(attempt, landlock));
    }
    return all;
}

std::string report(const std::vector<Tried>& all) {
    std::string text;
    for (const Tried& one : all) {
        text += one.what + ": ";
        text += one.skipped ? "skipped" : one.refused ? "refused" : "LET THROUGH";
        text += " (" + one.how + ")\n";
    }
    return text;
}

bool allRefused(const std::vector<Tried>& all) {
    return std::ranges::all_of(all, [](const Tried& one) { return one.refused || one.skipped; });
}

}  // namespace volcast::base
