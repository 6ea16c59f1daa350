// volcast-import: reads one dataset in a sandbox and hands it to who started it.

#include <CLI/CLI.hpp>

#include "server/import/import_job.h"

int main(int argc, char** argv) {
    CLI::App app{
        "Reads one dataset in a sandbox. Started by volcast, which listens at descriptor 3."};
    volcast::data::load::Request request;
    std::vector<double> spacing{0.0, 0.0, 0.0};
    app.add_option("path", request.path, "File, folder, demo:mesh or demo:volume")->required();
    app.add_option("--tetgen-switches", request.tetgenSwitches, "How TetGen fills surfaces");
    app.add_option("--spacing", spacing, "Of the slices of image stacks")->expected(3);
    app.add_option("--max-memory", request.maxMemoryBytes, "In bytes");
    CLI11_PARSE(app, argc, argv);
    request.spacing = {spacing[0], spacing[1], spacing[2]};
    volcast::worker::Channel channel{volcast::base::FileDescriptor{volcast::worker::kChannelFd}};
    return volcast::import::runJob(request, channel).has_value() ? 0 : 1;
}
