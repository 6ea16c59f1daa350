// mesh/<stage>/<points>: what import does between a file's arrays and a mesh that can be drawn, on
// a Delaunay mesh of random points (6.7 cells a point). Inside the time: the stage alone; reading
// and TetGen are not. Counters: ms per million cells, bytes a cell in memory and on the GPU.
#include <map>
#include <random>

#include <benchmark/benchmark.h>

#include "renderer/data/dataset.h"
#include "renderer/data/load/tetrahedralize.h"
#include "renderer/data/mesh_adjacency.h"
#include "renderer/data/mesh_delaunay.h"
#include "renderer/data/mesh_order.h"
#include "renderer/data/mesh_restrict.h"

namespace volcast::bench {
namespace {

/// The cells of `points` random points in a cube, as a file would hold them; made once.
const data::MeshInput& cubeOf(std::int64_t points) {
    static std::map<std::int64_t, data::MeshInput> made;
    const auto found = made.find(points);
    if (found != made.end()) return found->second;
    std::mt19937 random{1};
    std::uniform_real_distribution<double> unit{0.0, 1.0};
    data::load::Surface cloud;
    for (std::int64_t i = 0; i < points; ++i) {
        const double x = unit(random);
        const double y = unit(random);
        cloud.points.emplace_back(x, y, unit(random));
    }
    data::MeshInput mesh = data::load::delaunay(cloud).value().mesh;
    data::FieldInput field{.name = "smooth", .steps = {{}}};
    for (const glm::dvec3& p : mesh.points) field.steps[0].push_back(glm::dot(p, p));
    mesh.fields = {std::move(field)};
    return made.emplace(points, std::move(mesh)).first->second;
}

void report(benchmark::State& state, std::size_t cells) {
    state.counters["cells"] = static_cast<double>(cells);
    state.counters["s_per_million"] = benchmark::Counter(
        static_cast<double>(cells) / 1e6 * static_cast<double>(state.iterations()),
        benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void build(benchmark::State& state) {
    const data::MeshInput& input = cubeOf(state.range(0));
    std::uint64_t bytes = 0;
    for (auto _ : state) {
        state.PauseTiming();
        data::MeshInput copy = input;
        state.ResumeTiming();
        const data::Mesh mesh = data::buildMesh(std::move(copy)).value();
        state.PauseTiming();
        const auto cells = static_cast<double>(mesh.cells.size());
        bytes = data::summarize(data::Dataset{mesh}).bytes;
        state.counters["bytes_a_cell"] = static_cast<double>(bytes) / cells;
        // Two records of 16 bytes a cell and a boundary face, positions and values as they are.
        state.counters["gpu_bytes_a_cell"] =
            (32.0 * (cells + static_cast<double>(mesh.boundaryFaces.size())) +
             16.0 * static_cast<double>(mesh.vertices.size())) /
            cells;
        state.ResumeTiming();
    }
    report(state, input.cells.size());
}

void order(benchmark::State& state) {
    const data::MeshInput& input = cubeOf(state.range(0));
    for (auto _ : state) benchmark::DoNotOptimize(data::orderMesh(input).value().cells.data());
    report(state, input.cells.size());
}

void adjacency(benchmark::State& state) {
    const data::OrderedMesh ordered = data::orderMesh(cubeOf(state.range(0))).value();
    for (auto _ : state) {
        benchmark::DoNotOptimize(
            data::findAdjacency(ordered.cells, ordered.vertices.size()).neighbours.data());
    }
    report(state, ordered.cells.size());
}

void convex(benchmark::State& state) {
    const data::OrderedMesh ordered = data::orderMesh(cubeOf(state.range(0))).value();
    const data::Adjacency found = data::findAdjacency(ordered.cells, ordered.vertices.size());
    for (auto _ : state) {
        if (!data::isConvex(ordered.exactVertices, found)) state.SkipWithError("is not convex");
    }
    report(state, ordered.cells.size());
}

void delaunay(benchmark::State& state) {
    const data::Mesh mesh = data::buildMesh(cubeOf(state.range(0))).value();
    for (auto _ : state) {
        if (data::countDelaunayFaces(mesh).violated > 0) state.SkipWithError("is not Delaunay");
    }
    report(state, mesh.cells.size());
}

void restrictHalf(benchmark::State& state) {
    const data::Mesh mesh = data::buildMesh(cubeOf(state.range(0))).value();
    std::vector<std::int32_t> half;
    for (std::size_t t = 0; t < mesh.cells.size(); t += 2) {
        half.push_back(static_cast<std::int32_t>(t));
    }
    for (auto _ : state) {
        benchmark::DoNotOptimize(data::restrictMesh(mesh, half).mesh.cells.data());
    }
    report(state, mesh.cells.size());
}

#define VOLCAST_STAGE(name, function) \
    BENCHMARK(function)->Name(name)->Arg(15'000)->Arg(150'000)->Unit(benchmark::kMillisecond)

VOLCAST_STAGE("mesh/build", build);
VOLCAST_STAGE("mesh/order", order);
VOLCAST_STAGE("mesh/adjacency", adjacency);
VOLCAST_STAGE("mesh/convex", convex);
VOLCAST_STAGE("mesh/delaunay", delaunay);
VOLCAST_STAGE("mesh/restrict", restrictHalf);

}  // namespace
}  // namespace volcast::bench
