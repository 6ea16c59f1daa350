#include <cstdio>
#include <filesystem>
#include <optional>
#include <unistd.h>

#include <CLI/CLI.hpp>

#include "renderer/base/subordinate.h"
#include "server/import/import_job.h"

namespace volcast::import {

namespace {

/// Becomes `volcast-import-images` with the same arguments; comes back only if there is none.
void becomeImagesProgram(char** argv) {
    std::error_code error;
    auto program = std::filesystem::read_symlink("/proc/self/exe", error);
    if (error) return;
    program.replace_filename("volcast-import-images");
    ::execv(program.c_str(), argv);
}

worker::Fault importFault(const std::string& text) {
    const auto spec = worker::parseFault(text);
    if (!spec) throw CLI::ValidationError{"--fault", spec.error().message};
    if (worker::struckBy(spec->fault) != worker::FaultyProcess::kImport) {
        throw CLI::ValidationError{"--fault", text + " strikes workers, not imports"};
    }
    return spec->fault;
}

}  // namespace

int importMain(int argc, char** argv, data::load::ImageReader readImages) {
    base::becomeSubordinate();
    CLI::App app{
        "Reads one dataset in a sandbox. Started by volcast, which listens at descriptor 3."};
    data::load::Request request;
    std::vector<double> spacing{0.0, 0.0, 0.0};
    app.add_option("path", request.path, "File, folder, demo:mesh or demo:volume")->required();
    app.add_option("--tetgen-switches", request.tetgenSwitches, "How TetGen fills surfaces");
    app.add_option("--spacing", spacing, "Of the slices of image stacks")->expected(3);
    app.add_option("--max-memory", request.maxMemoryBytes, "In bytes");
    app.add_option("--beneath", request.beneath, "Read nothing but what lies below this folder");
    app.add_option("--max-cpu", request.maxCpuSeconds, "In seconds, of all threads; 0: no limit");
    std::optional<worker::Fault> fault;
    app.add_option_function<std::string>(
        "--fault", [&](const std::string& text) { fault = importFault(text); },
        "Fail, for tests, as --list-faults names it");
    app.add_flag_callback(
        "--list-faults",
        [] {
            std::fputs(worker::faultList().c_str(), stdout);
            throw CLI::Success{};
        },
        "Print those names; those of workers strike no import");
    bool triesForbidden = false;
    app.add_flag("--try-forbidden", triesForbidden,
                 "Try what the sandbox is to refuse, and print what became of it");
    CLI11_PARSE(app, argc, argv);
    request.spacing = {spacing[0], spacing[1], spacing[2]};
    if (readImages == nullptr && data::load::needsImages(request.path)) becomeImagesProgram(argv);
    if (triesForbidden) return tryForbidden(request);
    worker::Channel channel{base::FileDescriptor{worker::kChannelFd}};
    return runJob(request, readImages, channel, fault).has_value() ? 0 : 1;
}

}  // namespace volcast::import
