#pragma once

namespace CLI {
class App;
}

namespace volcast::commands {

/// Adds `accuracy` to `app`; `exitCode` is set when it ran: 0 done, 1 failed.
void addAccuracyCommand(CLI::App& app, int& exitCode);

}  // namespace volcast::commands
