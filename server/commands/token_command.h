#pragma once

namespace CLI {
class App;
}

namespace volcast::commands {

/// Adds `token` to `app`; `exitCode` is set when it ran: 0 where the token was printed, else 1.
void addTokenCommand(CLI::App& app, int& exitCode);

}  // namespace volcast::commands
