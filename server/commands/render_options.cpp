#include "server/commands/render_options.h"

#include <cmath>

#include <CLI/CLI.hpp>

namespace volcast::commands {

namespace {

/// CLI11's number checks let NaN and infinity through.
std::string checkFinite(const std::string& text) {
    double value = 0.0;
    if (CLI::detail::lexical_cast(text, value) && std::isfinite(value)) return {};
    return "\"" + text + "\" is not a finite number";
}

const CLI::Validator kFinite{checkFinite, "NUMBER", "finite"};

void addSceneOptions(CLI::App& command, RenderOptions& o) {
    auto* scene = command.add_option("--scene", o.sceneFile,
                                     "Scene document (JSON), as a client saves it; its layers are "
                                     "drawn from DATASET");
    command.add_option("--camera", o.camera,
                       "JSON file {eye, center, up, fovy, near, far}; none: all in view");
    command.add_option("--tf", o.map, "Transfer function: lines `value r g b sigma`")
        ->excludes(scene);
    command
        .add_option("--model", o.model,
                    "surface, mip (max) or volume (on, composite); none: as the data suggests")
        ->check(CLI::IsMember({"surface", "mip", "max", "volume", "on", "composite"}))
        ->excludes(scene);
    command.add_option("--field", o.field, "Field or channel by name; none: the first")
        ->excludes(scene);
    command.add_option("--time-step", o.timeStep, "From 0")
        ->check(CLI::NonNegativeNumber)
        ->excludes(scene);
    command
        .add_option("--step", o.step, "Sampling distance in voxels' world units; 0: half a voxel")
        ->check(kFinite & CLI::NonNegativeNumber)
        ->excludes(scene);
    command.add_option("--sampling", o.sampling, "trilinear or nearest")
        ->check(CLI::IsMember({"trilinear", "nearest"}))
        ->excludes(scene);
    command.add_option("--integrator", o.integrator, "auto or average")
        ->check(CLI::IsMember({"auto", "average"}))
        ->excludes(scene);
    auto* colour = command.add_option("--colour", o.colour, "Of a surface: linear R G B")
                       ->expected(3)
                       ->check(kFinite & CLI::NonNegativeNumber)
                       ->excludes(scene);
    command.add_flag("--coloured", o.coloured, "Surface in the colours of its field")
        ->excludes(scene)
        ->excludes(colour);
    command.add_flag("--unlit", o.unlit, "Surface without headlight")->excludes(scene);
}

void addPictureOptions(CLI::App& command, RenderOptions& o) {
    command.add_option("--projection", o.projection, "perspective or orthographic")
        ->check(CLI::IsMember({"perspective", "orthographic"}));
    command
        .add_option("--background", o.background,
                    "Linear R G B behind the picture; none: transparent")
        ->expected(3)
        ->check(kFinite & CLI::NonNegativeNumber);
    command.add_option("--size", o.size, "Width and height in pixels")
        ->expected(2)
        ->check(CLI::Range(1, scene::kMaxPictureSide))
        ->capture_default_str();
    command.add_option("--png", o.png, "Picture in sRGB with straight alpha");
    command.add_option("--raw", o.raw,
                       "float32 little-endian RGBA, top row first, linear, premultiplied, without "
                       "background");
    command.add_flag("--explain", o.explain, "Print how it is drawn, and why");
}

}  // namespace

void addOptions(CLI::App& command, RenderOptions& o) {
    command
        .add_option("dataset", o.dataset, "A file, a folder of pictures, demo:mesh or demo:volume")
        ->required();
    addSceneOptions(command, o);
    addPictureOptions(command, o);
    command
        .add_option("--frames", o.frames,
                    "Measure N frames of an orbit after one warm-up frame; print one JSON line")
        ->check(CLI::Range(0, 1'000'000));
    command.add_option("--orbit", o.orbitDegrees, "Degrees from frame to frame, about up")
        ->check(kFinite)
        ->capture_default_str();
    command
        .add_option("--gpu", o.gpu, "EGL device as `volcast doctor` lists it; none: surfaceless")
        ->envname("VOLCAST_GPU");
    command.add_option("--cache-dir", o.cacheFolder, "Folder for the driver's compiled shaders");
    command.add_option("--shader-dir", o.shaderFolder, "Read shader chunks from here");
    command.add_option("--timeout", o.timeoutSeconds, "Seconds that one frame may take")
        ->check(CLI::Range(0.001, 86'400.0))
        ->capture_default_str();
    command.add_option("--tetgen-switches", o.tetgenSwitches, "How TetGen fills surfaces")
        ->capture_default_str();
    command
        .add_option("--spacing", o.spacing, "Distance of pixels and slices in image stacks: X Y Z")
        ->expected(3)
        ->check(kFinite & CLI::PositiveNumber);
}

}  // namespace volcast::commands
