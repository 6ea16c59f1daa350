#include "server/commands/render_options.h"

#include <CLI/CLI.hpp>

namespace volcast::commands {

void addOptions(CLI::App& command, RenderOptions& o) {
    addSceneOptions(command, o.scene, Choices::kOne);
    command.add_option("--png", o.png, "Picture in sRGB with straight alpha");
    command.add_option("--raw", o.raw,
                       "float32 little-endian RGBA, top row first, linear, premultiplied, without "
                       "background");
    command.add_flag("--explain", o.explain, "Print how it is drawn, and why");
    command
        .add_option("--frames", o.frames,
                    "Measure N frames of an orbit after one warm-up frame; print one JSON line")
        ->check(CLI::Range(0, 1'000'000));
    command.add_option("--orbit", o.orbitDegrees, "Degrees from frame to frame, about up")
        ->check(finite())
        ->capture_default_str();
    command
        .add_option("--level-step", o.levelStep, "Added to each of --levels from frame to frame")
        ->check(finite())
        ->needs(command.get_option("--levels"));
}

}  // namespace volcast::commands
