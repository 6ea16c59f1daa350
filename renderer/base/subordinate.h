#pragma once

namespace volcast::base {

/// The environment variable by which a program learns the process id of whoever starts it.
inline constexpr const char* kParentVariable = "VOLCAST_PARENT";

/// What a process of the server does first. From then on it gets SIGKILL when the thread that
/// started it ends; it ends at once where $VOLCAST_PARENT is its parent no more. Where memory runs
/// out, the kernel ends it before the server.
///
/// Without the variable (started by hand) any parent will do.
void becomeSubordinate() noexcept;

}  // namespace volcast::base
