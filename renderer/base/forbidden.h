#pragma once

#include <string>
#include <vector>

namespace volcast::base {

/// What became of one thing that a sandboxed process must not be able to do.
struct Tried {
    std::string what;
    bool refused = false;
    std::string how;  ///< "EPERM"; "done" where it was let through; why it was not tried.
    bool skipped = false;
};

/// Tries what enterSandbox() is to forbid, each in a form that does no harm where it is let
/// through: network, other processes, files of the user, the kernel, limits.
///
/// `outside`: a folder that exists, where nothing may be made. Call it inside of a sandbox.
std::vector<Tried> tryForbidden(const std::string& outside);

/// One line each: what, "refused" or "LET THROUGH" or "skipped", how.
std::string report(const std::vector<Tried>& all);
/// True where nothing was let through.
bool allRefused(const std::vector<Tried>& all);

}  // namespace volcast::base
