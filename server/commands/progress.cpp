#include "server/commands/progress.h"

#include <algorithm>
#include <cstdio>
#include <unistd.h>

namespace volcast::commands {

namespace {

constexpr int kWidth = 32;

}  // namespace

Progress::Progress() : terminal_{::isatty(STDERR_FILENO) != 0} {}

void Progress::show(const std::string& stage, double fraction) {
    if (!terminal_) return;
    const double shown = std::clamp(fraction, 0.0, 1.0);
    const auto done = static_cast<std::size_t>(shown * kWidth);
    const std::string bar = std::string(done, '#') + std::string(kWidth - done, '.');
    std::fprintf(stderr, "\r\033[K%s %3.0f %% %s", bar.c_str(), 100.0 * shown, stage.c_str());
    shown_ = true;
}

void Progress::clear() {
    if (shown_) std::fputs("\r\033[K", stderr);
    shown_ = false;
}

}  // namespace volcast::commands
