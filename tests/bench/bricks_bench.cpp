// A volume of any size in a budget of any size: what it costs to get it onto the screen from
// bricks, and whether it is right. Timed: the ranges and levels of the import, and each call of
// render() until the picture is ready, in the renderer's own process. The field is known in closed
// form; the last picture is compared with rays through the field itself.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <sys/resource.h>
#include <vector>

#include <CLI/CLI.hpp>

#include "renderer/data/volume_builder.h"
#include "renderer/gpu/device.h"
#include "renderer/plan/effects.h"
#include "renderer/scene/render.h"
#include "tests/support/volume_reference.h"

namespace {

using namespace volcast;
using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

double peakMib() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// Of the box [0, 1]^3: a shell with coarse and fine bumps around a small core; 0 to 255.
double field(const glm::dvec3& at) {
    const glm::dvec3 p = 2.0 * at - 1.0;
    const double r = glm::length(p);
    double value = 100.0 * std::max(0.0, 1.0 - 6.0 * r);
    const double off = (r - 0.7) / 0.06;
    if (std::abs(off) > 4.0) return value;
    const auto bumps = [&p](double k) {
        return std::sin(k * p.x) * std::sin(k * p.y) * std::sin(k * p.z);
    };
    value += 230.0 * std::exp(-off * off) * (0.7 + 0.2 * bumps(24.0) + 0.1 * bumps(160.0));
    return value;
}

data::VolumeInput makeInput(int side) {
    data::VolumeInput input;
    input.size = glm::ivec3(side);
    input.spacing = glm::dvec3(1.0 / (side - 1));
    input.type = data::VoxelType::kU8;
    std::vector<std::byte> voxels(static_cast<std::size_t>(side) * side * side);
    std::size_t i = 0;
    for (int z = 0; z < side; ++z) {
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x, ++i) {
                voxels[i] =
                    static_cast<std::byte>(std::lround(field(input.spacing * glm::dvec3(x, y, z))));
            }
        }
    }
    input.channels.push_back({.name = "shell", .voxels = std::move(voxels)});
    return input;
}

/// The field's own value for a model: of MIP the largest as a grey, else the opacity.
double expected(const scene::Scene& scene, glm::ivec2 size, int x, int y, double step) {
    const auto ray = support::referenceRay(scene.camera, size, x, y);
    glm::dvec2 inside{0.0, 1e300};
    for (int axis = 0; axis < 3; ++axis) {
        const double a = -ray.eye[axis] / ray.direction[axis];
        const double b = (1.0 - ray.eye[axis]) / ray.direction[axis];
        inside = {std::max(inside.x, std::min(a, b)), std::min(inside.y, std::max(a, b))};
    }
    if (inside.x >= inside.y) return 0.0;
    const int samples = static_cast<int>((inside.y - inside.x) / step) + 1;
    double largest = 0.0, sum = 0.0;
    for (int i = 0; i < samples; ++i) {
        const double s = inside.x + (inside.y - inside.x) * (i + 0.5) / samples;
        const double value = field(ray.eye + s * ray.direction);
        largest = std::max(largest, value);
        sum += support::VolumeReference::matterOf(value, scene.layers[0].map).a;
    }
    if (scene.layers[0].model == scene::RayModel::kMip) return largest / 255.0;
    return -std::expm1(-sum * (inside.y - inside.x) / samples);
}

void compare(const scene::Scene& scene, glm::ivec2 size, const std::vector<float>& linear,
             double step) {
    const bool mip = scene.layers[0].model == scene::RayModel::kMip;
    double sum = 0.0, worst = 0.0;
    int count = 0;
    constexpr int kEvery = 16;
    for (int y = kEvery / 2; y < size.y; y += kEvery) {
        for (int x = kEvery / 2; x < size.x; x += kEvery, ++count) {
            const std::size_t i = 4 * (static_cast<std::size_t>(y) * size.x + x) + (mip ? 0 : 3);
            const double off = std::abs(linear[i] - expected(scene, size, x, y, step));
            sum += off * off;
            worst = std::max(worst, off);
        }
    }
    std::printf("  against the field on %d rays: RMS %.2e, largest %.2e\n", count,
                std::sqrt(sum / count), worst);
}

void savePpm(const std::string& path, glm::ivec2 size, const std::vector<std::byte>& rgba) {
    std::ofstream file{path, std::ios::binary};
    file << "P6\n" << size.x << " " << size.y << "\n255\n";
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
        file.write(reinterpret_cast<const char*>(&rgba[i]), 3);
    }
}

struct Options {
    int side = 1024;
    std::size_t budgetMib = 256;
    int pixels = 512;
    std::string pictures;
};

/// What a view took until it was final.
struct Row {
    std::string name;
    double firstSeconds = 0.0, finalSeconds = 0.0;
    int pictures = 0;
    std::size_t read = 0;  // Bytes of bricks, from where the volume is held.
    int finest = 0, coarsest = 0;
};

void printTable(const std::vector<Row>& rows, const Options& options) {
    std::printf("\n%d^3 in %zu MiB, %d x %d pixels\n", options.side, options.budgetMib,
                options.pixels, options.pixels);
    std::printf("%-14s %9s %22s %10s %9s %s\n", "view", "first, s", "while refining", "read, MiB",
                "final, s", "levels");
    for (const Row& row : rows) {
        std::printf("%-14s %9.2f %5d pictures, %4.1f/s %10.1f %9.2f %d to %d\n", row.name.c_str(),
                    row.firstSeconds, row.pictures, row.pictures / row.finalSeconds,
                    static_cast<double>(row.read) / (1 << 20), row.finalSeconds, row.finest,
                    row.coarsest);
    }
}

/// Draws until it is ready, as a server does for a view that is left alone.
Row drawUntilReady(scene::Renderer& renderer, const std::string& name, const scene::Scene& scene,
                   const Options& options) {
    Row row{.name = name};
    const glm::ivec2 size{options.pixels};
    std::vector<float> linear(std::size_t{4} * size.x * size.y);
    std::vector<std::byte> bytes(linear.size());
    std::printf("%s\n", name.c_str());
    const auto start = Clock::now();
    for (int picture = 1;; ++picture) {
        const auto info = renderer.render(1, scene, size, {.rgba8 = bytes, .rgba32f = linear});
        if (!info) {
            std::printf("  %s\n", info.error().message.c_str());
            return row;
        }
        row.pictures = picture;
        row.finalSeconds = secondsSince(start);
        if (picture == 1) row.firstSeconds = row.finalSeconds;
        if (info->bricks.empty()) {
            std::printf("  fits in the budget: draw %.0f ms\n", info->drawMs);
            break;
        }
        const volume::BrickReport& report = info->bricks[0].report;
        row.read += report.loadedBytes;
        row.finest = report.finest;
        row.coarsest = report.coarsest;
        std::printf(
            "  picture %d: %zu of %zu bricks, %.1f MiB loaded, upload %.0f ms, draw %.0f ms\n",
            picture, report.resident, report.needed,
            static_cast<double>(report.loadedBytes) / (1 << 20), info->uploadMs, info->drawMs);
        if (!options.pictures.empty()) {
            savePpm(options.pictures + "/" + name + "_" + std::to_string(picture) + ".ppm", size,
                    bytes);
        }
        if (!info->ready) continue;
        for (const plan::Effect& effect : info->plan.layers[0].effects) {
            if (effect.name == plan::kBricks) std::printf("  %s\n", effect.reason.c_str());
        }
        std::printf("  ready after %.2f s, %.1f MiB read\n", row.finalSeconds,
                    static_cast<double>(row.read) / (1 << 20));
        break;
    }
    compare(scene, size, linear, 0.25 / options.side);
    return row;
}

int run(const Options& options) {
    auto device = gpu::Device::create();
    if (!device) {
        std::printf("%s\n", device.error().message.c_str());
        return 1;
    }
    auto start = Clock::now();
    data::VolumeInput input = makeInput(options.side);
    std::printf("%d^3 voxels of u8 made in %.1f s, peak %.0f MiB\n", options.side,
                secondsSince(start), peakMib());
    start = Clock::now();
    auto volume = data::buildVolume(std::move(input));
    if (!volume) {
        std::printf("%s\n", volume.error().message.c_str());
        return 1;
    }
    std::printf("ranges and %d coarser levels in %.1f s, peak %.0f MiB\n", volume->coarserLevels(),
                secondsSince(start), peakMib());
    auto renderer = scene::Renderer::create(**device, shading::embeddedChunks(),
                                            {.volumeBytes = options.budgetMib << 20U});
    if (!renderer) {
        std::printf("%s\n", renderer.error().message.c_str());
        return 1;
    }
    (*renderer)->addDataset("volume", *std::move(volume));
    scene::Scene scene;
    scene::Layer& layer = scene.layers.emplace_back();
    layer.id = "layer";
    layer.dataset = "volume";
    const auto grey = [](float value, float extinction) {
        return data::ControlPoint{
            .value = value, .colour = glm::vec3(value / 255.0F), .extinction = extinction};
    };
    std::vector<Row> rows;
    const auto draw = [&](const std::string& name, scene::RayModel model, glm::dvec3 eye,
                          glm::dvec3 center, double fovy, float deepest) {
        layer.model = model;
        layer.map.points = {grey(0.0F, 0.0F), grey(255.0F, deepest)};
        scene.camera = {.eye = eye, .center = center, .fovyDegrees = fovy};
        rows.push_back(drawUntilReady(**renderer, name, scene, options));
    };
    const glm::dvec3 far{2.1, 1.6, 2.4}, middle{0.5};
    draw("whole_mip", scene::RayModel::kMip, far, middle, 30.0, 10.0F);
    draw("whole_volume", scene::RayModel::kVolume, far, middle, 30.0, 10.0F);
    // From within, at the shell: level 0 near the eye.
    draw("near_volume", scene::RayModel::kVolume, {0.5, 0.5, 0.62}, {0.5, 0.52, 0.87}, 25.0, 40.0F);
    printTable(rows, options);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Draws a large volume from bricks within a budget of memory"};
    Options options;
    app.add_option("--side", options.side, "Voxels along an axis")->check(CLI::Range(130, 4096));
    app.add_option("--budget", options.budgetMib, "MiB")->check(CLI::Range(1, 1 << 20));
    app.add_option("--pixels", options.pixels, "Along a side")->check(CLI::Range(16, 4096));
    app.add_option("--pictures", options.pictures, "Folder for all pictures, as PPM");
    CLI11_PARSE(app, argc, argv);
    return run(options);
}
