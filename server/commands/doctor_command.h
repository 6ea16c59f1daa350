#pragma once

namespace CLI {
class App;
}

namespace volcast::commands {

/// Adds `doctor` to `app`; `exitCode` is set when it ran: 0 where the service can run, else 1.
void addDoctorCommand(CLI::App& app, int& exitCode);

}  // namespace volcast::commands
