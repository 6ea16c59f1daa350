#include "server/commands/serve_command.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <thread>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "renderer/base/printable.h"
#include "server/commands/cache_folder.h"
#include "server/commands/client_folder.h"
#include "server/session/thumbnails.h"
#include "server/session/views.h"
#include "server/settings.h"
#include "server/video/video_patches.h"
#include "server/video/video_stream.h"
#include "server/workers/gpu_given_up.h"
#include "server/workers/isolating_service.h"

namespace volcast::commands {

namespace {

std::string defaultClientFolder() {
    std::error_code ignored;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored);
    return clientFolderOf(program);
}

/// Bytes that this machine has, or the container; 0: unknown.
std::uint64_t memoryOfMachine() {
    const auto pages = ::sysconf(_SC_PHYS_PAGES), pageBytes = ::sysconf(_SC_PAGESIZE);
    const bool known = pages > 0 && pageBytes > 0;
    std::uint64_t bytes =
        known ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(pageBytes) : 0;
    std::uint64_t ofContainer = 0;
    if (std::ifstream{"/sys/fs/cgroup/memory.max"} >> ofContainer) {  // Else absent, or "max".
        bytes = known ? std::min(bytes, ofContainer) : ofContainer;
    }
    return bytes;
}

/// One line an event on stderr: time, level, then key=value.
void startLog(const std::string& level) {
    auto log = spdlog::stderr_color_mt("volcast");
    log->set_pattern("%Y-%m-%dT%H:%M:%S.%e %l %v");
    log->set_level(spdlog::level::from_str(level));
    log->flush_on(spdlog::level::trace);
    spdlog::set_default_logger(std::move(log));
}

/// Which encoder makes which video, and why not those before it.
void logVideoEncoders() {
    std::string others;
    for (const video::EncoderFinding& encoder : video::videoEncoders()) {
        if (!encoder.works) others += (others.empty() ? "" : "; ") + encoder.detail;
        if (!encoder.used) continue;
        spdlog::info(R"(event=video_encoder encoder={} not_used="{}")", encoder.name,
                     base::printable(others, 1000));
        others.clear();
    }
    if (!others.empty()) {
        spdlog::warn(R"(event=video_encoder_missing not_used="{}")", base::printable(others, 1000));
    }
}

int complain(const Error& error) {
    std::fprintf(stderr, "volcast serve: %s\n", error.message.c_str());
    return 1;
}

/// What outlives the server, where it is asked to.
struct KeptState {
    session::LinkKey key;
    std::unique_ptr<session::StateFolder> folder;
};

Result<KeptState> openState(const ServeSettings& settings) {
    KeptState kept;
    std::string keyFile = settings.linkKeyFile;
    if (!settings.stateFolder.empty()) {
        auto folder = session::StateFolder::create(settings.stateFolder);
        if (!folder) return std::move(folder).error();
        kept.folder = *std::move(folder);
        if (keyFile.empty()) {
            keyFile = settings.stateFolder + "/" + session::StateFolder::kKeyFile;
        }
    }
    auto key = keyFile.empty() ? session::LinkKey::random() : session::LinkKey::fromFile(keyFile);
    if (!key) return std::move(key).error();
    kept.key = *key;
    return kept;
}

/// Null where uploads are off.
Result<std::unique_ptr<session::UploadFolder>> openUploads(const ServeSettings& settings) {
    if (!settings.allowUploads) return std::unique_ptr<session::UploadFolder>{};
    if (settings.dataFolder.empty()) {
        return fail(ErrorCode::kInvalidArgument, "--allow-uploads needs a DATA_DIR to put them in");
    }
    if (settings.uploads.needToken && settings.linkKeyFile.empty() &&
        settings.stateFolder.empty()) {
        return fail(ErrorCode::kInvalidArgument,
                    "--uploads-need-token needs the key that tokens are signed with: "
                    "--link-key-file, or --state-dir");
    }
    return session::UploadFolder::create(settings.dataFolder, settings.uploads);
}

session::CatalogueDesc catalogueOf(const ServeSettings& settings, workers::FaultSwitch& faults) {
    session::CatalogueDesc desc;
    desc.folder = settings.dataFolder;
    desc.imports = settings.imports;
    desc.imports.beneath = settings.dataFolder;
    desc.importsAtOnce = settings.importsAtOnce;
    desc.maxDataBytes = settings.maxDataBytes;
    if (!settings.allowFaults) return desc;
    spdlog::warn(
        "event=faults_allowed message=\"who may steer a view may let workers and imports fail\"");
    desc.imports.fault = [&faults] { return faults.takeForImport(); };
    return desc;
}

/// Builds the parts, joins them, serves.
int serve(ServeSettings settings) {
    startLog(settings.logLevel);
    if (settings.render.cacheFolder.empty()) settings.render.cacheFolder = userCacheFolder();
    workers::forgetGpuGivenUp(settings.render.cacheFolder);  // It gets another chance.
    if (settings.listen.clientFolder.empty()) settings.listen.clientFolder = defaultClientFolder();
    session::ViewRouter router;
    auto render = workers::createIsolatingService(settings.render, router.events());
    if (!render) return complain(render.error());
    workers::FaultSwitch faults;
    faults.connect(**render);
    auto uploads = openUploads(settings);  // Before its folder is listed.
    if (!uploads) return complain(uploads.error());
    auto catalogue = session::Catalogue::create(catalogueOf(settings, faults), **render);
    if (!catalogue) return complain(catalogue.error());
    (void)video::videoPatches();  // Encoders are tried now, not when the first client waits.
    logVideoEncoders();
    auto encoders = std::make_unique<session::EncodePool>(settings.encodeThreads);
    auto kept = openState(settings);
    if (!kept) return complain(kept.error());
    session::Views views{{.parts = {.render = **render,
                                    .catalogue = **catalogue,
                                    .router = router,
                                    .encoders = *encoders,
                                    .maxPixels = settings.limits.maxViewPixels,
                                    .maxPeople = settings.maxPeople},
                          .key = kept->key,
                          .keep = settings.keepViews,
                          .maxViews = settings.maxOpenViews,
                          .state = std::move(kept->folder)}};
    session::Thumbnails thumbnails{**render, **catalogue, router, *encoders};
    session::Shared shared{.render = **render,
                           .catalogue = **catalogue,
                           .views = views,
                           .limits = settings.limits,
                           .server = settings.serverName,
                           .sourceUrl = settings.sourceUrl,
                           .faults = settings.allowFaults ? &faults : nullptr,
                           .uploads = uploads->get(),
                           .thumbnails = &thumbnails};
    auto server = net::Server::create(settings.listen, shared);
    if (!server) return complain(server.error());
    const workers::RenderStatus status = (*render)->status();
    spdlog::info(R"(event=ready url={} gl_renderer="{}" data="{}")", (*server)->url(),
                 status.glRenderer, settings.dataFolder.empty() ? "demo" : settings.dataFolder);
    std::printf("Volcast is ready: %s\n", (*server)->url().c_str());
    std::fflush(stdout);
    (*server)->run();
    spdlog::info("event=stopped");
    views.clear();  // Saved, where there is a folder for them.
    // An import that runs can take minutes; its process ends with this one.
    if ((*catalogue)->importing()) std::_Exit(0);
    // News of other threads end before the sockets' context does.
    thumbnails.stop();
    encoders.reset();
    catalogue->reset();
    render->reset();
    return 0;
}

void addConnections(CLI::App& command, ServeSettings& settings) {
    command.add_option("--max-clients", settings.listen.maxClients, "WebSockets at once")
        ->check(CLI::Range(1U, 10000U))
        ->capture_default_str();
    command
        .add_option_function<unsigned>(
            "--max-clients-per-address",
            [&settings](unsigned most) { settings.listen.maxClientsPerAddress = most; },
            "WebSockets at once of one address (IPv6: of its first 64 bits), this machine "
            "excepted; "
            "0: no limit, as behind a proxy on another machine (default half of --max-clients)")
        ->check(CLI::Range(0U, 10000U));
    command
        .add_option_function<std::int64_t>(
            "--write-patience-s",
            [&settings](std::int64_t seconds) {
                settings.listen.writePatience = std::chrono::seconds{seconds};
            },
            "So long 64 KiB of what a client is sent may take before it is cut off (default 20)")
        ->check(CLI::Range(1, 3600));
}

void addLimits(CLI::App& command, ServeSettings& settings) {
    command.add_option("--max-views", settings.limits.maxViews, "Views of one client")
        ->check(CLI::Range(1U, 256U))
        ->capture_default_str();
    command
        .add_option("--max-open-views", settings.maxOpenViews,
                    "Views in the whole server; those that nobody looks at make room")
        ->check(CLI::Range(1U, 100'000U))
        ->capture_default_str();
    command.add_option("--max-people", settings.maxPeople, "People in one view")
        ->check(CLI::Range(1U, 10'000U))
        ->capture_default_str();
    command
        .add_option_function<std::int64_t>(
            "--keep-views-s",
            [&settings](std::int64_t seconds) {
                settings.keepViews = std::chrono::seconds{seconds};
            },
            "So long a view waits for people who lost their connection (default 60)")
        ->check(CLI::Range(1, 30 * 24 * 3600));
    command
        .add_option("--max-messages-per-s", settings.limits.maxMessagesPerS,
                    "Messages a second of one client, and as many at once; more end it")
        ->check(CLI::Range(1U, 1'000'000U))
        ->capture_default_str();
    command
        .add_option_function<std::int64_t>(
            "--frame-deadline-ms",
            [&settings](std::int64_t ms) {
                settings.render.frameDeadline = std::chrono::milliseconds{ms};
            },
            "A frame that takes longer costs its worker (default 10000)")
        ->check(CLI::Range(100, 3'600'000));
}

void addDataLimits(CLI::App& command, ServeSettings& settings) {
    command
        .add_option_function<std::int64_t>(
            "--import-deadline-ms",
            [&settings](std::int64_t ms) {
                settings.imports.deadline = std::chrono::milliseconds{ms};
            },
            "An import that takes longer is ended (default 120000)")
        ->check(CLI::Range(100, 86'400'000));
    command
        .add_option_function<std::uint64_t>(
            "--import-memory-mb",
            [&settings](std::uint64_t mb) { settings.imports.maxMemoryBytes = mb << 20U; },
            "Memory that one import may take (default 8192)")
        ->check(CLI::Range(64, 1 << 20));
    command
        .add_option_function<std::uint64_t>(
            "--max-data-mb", [&settings](std::uint64_t mb) { settings.maxDataBytes = mb << 20U; },
            "Memory that all imported data may take, beside imports that run: data that no view "
            "shows makes room (default half of the machine's)")
        ->check(CLI::Range(1, 1 << 30));
    command
        .add_option_function<std::uint64_t>(
            "--volume-budget",
            [&settings](std::uint64_t mib) { settings.render.volumeBudgetBytes = mib << 20U; },
            "MiB of GPU memory for all voxels of a scene: those that take more are drawn from "
            "bricks (default 1024)")
        ->check(CLI::Range(workers::kLeastVolumeBudgetMib, workers::kMostVolumeBudgetMib));
}

void addFaults(CLI::App& command, ServeSettings& settings) {
    CLI::Option* allowed = command.add_flag(
        "--allow-faults", settings.allowFaults,
        "FOR TESTS ALONE: lets every client that may steer a view crash and hang workers and "
        "imports of all (InjectFault); with --uploads-need-token only with a token");
    command
        .add_option_function<std::string>(
            "--worker-fault",
            [&settings](const std::string& text) {
                const auto fault = worker::parseFault(text);
                if (!fault) throw CLI::ValidationError{"--worker-fault", fault.error().message};
                settings.render.fault = *fault;
            },
            "FOR TESTS ALONE: each worker gets this --fault; see volcast-worker --list-faults")
        ->needs(allowed);
}

void addUploads(CLI::App& command, ServeSettings& settings) {
    session::UploadLimits& limits = settings.uploads;
    CLI::Option* allowed =
        command.add_flag("--allow-uploads", settings.allowUploads,
                         "Everybody who may connect, also by a link to watch, may upload data into "
                         "DATA_DIR/uploads; see --uploads-need-token");
    command
        .add_flag(
            "--uploads-need-token", limits.needToken,
            "Only who brings an access token that `volcast token --role control` made uploads")
        ->needs(allowed);
    const auto size = [&](const char* name, std::uint64_t& bytes, const char* text) {
        command
            .add_option_function<std::uint64_t>(
                name, [&bytes](std::uint64_t mib) { bytes = mib << 20U; }, text)
            ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 32))
            ->needs(allowed);
    };
    size("--max-upload-mb", limits.maxBytes, "MiB of one upload, all its files (default 1024)");
    size("--max-uploads-mb", limits.maxTotalBytes,
         "MiB of all uploads that are there (default 10240)");
    size("--upload-keep-free-mb", limits.keepFreeBytes,
         "MiB of the disk that uploads leave free (default 1024)");
    command.add_option("--max-uploads", limits.maxUploads, "Uploads that are there")
        ->check(CLI::Range(1U, 100'000U))
        ->needs(allowed)
        ->capture_default_str();
    command.add_option("--max-upload-files", limits.maxFiles, "Files of one upload")
        ->check(CLI::Range(1U, 100'000U))
        ->needs(allowed)
        ->capture_default_str();
    command.add_option("--max-uploads-at-once", limits.maxAtOnce, "Files received at once")
        ->check(CLI::Range(1U, 64U))
        ->needs(allowed)
        ->capture_default_str();
    command
        .add_option_function<std::int64_t>(
            "--upload-patience-s",
            [&limits](std::int64_t seconds) { limits.patience = std::chrono::seconds{seconds}; },
            "So long 64 KiB of a file may take to arrive (default 20)")
        ->check(CLI::Range(1, 3600))
        ->needs(allowed);
}

void addState(CLI::App& command, ServeSettings& settings) {
    command.add_option("--state-dir", settings.stateFolder,
                       "Folder that keeps views over a restart; none: they end with the server");
    command.add_option(
        "--link-key-file", settings.linkKeyFile,
        "Key that share links and access tokens are signed with, made where there is none; none: "
        "link.key in --state-dir, else one of this run");
}

}  // namespace

void addServeCommand(CLI::App& app, int& exitCode) {
    auto settings = std::make_shared<ServeSettings>();
    const unsigned cores = std::max(1U, std::thread::hardware_concurrency());
    settings->listen.threads = std::clamp(cores, 1U, 4U);
    settings->encodeThreads = std::clamp(cores, 1U, 8U);
    settings->importsAtOnce = cores > 4 ? 2 : 1;
    settings->maxDataBytes = memoryOfMachine() / 2;
    settings->serverName = app.version();
    CLI::App& command =
        *app.add_subcommand("serve", "Serve a folder of data, or the built-in demo, to browsers");
    command.add_option("DATA_DIR", settings->dataFolder,
                       "Folder with meshes and volumes; none: the built-in demo");
    command.add_option("--host", settings->listen.host, "Address to listen on")
        ->envname("VOLCAST_HOST")
        ->capture_default_str();
    command.add_option("--port", settings->listen.port, "Port; 0: any free one")
        ->envname("VOLCAST_PORT")
        ->capture_default_str();
    command
        .add_option("--gpu", settings->render.gpu,
                    "EGL device as `volcast doctor` lists it, or software; none: surfaceless")
        ->envname("VOLCAST_GPU");
    command.add_option(
        "--client-dir", settings->listen.clientFolder,
        "Built web client; none: web_client beside the programs' folder, or the build's");
    command.add_option("--tls-cert", settings->listen.tlsCert,
                       "PEM file with the certificate chain: HTTPS and wss, TLS 1.2 and later");
    command.add_option("--tls-key", settings->listen.tlsKey, "PEM file with its private key");
    command.add_option("--allow-origin", settings->listen.allowedOrigins,
                       "Further web origins that may connect, such as https://lab.example.org");
    command
        .add_option("--metrics", settings->listen.metricsFor,
                    "Who may read /metrics: off, local (this machine, not through a proxy), all")
        ->transform(CLI::CheckedTransformer(
            std::map<std::string, net::MetricsFor>{{"off", net::MetricsFor::kNobody},
                                                   {"local", net::MetricsFor::kThisMachine},
                                                   {"all", net::MetricsFor::kEverybody}},
            CLI::ignore_case))
        ->default_str("local");
    command.add_option("--source-url", settings->sourceUrl,
                       "Where users of this server get its source (AGPL), told to clients");
    command.add_option("--log-level", settings->logLevel, "debug, info, warning, error or off")
        ->check(CLI::IsMember({"debug", "info", "warning", "error", "off"}))
        ->capture_default_str();
    addState(command, *settings);
    addUploads(command, *settings);
    addConnections(command, *settings);
    addLimits(command, *settings);
    addDataLimits(command, *settings);
    addFaults(command, *settings);
    command.callback([settings, &exitCode] { exitCode = serve(*settings); });
}

}  // namespace volcast::commands
