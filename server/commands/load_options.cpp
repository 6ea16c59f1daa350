#include "server/commands/load_options.h"

#include <charconv>
#include <cmath>
#include <map>
#include <sstream>

#include <CLI/CLI.hpp>

namespace volcast::commands {

namespace {

constexpr unsigned kMostClients = 10'000;

/// "KIND" or "KIND=COUNT"; throws what CLI11 reports as a wrong option.
load::Group groupFrom(const std::string& word) {
    const auto equals = word.find('=');
    const auto kind = load::kindFrom(word.substr(0, equals));
    if (!kind) {
        throw CLI::ValidationError("--clients", "\"" + word.substr(0, equals) +
                                                    "\" is not orbit, map, model, join, idle, slow "
                                                    "or shaped");
    }
    load::Group group{.kind = *kind};
    if (equals == std::string::npos) return group;
    const char* end = word.data() + word.size();
    const auto read = std::from_chars(word.data() + equals + 1, end, group.clients);
    if (read.ec != std::errc{} || read.ptr != end || group.clients < 1 ||
        group.clients > kMostClients) {
        throw CLI::ValidationError("--clients",
                                   "\"" + word + "\": the count is not a number from 1 to 10000");
    }
    return group;
}

/// A number in [least, most]; CLI11's own range lets NaN through.
CLI::Validator within(double least, double most) {
    return {[=](std::string& text) -> std::string {
                double value = 0;
                const char* end = text.data() + text.size();
                const auto read = std::from_chars(text.data(), end, value);
                const bool good =
                    read.ec == std::errc{} && read.ptr == end && value >= least && value <= most;
                if (good) return {};
                std::ostringstream why;
                why << "\"" << text << "\" is not a number from " << least << " to " << most;
                return why.str();
            },
            ""};
}

void addClients(CLI::App& command, LoadOptions& options) {
    load::LoadSettings& settings = options.settings;
    settings.groups = {load::Group{}};
    command
        .add_option_function<std::vector<std::string>>(
            "--clients",
            [&settings](const std::vector<std::string>& words) {
                settings.groups.clear();
                for (const std::string& word : words) settings.groups.push_back(groupFrom(word));
            },
            "KIND[=COUNT], separated by commas (default orbit=1)")
        ->delimiter(',');
    command
        .add_option("--views", settings.views,
                    "So many views for all clients: the first that move open and steer them, the "
                    "others join by link and watch; 0: one a client")
        ->check(CLI::Range(0U, kMostClients))
        ->capture_default_str();
    command.add_option("--duration", settings.durationS, "Seconds that are measured")
        ->check(within(0.1, 1e6))
        ->capture_default_str();
    command.add_option("--ramp-up", settings.rampUpS, "Seconds over which clients connect, before")
        ->check(within(0, 1e5))
        ->capture_default_str();
    command.add_option("--rate", settings.inputsPerSecond, "Inputs a second of each that moves")
        ->check(within(0.01, 1000))
        ->capture_default_str();
    command
        .add_option("--acks", settings.acks,
                    "full: each frame, the server paces; one: one frame under way; none: nothing "
                    "but the socket slows frames. one and none pin JPEG quality and full size")
        ->transform(CLI::CheckedTransformer(
            std::map<std::string, load::Acks>{{"full", load::Acks::kFull},
                                              {"one", load::Acks::kOneCredit},
                                              {"none", load::Acks::kNone}}))
        ->default_str("full");
    command
        .add_option("--quality", settings.quality,
                    "Of JPEG, pinned; none: as the server paces, at most 90")
        ->check(CLI::Range(30U, 100U));
    command.add_option("--dataset", settings.dataset, "What views show; none: the first listed");
    command.add_option("--width", settings.width, "Pixels")
        ->check(CLI::Range(1U, 8192U))
        ->capture_default_str();
    command.add_option("--height", settings.height, "Pixels")
        ->check(CLI::Range(1U, 8192U))
        ->capture_default_str();
}

/// What slows `slow` and `shaped` clients.
void addLinks(CLI::App& command, load::LoadSettings& settings) {
    command
        .add_option_function<double>(
            "--slow-kb", [&settings](double kb) { settings.slowBytesPerSecond = kb * 1e3; },
            "KB (1000 bytes) a second that `slow` reads (default 200)")
        ->check(within(1, 1e6));
    command
        .add_option_function<double>(
            "--link-mbit",
            [&settings](double mbit) { settings.shaped.bytesPerSecond = mbit * 1e6 / 8; },
            "Mbit a second of the link of `shaped` (default 10)")
        ->check(within(0.01, 1e5));
    command
        .add_option_function<double>(
            "--link-delay",
            [&settings](double ms) {
                settings.shaped.delay =
                    std::chrono::milliseconds{static_cast<std::int64_t>(std::round(ms / 2))};
            },
            "Milliseconds that the link of `shaped` adds to a round trip (default 50)")
        ->check(within(0, 5000));
}

void addThresholds(CLI::App& command, load::Thresholds& limits) {
    const auto add = [&command](const char* flag, std::optional<double>& limit, const char* text) {
        command
            .add_option_function<double>(
                flag, [&limit](double value) { limit = value; }, text)
            ->check(within(0, 1e12));
    };
    add("--max-p50-ms", limits.maxP50Ms, "Input to frame, all clients together");
    add("--max-p95-ms", limits.maxP95Ms, "The same");
    add("--max-p99-ms", limits.maxP99Ms, "The same");
    add("--max-age-p99-ms", limits.maxAgeP99Ms, "Age of frames that show something new");
    add("--max-age-ms", limits.maxAgeMs, "The oldest of those");
    add("--min-fps", limits.minFps, "Frames a second of the slowest client in views that move");
    add("--min-fairness", limits.minFairness,
        "Slowest over fastest of the views that move, in frames/s");
    add("--max-errors", limits.maxErrors, "Refusals, failed and lost connections");
    add("--max-server-mb", limits.maxServerMb, "Resident memory of the own server and its workers");
    add("--max-server-cores", limits.maxServerCores, "CPUs of the own server without its workers");
    add("--max-growth-mb", limits.maxGrowthMb, "Of both, from begin to end of the measured time");
    add("--max-growth-descriptors", limits.maxGrowthDescriptors, "The same");
    add("--max-growth-threads", limits.maxGrowthThreads, "The same");
}

}  // namespace

void addLoadOptions(CLI::App& command, LoadOptions& options) {
    command.add_option("URL", options.url,
                       "ws://HOST:PORT, wss, http or https; none: a server of its own on a free "
                       "port of the loopback");
    command.add_option("--data", options.dataFolder, "What its own server serves; none: the demo");
    command.add_option("--server-option", options.serverArguments,
                       "One more word for `volcast serve`, as --server-option=--max-views=4");
    command.add_option("--trust", options.settings.trustFile,
                       "PEM file of the certificates that wss trusts; none: the system's");
    addClients(command, options);
    addLinks(command, options.settings);
    addThresholds(command, options.thresholds);
    command.add_flag("--json", options.asJson, "One line of JSON instead of a table");
}

}  // namespace volcast::commands
