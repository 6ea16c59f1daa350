#pragma once

namespace CLI {
class App;
}

namespace volcast::commands {

/// Adds `load` to `app`; `exitCode` is set when it ran.
void addLoadCommand(CLI::App& app, int& exitCode);

}  // namespace volcast::commands
