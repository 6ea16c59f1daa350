#include "renderer/base/subordinate.h"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sys/prctl.h>
#include <unistd.h>

namespace volcast::base {

namespace {

constexpr const char* kOomScore = "/proc/self/oom_score_adj";
constexpr int kAboveParent = 500;
constexpr int kMostOomScore = 1000;

/// Relative to what was inherited: whoever runs the server may have raised or lowered that.
void standInFrontOfTheOomKiller() {
    int inherited = 0;
    // Where the kernel does not let us, all else works as before.
    if (!(std::ifstream{kOomScore} >> inherited)) return;
    std::ofstream{kOomScore} << std::min(inherited + kAboveParent, kMostOomScore);
}

}  // namespace

void becomeSubordinate() noexcept {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0);
    // A parent that ended before that sent no signal.
    const char* parent = std::getenv(kParentVariable);
    if (parent != nullptr && std::atoi(parent) != ::getppid()) ::_exit(EXIT_FAILURE);
    standInFrontOfTheOomKiller();
}

}  // namespace volcast::base
