#include "renderer/base/seccomp_filter.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <linux/seccomp.h>
#include <memory>
#include <sched.h>
#include <string>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <utility>

#include <seccomp.h>

#include "renderer/base/file_descriptor.h"

namespace volcast::base {

namespace {

using Filter = std::unique_ptr<void, decltype(&seccomp_release)>;

constexpr std::uint32_t kRefuse = SCMP_ACT_ERRNO(EPERM);
/// For calls whose arguments a filter cannot see: libc then takes the older call.
constexpr std::uint32_t kPretendMissing = SCMP_ACT_ERRNO(ENOSYS);

/// Nothing that draws or reads files has a use for these.
constexpr std::array kAlwaysRefused{
    // The network; socket pairs stay, see addConditional().
    "socket", "bind", "connect", "listen", "accept", "accept4",
    // Other processes, and the group that ends with them.
    "setpgid", "setsid", "ptrace", "process_vm_readv", "process_vm_writev", "process_madvise",
    "kcmp", "pidfd_getfd", "process_mrelease", "migrate_pages", "move_pages", "perf_event_open",
    "shmget", "semget", "msgget", "mq_open",
    // Mounts and namespaces.
    "mount", "umount2", "pivot_root", "chroot", "open_tree", "move_mount", "fsopen", "fsconfig",
    "fsmount", "fspick", "mount_setattr", "unshare", "setns", "name_to_handle_at",
    "open_by_handle_at",
    // The kernel itself.
    "init_module", "finit_module", "delete_module", "kexec_load", "kexec_file_load", "bpf",
    "userfaultfd", "io_uring_setup", "io_uring_enter", "io_uring_register", "iopl", "ioperm",
    "reboot", "swapon", "swapoff", "acct", "quotactl", "quotactl_fd", "syslog", "sethostname",
    "setdomainname", "settimeofday", "clock_settime", "clock_adjtime", "adjtimex", "vhangup",
    "personality",
    // Keys and identities.
    "keyctl", "add_key", "request_key", "setuid", "setgid", "setreuid", "setregid", "setresuid",
    "setresgid", "setgroups", "setfsuid", "setfsgid", "capset",
    // Changes to files that Landlock does not cover.
    "chmod", "fchmod", "fchmodat", "chown", "fchown", "lchown", "fchownat", "truncate", "setxattr",
    "lsetxattr", "fsetxattr", "removexattr", "lremovexattr", "fremovexattr",
    // What others do with their files.
    "inotify_init", "inotify_init1", "fanotify_init"};

/// Newer calls of the same kinds, which libseccomp does not know by name; numbers are the same on
/// all architectures: fchmodat2, setxattrat, removexattrat, open_tree_attr, file_setattr.
constexpr std::array kNewerRefused{452, 463, 466, 467, 469};

/// Takes a process id, 0 for the caller: others' limits and priorities are not ours to change.
constexpr std::array kOnSelfAlone{
    std::pair{"prlimit64", 0U},          std::pair{"setpriority", 1U},
    std::pair{"ioprio_set", 1U},         std::pair{"sched_setaffinity", 0U},
    std::pair{"sched_setscheduler", 0U}, std::pair{"sched_setparam", 0U},
    std::pair{"sched_setattr", 0U}};

constexpr std::array kProcessCalls{"execve",
                                   "execveat",
                                   "fork",
                                   "vfork",
                                   "kill",
                                   "tkill",
                                   "rt_sigqueueinfo",
                                   "rt_tgsigqueueinfo",
                                   "pidfd_send_signal"};

constexpr std::array kNamespaceFlags{CLONE_NEWNS,  CLONE_NEWUSER, CLONE_NEWPID,   CLONE_NEWNET,
                                     CLONE_NEWIPC, CLONE_NEWUTS,  CLONE_NEWCGROUP};

/// Collects the first failure of a chain of libseccomp calls (they return -errno).
class Status {
public:
    void operator()(int result) noexcept {
        if (result < 0 && first_ == 0) first_ = result;
    }
    [[nodiscard]] Result<void> result(const char* step) const {
        if (first_ == 0) return {};
        return fail(ErrorCode::kIo,
                    std::string{"seccomp: "} + step + ": " + std::strerror(-first_));
    }

private:
    int first_ = 0;
};

/// Refuses the call called `name`; a name that this architecture lacks needs no rule.
template <class... Conditions>
int refuse(const Filter& filter, std::uint32_t action, const char* name, Conditions... conditions) {
    const int number = seccomp_syscall_resolve_name(name);
    if (number < 0) return 0;
    return seccomp_rule_add(filter.get(), action, number, sizeof...(conditions), conditions...);
}

scmp_arg_cmp argument(unsigned index, scmp_compare how, std::uint64_t a, std::uint64_t b = 0) {
    return scmp_arg_cmp{.arg = index, .op = how, .datum_a = a, .datum_b = b};
}

void addConditional(const Filter& filter, const SeccompRules& rules, Status& status) {
    status(refuse(filter, kRefuse, "socketpair", argument(0, SCMP_CMP_NE, AF_UNIX)));
    // Typing into the terminal that started us.
    status(refuse(filter, kRefuse, "ioctl", argument(1, SCMP_CMP_MASKED_EQ, 0xffffffff, TIOCSTI)));
    status(
        refuse(filter, kRefuse, "ioctl", argument(1, SCMP_CMP_MASKED_EQ, 0xffffffff, TIOCLINUX)));
    // Before version 3, Landlock lets a file that is only readable be emptied.
    constexpr std::uint64_t kMask = O_ACCMODE | O_TRUNC;
    constexpr std::uint64_t kReadAndTruncate = O_RDONLY | O_TRUNC;
    status(refuse(filter, kRefuse, "openat",
                  argument(2, SCMP_CMP_MASKED_EQ, kMask, kReadAndTruncate)));
    status(
        refuse(filter, kRefuse, "open", argument(1, SCMP_CMP_MASKED_EQ, kMask, kReadAndTruncate)));
    status(refuse(filter, kPretendMissing, "openat2"));
    status(refuse(filter, kPretendMissing, "clone3"));
    for (const auto& [name, process] : kOnSelfAlone) {
        status(refuse(filter, kRefuse, name, argument(process, SCMP_CMP_NE, 0)));
    }
    if (!rules.mayExecute) {
        for (const char* name : kProcessCalls) status(refuse(filter, kRefuse, name));
        const auto self = static_cast<std::uint64_t>(rules.ownPid);
        status(refuse(filter, kRefuse, "tgkill", argument(0, SCMP_CMP_NE, self)));
        // Outliving the parent. A program that is executed asks for the opposite as it begins.
        status(refuse(filter, kRefuse, "prctl",
                      argument(0, SCMP_CMP_MASKED_EQ, 0xffffffff, PR_SET_PDEATHSIG)));
    }
    if (!rules.mayUseThreads && !rules.mayExecute) {
        status(refuse(filter, kRefuse, "clone"));
        return;
    }
    if (!rules.mayExecute) {
        status(refuse(filter, kRefuse, "clone", argument(0, SCMP_CMP_MASKED_EQ, CLONE_THREAD, 0)));
    }
    for (const int flag : kNamespaceFlags) {
        const auto bit = static_cast<std::uint64_t>(flag);
        status(refuse(filter, kRefuse, "clone", argument(0, SCMP_CMP_MASKED_EQ, bit, bit)));
    }
}

Result<Filter> buildFilter(const SeccompRules& rules) {
    Filter filter{seccomp_init(SCMP_ACT_ALLOW), &seccomp_release};
    if (!filter) return fail(ErrorCode::kIo, "seccomp: no memory for a filter");
    Status status;
    status(seccomp_attr_set(filter.get(), SCMP_FLTATR_ACT_BADARCH, kRefuse));
    status(seccomp_attr_set(filter.get(), SCMP_FLTATR_CTL_TSYNC, 1));
    status(seccomp_attr_set(filter.get(), SCMP_FLTATR_CTL_OPTIMIZE, 2));
    for (const char* name : kAlwaysRefused) status(refuse(filter, kRefuse, name));
    for (const int number : kNewerRefused) {
        status(seccomp_rule_add(filter.get(), kRefuse, number, 0));
    }
    addConditional(filter, rules, status);
    auto built = status.result("cannot build the filter");
    if (!built) return built.error();
    return filter;
}

}  // namespace

bool seccompAvailable() noexcept {
    std::uint32_t action = SECCOMP_RET_ERRNO;
    return ::syscall(SYS_seccomp, SECCOMP_GET_ACTION_AVAIL, 0U, &action) == 0;
}

Result<void> applySeccomp(const SeccompRules& rules) {
    auto filter = buildFilter(rules);
    if (!filter) return filter.error();
    Status status;
    status(seccomp_load(filter->get()));
    return status.result("cannot load the filter");
}

Result<std::vector<std::byte>> seccompProgram(const SeccompRules& rules) {
    auto filter = buildFilter(rules);
    if (!filter) return filter.error();
    const FileDescriptor file{::memfd_create("seccomp-program", MFD_CLOEXEC)};
    if (!file.valid()) return fail(ErrorCode::kIo, "seccomp: no memory for the program");
    Status status;
    status(seccomp_export_bpf(filter->get(), file.get()));
    auto exported = status.result("cannot export the filter");
    if (!exported) return exported.error();
    const off_t size = ::lseek(file.get(), 0, SEEK_END);
    std::vector<std::byte> program(size > 0 ? static_cast<std::size_t>(size) : 0);
    if (::pread(file.get(), program.data(), program.size(), 0) != size) {
        return fail(ErrorCode::kIo, "seccomp: cannot read the program back");
    }
    return program;
}

}  // namespace volcast::base
