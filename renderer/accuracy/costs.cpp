#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <sstream>

#include "renderer/accuracy/evidence.h"
#include "renderer/data/mesh_builder.h"
#include "renderer/scene/default_scene.h"
#include "renderer/scene/ray_models.h"

namespace volcast::accuracy {
namespace {

constexpr const char* kDataset = "costs";
constexpr const char* kHeading = "volcast costs 3";
constexpr std::array kSizes{96, 288};  // Pixels along both sides.
// What else the machine does lasts longer than a picture: each cost is measured at so many times.
constexpr int kRounds = 3;
constexpr int kSide = 12;  // Cubes along an edge of the mesh that is measured on.

/// One picture: the least disturbed of all rounds.
struct Sample {
    double ms = std::numeric_limits<double>::infinity();
    double cells = 0.0;  ///< On all its rays.
};

using Samples = std::map<Costs::Key, std::array<Sample, kSizes.size()>>;

/// A cube of kSide^3 cubes of six cells, moved so that no ray is special, with a wave in it.
Result<data::Mesh> wavyCube() {
    data::MeshInput mesh;
    std::vector<double> values;
    const auto id = [](int x, int y, int z) {
        return (std::int64_t{z} * (kSide + 1) + y) * (kSide + 1) + x;
    };
    for (int z = 0; z <= kSide; ++z) {
        for (int y = 0; y <= kSide; ++y) {
            for (int x = 0; x <= kSide; ++x) {
                const glm::dvec3 p{x + 0.2 * std::sin(y + 2.0 * z), y + 0.2 * std::sin(z + 2.0 * x),
                                   z + 0.2 * std::sin(x + 2.0 * y)};
                mesh.points.push_back(p / static_cast<double>(kSide));
                values.push_back(std::sin(0.9 * x) * std::cos(0.7 * y + 0.5 * z));
            }
        }
    }
    // Kuhn's triangulation: the six ways from one corner of a cube to the opposite one.
    constexpr int kWays[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (int cube = 0; cube < kSide * kSide * kSide; ++cube) {
        for (const auto& way : kWays) {
            glm::ivec3 p{cube % kSide, cube / kSide % kSide, cube / (kSide * kSide)};
            std::array<std::int64_t, 4> cell{id(p.x, p.y, p.z)};
            for (std::size_t i = 0; i < 3; ++i) {
                ++p[way[i]];
                cell[i + 1] = id(p.x, p.y, p.z);
            }
            mesh.cells.push_back(cell);
        }
    }
    mesh.fields.push_back({.name = "f", .steps = {std::move(values)}});
    return data::buildMesh(std::move(mesh));
}

/// One round over all integrators of `job`'s layer.
Result<void> measureRound(Meter& meter, Job job, Samples& least) {
    const scene::RayModel model = job.scene.layers.front().model;
    for (const scene::IntegratorRow& integrator : scene::row(model).integrators) {
        job.candidate = {.integrator = integrator.integrator,
                         .evaluator = scene::MeshEvaluator::kWalk};
        auto& samples = least[{model, integrator.integrator}];
        for (std::size_t i = 0; i < kSizes.size(); ++i) {
            job.size = scene::PictureSize{kSizes[i]};
            const auto measured = meter.measure(job);
            if (!measured) return measured.error();
            samples[i].ms = std::min(samples[i].ms, measured->minMs);
            samples[i].cells = measured->cellsPerRay * kSizes[i] * kSizes[i];
        }
    }
    return {};
}

}  // namespace

Result<void> Costs::prepare(scene::Renderer& renderer, scene::RayModel model) {
    if (know(model)) return {};
    load();
    if (know(model)) return {};
    Result<void> done = measure(renderer, model);
    renderer.removeDataset(kDataset);
    if (done) save();
    return done;
}

bool Costs::know(scene::RayModel model) const {
    return std::ranges::all_of(scene::row(model).integrators, [&](const auto& integrator) {
        return costs_.contains({model, integrator.integrator});
    });
}

Result<void> Costs::measure(scene::Renderer& renderer, scene::RayModel model) {
    auto mesh = wavyCube();
    if (!mesh) return std::move(mesh).error();
    data::Dataset dataset{*std::move(mesh)};
    const data::DatasetSummary summary = data::summarize(dataset);
    renderer.addDataset(kDataset, std::move(dataset));
    Meter meter{renderer};
    Job job{.scene = scene::defaultScene(kDataset, summary), .size = {}, .frames = 1, .pixels = 64};
    job.scene.layers = {scene::defaultLayer(kDataset, summary, "f", model)};
    Samples least;
    for (int round = 0; round < kRounds; ++round) {
        if (auto done = measureRound(meter, job, least); !done) return done;
    }
    for (const auto& [key, samples] : least) {
        const auto& [small, large] = samples;
        const double cellMs =
            std::max(large.ms - small.ms, 0.05 * large.ms) / (large.cells - small.cells);
        costs_[key] = {.pictureMs = std::max(small.ms - cellMs * small.cells, 0.0),
                       .cellNs = 1e6 * cellMs};
    }
    return {};
}

double Costs::predictMs(const Key& key, scene::PictureSize size, double cellsPerRay) const {
    const Cost& cost = costs_.at(key);
    return cost.pictureMs + cost.cellNs * 1e-6 * size.x * size.y * cellsPerRay;
}

void Costs::load() {
    std::ifstream file{file_};
    std::string heading, machine, line;
    if (!std::getline(file, heading) || heading != kHeading) return;
    if (!std::getline(file, machine) || machine != machine_) return;
    std::map<Key, Cost> read;
    while (std::getline(file, line)) {
        std::istringstream words{line};
        std::string model, integrator;
        Cost cost;
        if (!(words >> model >> integrator >> cost.pictureMs >> cost.cellNs)) return;
        if (!(cost.pictureMs >= 0.0 && cost.cellNs > 0.0)) return;
        const auto known = scene::rayModelNamed(model);
        const auto named = scene::integratorNamed(integrator);
        if (!known || !named) return;
        read[{*known, *named}] = cost;
    }
    costs_.merge(read);
}

void Costs::save() const {
    if (file_.empty()) return;
    const std::string fresh = file_ + ".new";
    {
        std::ofstream file{fresh};
        file << kHeading << '\n' << machine_ << '\n';
        for (const auto& [key, cost] : costs_) {
            file << scene::name(key.first) << ' ' << scene::name(key.second) << ' '
                 << cost.pictureMs << ' ' << cost.cellNs << '\n';
        }
        if (!file.flush()) return;
    }
    // Whole or not at all: another worker may be reading.
    std::rename(fresh.c_str(), file_.c_str());
}

}  // namespace volcast::accuracy
