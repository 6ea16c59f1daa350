#pragma once

#include <string>
#include <vector>

#include "renderer/base/result.h"

namespace volcast::base {

/// What Landlock lets this process and its children still reach in the file system.
struct LandlockRules {
    std::vector<std::string> readable;  ///< Files, and folders with all below; missing: skipped.
    std::vector<std::string> writable;  ///< The same, also to write, create and send ioctls to.
    bool mayExecute = false;            ///< What is readable may also be executed.
};

/// The Landlock version of this kernel; 0 where it has none or has it switched off.
int landlockAbi() noexcept;

/// Refuses (EACCES) every file access that `rules` does not name, and TCP where the kernel can.
///
/// Holds for the calling thread and those it starts later. Does nothing where landlockAbi() is 0.
/// Needs no_new_privs. Errors: kIo naming the step.
Result<void> applyLandlock(const LandlockRules& rules);

}  // namespace volcast::base
