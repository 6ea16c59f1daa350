#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/base/result.h"

namespace volcast::base {

/// What a process may still do after enterSandbox(); everything else is refused with EPERM.
struct SandboxPolicy {
    std::vector<std::string> readable;  ///< Files and folders (with all below); missing: skipped.
    std::vector<std::string> writable;  ///< Folders that may be read and written.
    bool mayExecute = false;            ///< execve and new processes.
    bool mayUseThreads = true;
    std::uint64_t maxAddressSpaceBytes = 0;  ///< 0: no limit.
    std::uint64_t maxFileBytes = 0;          ///< Of any file it writes, memfds included; 0: none.
    std::uint64_t maxCpuSeconds = 0;         ///< 0: no limit.
};

/// Which parts of a sandbox this kernel grants.
struct SandboxFeatures {
    bool seccomp = false;
    int landlockAbi = 0;  ///< 0: none; 4 and more: network rules too.
    bool noNewPrivileges = false;
};

SandboxFeatures sandboxFeatures();

/// Gives up, for this process and its children, all that `policy` does not name: rlimits,
/// Landlock (where the kernel has it), then seccomp in ERRNO mode (network sockets, ptrace, mount,
/// module and namespace calls, and execve where it is not allowed). Cannot be undone.
///
/// Errors: kIo naming the step; kUnsupported where the kernel has no seccomp.
Result<void> enterSandbox(const SandboxPolicy& policy);

}  // namespace volcast::base
