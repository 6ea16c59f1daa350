// The `volcast` program: picks the command.
#include <CLI/CLI.hpp>

#include "server/commands/accuracy_command.h"
#include "server/commands/doctor_command.h"
#include "server/commands/import_command.h"
#include "server/commands/load_command.h"
#include "server/commands/render_command.h"
#include "server/commands/serve_command.h"
#include "server/commands/token_command.h"

int main(int argc, char** argv) {  // NOLINT(bugprone-exception-escape): our bugs end in abort()
    CLI::App app{"Volcast: remote volume rendering with stated accuracy", "volcast"};
    app.set_version_flag("--version", "volcast " VOLCAST_VERSION);
    app.require_subcommand(1);
    int exitCode = 0;
    volcast::commands::addServeCommand(app, exitCode);
    volcast::commands::addRenderCommand(app, exitCode);
    volcast::commands::addAccuracyCommand(app, exitCode);
    volcast::commands::addImportCommand(app, exitCode);
    volcast::commands::addLoadCommand(app, exitCode);
    volcast::commands::addTokenCommand(app, exitCode);
    volcast::commands::addDoctorCommand(app, exitCode);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        constexpr int kUsage = 2;
        return app.exit(error) == 0 ? 0 : kUsage;  // 0: --help and --version.
    }
    return exitCode;
}
