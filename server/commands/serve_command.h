#pragma once

namespace CLI {
class App;
}

namespace volcast::commands {

/// Adds `serve` to `app`; `exitCode` is set when it ran.
void addServeCommand(CLI::App& app, int& exitCode);

}  // namespace volcast::commands
