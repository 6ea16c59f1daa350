#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/base/result.h"

namespace volcast::base {

/// Whether maxAddressSpaceBytes is kept. Not in a build with sanitizers: the shadow memory of ASan
/// or TSan alone takes terabytes of addresses.
#ifdef VOLCAST_SANITIZED
inline constexpr bool kLimitsAddressSpace = false;
#else
inline constexpr bool kLimitsAddressSpace = true;
#endif

/// What a process may still do after enterSandbox(); everything else is refused, with EPERM or
/// (files) EACCES.
struct SandboxPolicy {
    std::vector<std::string> readable;  ///< Files and folders (with all below); missing: skipped.
    std::vector<std::string> writable;  ///< The same, but to read, write and send ioctls to.
    bool mayExecute = false;            ///< execve of what is readable, and new processes.
    bool mayUseThreads = true;
    std::uint64_t maxAddressSpaceBytes = 0;  ///< 0: no limit; see kLimitsAddressSpace.
    std::uint64_t maxFileBytes = 0;   ///< Of any file it writes, memfds included; 0: no limit.
    std::uint64_t maxCpuSeconds = 0;  ///< 0: no limit.
};

/// Which parts of a sandbox this kernel grants.
struct SandboxFeatures {
    bool seccomp = false;
    int landlockAbi = 0;  ///< 0: none; 4 and more: network rules too.
    bool noNewPrivileges = false;
};

SandboxFeatures sandboxFeatures();

/// Gives up, for this process and its children, all that `policy` does not name: rlimits,
/// capabilities, Landlock (where the kernel has it), then seccomp in ERRNO mode (network sockets,
/// ptrace, mount, module and namespace calls, and execve where it is not allowed). Cannot be
/// undone; a second call can only take more away. Mappings that are writable and executable stay
/// allowed, because Mesa's JIT needs them.
///
/// Thread: call it while the process has one thread; Landlock does not reach those that run
/// already. Errors: kIo naming the step; kUnsupported where the kernel has no seccomp.
Result<void> enterSandbox(const SandboxPolicy& policy);

}  // namespace volcast::base
