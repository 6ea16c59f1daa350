#pragma once

#include <cstddef>
#include <vector>

#include "renderer/base/result.h"

namespace volcast::base {

/// Which system calls stay beyond the ones that every sandboxed process keeps.
struct SeccompRules {
    bool mayExecute = false;  ///< execve, new processes and signals to them; PR_SET_PDEATHSIG.
    bool mayUseThreads = true;
    int ownPid = 0;  ///< Where it may not execute: it may signal (abort) itself; 0: nobody.
};

/// True where the kernel can refuse system calls with an error code.
bool seccompAvailable() noexcept;

/// Refuses, with EPERM, system calls for all threads of this process and its children.
///
/// Needs no_new_privs. Errors: kIo.
Result<void> applySeccomp(const SeccompRules& rules);

/// The same filter as a BPF program (an array of struct sock_filter), for a child in another
/// language that loads it itself once it has started up.
///
/// Errors: kIo.
Result<std::vector<std::byte>> seccompProgram(const SeccompRules& rules);

}  // namespace volcast::base
