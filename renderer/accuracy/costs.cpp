#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "renderer/accuracy/evidence.h"
#include "renderer/data/mesh_builder.h"
#include "renderer/scene/default_scene.h"
#include "renderer/scene/ray_models.h"

namespace volcast::accuracy {
namespace {

constexpr const char* kDataset = "costs";
constexpr const char* kHeading = "volcast costs 2";
constexpr std::array kSizes{96, 384};  // Pixels along both sides.
constexpr int kSide = 12;              // Cubes along an edge of the mesh that is measured on.

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

}  // namespace

Result<void> Costs::prepare(scene::Renderer& renderer) {
    if (!costs_.empty()) return {};
    load();
    if (!costs_.empty()) return {};
    Result<void> done = measure(renderer);
    renderer.removeDataset(kDataset);
    if (done) save();
    return done;
}

Result<void> Costs::measure(scene::Renderer& renderer) {
    auto mesh = wavyCube();
    if (!mesh) return std::move(mesh).error();
    data::Dataset dataset{*std::move(mesh)};
    const data::DatasetSummary summary = data::summarize(dataset);
    renderer.addDataset(kDataset, std::move(dataset));
    Meter meter{renderer};
    std::map<Key, Cost> found;
    for (const scene::RayModelRow& row : scene::rayModels()) {
        if (row.integrators.size() < 2) continue;
        Job job{
            .scene = scene::defaultScene(kDataset, summary), .size = {}, .frames = 3, .pixels = 64};
        job.scene.layers = {scene::defaultLayer(kDataset, summary, "f", row.model)};
        for (const scene::IntegratorRow& integrator : row.integrators) {
            job.candidate = {.integrator = integrator.integrator,
                             .evaluator = scene::MeshEvaluator::kWalk};
            std::array<double, 2> ms{}, cells{};
            for (std::size_t i = 0; i < kSizes.size(); ++i) {
                job.size = scene::PictureSize{kSizes[i]};
                const auto measured = meter.measure(job);
                if (!measured) return measured.error();
                ms[i] = measured->minMs;  // The least disturbed.
                cells[i] = measured->cellsPerRay * kSizes[i] * kSizes[i];
            }
            const double cellMs = std::max(ms[1] - ms[0], 0.05 * ms[1]) / (cells[1] - cells[0]);
            found[{row.model, integrator.integrator}] = {
                .pictureMs = std::max(ms[0] - cellMs * cells[0], 0.0), .cellNs = 1e6 * cellMs};
        }
    }
    costs_ = std::move(found);
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
    std::size_t expected = 0;
    for (const scene::RayModelRow& row : scene::rayModels()) {
        if (row.integrators.size() > 1) expected += row.integrators.size();
    }
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
    if (read.size() == expected) costs_ = std::move(read);
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
