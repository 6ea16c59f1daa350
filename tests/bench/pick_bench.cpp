// How long a pointer waits for what is under it: one pick of a volume of voxels, by model and
// sampling. Timed: Picker::pick() of one pixel after another, in a process that has picked one
// before; what travels to a client and back is not in it. The field is known in closed form: picked
// values are compared with it.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "renderer/data/volume_builder.h"
#include "renderer/pick/picker.h"
#include "renderer/scene/ray_models.h"

namespace {

using namespace volcast;
using Clock = std::chrono::steady_clock;

struct Options {
    int side = 256;
    int pixels = 512;
    int picks = 400;
};

double field(const glm::dvec3& p) {
    const glm::dvec3 d = 2.0 * p - 1.0;
    return std::exp(-2.0 * glm::dot(d, d)) *
           (0.8 + 0.2 * std::sin(9.0 * d.x) * std::cos(7.0 * d.y));
}

data::Dataset makeVolume(int side) {
    data::VolumeInput input;
    input.size = glm::ivec3(side);
    input.spacing = glm::dvec3(1.0 / (side - 1));
    std::vector<std::byte> voxels(static_cast<std::size_t>(side) * side * side * sizeof(float));
    std::size_t i = 0;
    for (int z = 0; z < side; ++z) {
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x, i += sizeof(float)) {
                const auto value = static_cast<float>(field(input.spacing * glm::dvec3(x, y, z)));
                std::memcpy(&voxels[i], &value, sizeof value);
            }
        }
    }
    input.channels.push_back({.name = "f", .voxels = std::move(voxels)});
    return data::buildVolume(std::move(input)).value();
}

void measure(pick::Picker& picker, const data::Dataset& volume, const scene::Scene& scene,
             const Options& options, const std::string& name) {
    const glm::ivec2 size{options.pixels};
    std::vector<double> ms;
    double worst = 0.0;
    int hits = 0;
    const auto datasets = [&](const std::string&) { return &volume; };
    for (int i = 0; i <= options.picks; ++i) {
        // The golden ratio and its square spread picks over the picture.
        const glm::dvec2 at = glm::fract(glm::dvec2(0.6180339887 * i, 0.7548776662 * i));
        const auto start = Clock::now();
        const auto picked = picker.pick(scene, size, glm::ivec2(at * glm::dvec2(size)), datasets);
        const std::chrono::duration<double, std::milli> taken = Clock::now() - start;
        if (i > 0) ms.push_back(taken.count());  // The first prepares.
        if (!picked || !*picked) continue;
        ++hits;
        worst = std::max(worst, std::abs((*picked)->values[0].value - field((*picked)->position)));
    }
    std::ranges::sort(ms);
    const auto share = [&](double part) {
        return ms[static_cast<std::size_t>(part * static_cast<double>(ms.size() - 1))];
    };
    std::printf("%-24s %7.2f %7.2f %7.2f   %4d of %d, off by %.1e at most\n", name.c_str(),
                share(0.5), share(0.99), ms.back(), hits, options.picks, worst);
}

void run(const Options& options) {
    const data::Dataset volume = makeVolume(options.side);
    scene::Scene scene;
    scene.camera = {.eye = {2.1, 1.6, 2.4}, .center = {0.5, 0.5, 0.5}, .fovyDegrees = 30.0};
    scene::Layer& layer = scene.layers.emplace_back();
    layer.id = "layer";
    layer.dataset = "volume";
    layer.levels.values = {0.4F};
    layer.map.points = {{.value = 0.0F, .colour = glm::vec3(0.1F), .extinction = 0.0F},
                        {.value = 1.0F, .colour = glm::vec3(1.0F), .extinction = 8.0F}};
    std::printf("%d^3 float32, %d x %d pixels; milliseconds a pick\n%-24s %7s %7s %7s\n",
                options.side, options.pixels, options.pixels, "", "median", "99 %", "most");
    for (const scene::RayModel model :
         {scene::RayModel::kVolume, scene::RayModel::kMip, scene::RayModel::kIsosurface}) {
        for (const scene::Sampling sampling :
             {scene::Sampling::kNearest, scene::Sampling::kTrilinear, scene::Sampling::kTricubic}) {
            layer.model = model;
            layer.sampling = sampling;
            pick::Picker picker;
            measure(picker, volume, scene, options,
                    std::string{scene::name(model)} + ", " + std::string{scene::name(sampling)});
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Latency of picks of voxels"};
    Options options;
    app.add_option("--side", options.side, "Voxels along an axis")->check(CLI::Range(16, 1024));
    app.add_option("--pixels", options.pixels, "Along a side")->check(CLI::Range(16, 4096));
    app.add_option("--picks", options.picks, "Of each row")->check(CLI::Range(1, 100000));
    CLI11_PARSE(app, argc, argv);
    run(options);
    return 0;
}
