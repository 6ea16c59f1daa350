#include "server/commands/load_command.h"

#include <algorithm>
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <boost/json.hpp>

#include "server/commands/json_text.h"
#include "server/commands/load_options.h"
#include "server/commands/progress.h"
#include "server/commands/warnings_only.h"
#include "server/load/fleet.h"
#include "server/load/own_server.h"

namespace volcast::commands {

namespace {

constexpr int kUsage = 2;

constexpr const char* kFooter = R"(Kinds of clients:
  orbit   turns the camera          map     changes the transfer function
  model   changes the ray model     join    comes, stays half a second, leaves, comes again
  idle    opens a view and waits    slow    orbits and reads --slow-kb a second
  shaped  orbits behind a link of --link-mbit and --link-delay (made by the client: bytes
          wait, those of pings too; packets are not lost)

Examples:
  volcast load --clients orbit=4 --duration 10
  volcast load --clients orbit,idle=20,slow=1 --json --min-fps 5 --max-p99-ms 2000 --max-errors 0
  volcast load ws://127.0.0.1:8080 --clients orbit=200 --views 1 --max-age-p99-ms 100
  volcast load --clients orbit=20 --min-fairness 0.8
  volcast load --clients shaped --link-mbit 1 --link-delay 200 --acks none

"input to frame" runs from an input to the first frame of it or a newer one; "age" from an input to
the arrival of the frame that shows it, in every client of the view. "overtaken" inputs were never
shown to a client of the view, but a newer one was. "unanswered" inputs had no frame when the run or
their connection ended: limits of latency count them with the time until then, and limits of age
the time that a picture has stood still by then while newer inputs were sent. Quantiles are at most 1.6 % too high.

Exit code: 0 done and all thresholds kept, 1 a threshold was not kept or the run failed, 2 wrong
options.)";

int complain(const Error& error) {
    std::fprintf(stderr, "volcast load: %s\n", error.message.c_str());
    return error.code == ErrorCode::kInvalidArgument ? kUsage : 1;
}

/// Limits that all clients fit into, where the caller sets none.
std::vector<std::string> serverArguments(const LoadOptions& options) {
    unsigned clients = 0;
    for (const load::Group& group : options.settings.groups) clients += group.clients;
    std::vector<std::string> words{"--log-level", "error"};
    const std::string room = std::to_string(std::min(clients + 8, 10'000U));
    for (const std::string flag : {"--max-clients", "--max-people"}) {
        const bool limited = std::ranges::any_of(
            options.serverArguments,
            [&flag](const std::string& word) { return word.starts_with(flag); });
        if (!limited) words.insert(words.end(), {flag, room});
    }
    words.insert(words.end(), options.serverArguments.begin(), options.serverArguments.end());
    if (!options.dataFolder.empty()) words.push_back(options.dataFolder);
    return words;
}

bool limitsOwnServer(const load::Thresholds& limits) {
    return limits.maxServerMb || limits.maxServerCores || limits.maxGrowthMb ||
           limits.maxGrowthDescriptors || limits.maxGrowthThreads;
}

int run(LoadOptions options) {
    logWarningsOnly("volcast load");
    Progress progress;
    std::unique_ptr<load::OwnServer> own;
    if (options.url.empty()) {
        progress.show("starting a server", 0);
        auto started = load::OwnServer::start(serverArguments(options));
        if (!started) return complain(started.error());
        own = std::move(*started);
        options.url = own->url();
        options.settings.serverPid = own->pid();
    } else if (!options.dataFolder.empty() || !options.serverArguments.empty() ||
               limitsOwnServer(options.thresholds)) {
        return complain(fail(ErrorCode::kInvalidArgument,
                             "--data, --server-option, --max-server-... and --max-growth-... are "
                             "of the command's own server, but a URL was given"));
    }
    const auto url = net::parseWsUrl(options.url);
    if (!url) return complain(url.error());
    options.settings.url = *url;
    const auto outcome = load::runFleet(
        options.settings,
        [&progress](const std::string& text, double part) { progress.show(text, part); });
    progress.clear();
    if (!outcome) return complain(outcome.error());
    const auto violated = load::violations(*outcome, options.thresholds);
    if (options.asJson) {
        std::printf("%s\n",
                    jsonText(load::reportJson(options.settings, *outcome, violated)).c_str());
    } else {
        std::fputs(load::reportText(options.settings, *outcome).c_str(), stdout);
    }
    for (const std::string& one : violated) {
        std::fprintf(stderr, "volcast load: not kept: %s\n", one.c_str());
    }
    return violated.empty() ? 0 : 1;
}

}  // namespace

void addLoadCommand(CLI::App& app, int& exitCode) {
    auto options = std::make_shared<LoadOptions>();
    CLI::App* command = app.add_subcommand(
        "load", "Scripted clients against a server: frames, latency, errors, what they cost it");
    command->footer(kFooter);
    addLoadOptions(*command, *options);
    command->callback([options, &exitCode] { exitCode = run(*options); });
}

}  // namespace volcast::commands
