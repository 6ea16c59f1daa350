#include "server/commands/accuracy_options.h"

#include <CLI/CLI.hpp>

namespace volcast::commands {

namespace {

constexpr std::uint64_t kMostPixels =
    static_cast<std::uint64_t>(scene::kMaxPictureSide) * scene::kMaxPictureSide;

/// "all" is 0 pixels to CLI11's number check.
std::string countFrom(const std::string& text) {
    return text == "all" ? "0" : text;
}

}  // namespace

void addOptions(CLI::App& command, AccuracyOptions& o) {
    addSceneOptions(command, o.scene, Choices::kOwn);
    command.add_option("--model", o.models, "Only this ray model; may be given several times")
        ->check(knownModel())
        ->allow_extra_args(false);
    command.add_option("--integrator", o.integrators, "Only this one; may be given several times")
        ->check(knownIntegrator())
        ->allow_extra_args(false);
    command.add_option("--evaluator", o.evaluators, "Only this one; may be given several times")
        ->check(knownEvaluator())
        ->allow_extra_args(false);
    command.add_option("--frames", o.frames, "Frames to time, after one that warms up")
        ->check(CLI::Range(1, 10'000))
        ->capture_default_str();
    command
        .add_option("--sample", o.sample,
                    "Pixels to compare with the reference, spread over the picture, or `all`")
        ->transform(CLI::Validator(
            [](std::string& text) {
                text = countFrom(text);
                return std::string{};
            },
            "PIXELS"))
        ->check(CLI::Range(std::uint64_t{0}, kMostPixels))
        ->capture_default_str();
    command.add_option("--json", o.json, "Write everything that was measured to this file");
    command.add_option("--svg", o.svg, "Write a plot of error against time to this file");
}

}  // namespace volcast::commands
