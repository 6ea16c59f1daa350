#include "renderer/base/sandbox.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <linux/capability.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "renderer/base/landlock.h"
#include "renderer/base/seccomp_filter.h"

namespace volcast::base {

namespace {

std::atomic<bool> insideSandbox = false;

Error stepFailed(const std::string& step) {
    return fail(ErrorCode::kIo, "sandbox: " + step + ": " + std::strerror(errno));
}

/// Lowers a limit to `value`, soft and hard; never raises one.
Result<void> limit(__rlimit_resource resource, const char* what, rlim_t value) {
    rlimit now{};
    if (::getrlimit(resource, &now) != 0) return stepFailed(std::string{"cannot read the "} + what);
    const rlim_t wanted = std::min(value, now.rlim_max);
    const rlimit lowered{.rlim_cur = wanted, .rlim_max = wanted};
    if (::setrlimit(resource, &lowered) != 0) {
        return stepFailed(std::string{"cannot set the "} + what + " to " + std::to_string(wanted));
    }
    return {};
}

Result<void> applyLimits(const SandboxPolicy& policy) {
    // Past the file limit, writing shall fail with EFBIG and not end the process.
    if (std::signal(SIGXFSZ, SIG_IGN) == SIG_ERR) return stepFailed("cannot ignore SIGXFSZ");
    auto done = limit(RLIMIT_CORE, "core size limit", 0);
    if (done && kLimitsAddressSpace && policy.maxAddressSpaceBytes != 0) {
        done = limit(RLIMIT_AS, "address space limit", policy.maxAddressSpaceBytes);
    }
    if (done && policy.maxFileBytes != 0) {
        done = limit(RLIMIT_FSIZE, "file size limit", policy.maxFileBytes);
    }
    if (done && policy.maxCpuSeconds != 0) {
        done = limit(RLIMIT_CPU, "CPU time limit", policy.maxCpuSeconds);
    }
    return done;
}

/// A root process could otherwise lift its limits again.
Result<void> dropCapabilities() {
    __user_cap_header_struct header{.version = _LINUX_CAPABILITY_VERSION_3, .pid = 0};
    std::array<__user_cap_data_struct, 2> held{};
    if (::syscall(SYS_capget, &header, held.data()) != 0) {
        return stepFailed("cannot read capabilities");
    }
    // The first sandbox of a process refuses capset() to a second, which finds none left.
    if ((held[0].permitted | held[1].permitted) == 0) return {};
    const std::array<__user_cap_data_struct, 2> none{};
    if (::syscall(SYS_capset, &header, none.data()) != 0) {
        return stepFailed("cannot drop capabilities");
    }
    return {};
}

}  // namespace

SandboxFeatures sandboxFeatures() {
    return {.seccomp = seccompAvailable(),
            .landlockAbi = landlockAbi(),
            .noNewPrivileges = ::prctl(PR_GET_NO_NEW_PRIVS, 0, 0, 0, 0) >= 0};
}

Result<void> enterSandbox(const SandboxPolicy& policy) {
    if (!seccompAvailable()) {
        return fail(ErrorCode::kUnsupported, "sandbox: this kernel has no seccomp filters");
    }
    auto done = applyLimits(policy);
    if (!done) return done;
    if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) {
        return stepFailed("cannot set no_new_privs");
    }
    done = dropCapabilities();
    if (!done) return done;
    done = applyLandlock({.readable = policy.readable,
                          .writable = policy.writable,
                          .mayExecute = policy.mayExecute});
    if (!done) return done;
    insideSandbox = true;
    return applySeccomp({.mayExecute = policy.mayExecute,
                         .mayUseThreads = policy.mayUseThreads,
                         .ownPid = ::getpid()});
}

}  // namespace volcast::base

#ifdef VOLCAST_SANITIZED
/// LeakSanitizer asks at the end of a process; it looks for leaks with ptrace, which is refused.
// NOLINTNEXTLINE(bugprone-reserved-identifier, readability-identifier-naming): its name.
extern "C" int __lsan_is_turned_off() {
    return volcast::base::insideSandbox ? 1 : 0;
}
#endif
