#pragma once

namespace CLI {
class App;
}

namespace volcast::commands {

/// Adds `import` to `app`; `exitCode` is set when it ran: 0, or 1 for a dataset that was refused.
void addImportCommand(CLI::App& app, int& exitCode);

}  // namespace volcast::commands
