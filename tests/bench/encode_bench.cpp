// encode/<codec>/<side>: one picture as a renderer makes them, one thread.
#include <cmath>

#include <benchmark/benchmark.h>

#include "server/video/encoder.h"

namespace volcast::bench {
namespace {

/// Smooth shading with thin coloured lines, the upper third background.
std::vector<std::byte> picture(int side) {
    std::vector<std::byte> rgba(std::size_t{4} * side * side, std::byte{255});
    std::size_t i = 0;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x, i += 4) {
            const double wave = y * 3 < side ? 0.0 : 0.5 + 0.5 * std::sin(x * 0.031 + y * 0.02);
            const bool line = y * 3 >= side && (x + 2 * y) % 97 == 0;
            rgba[i] = std::byte(line ? 250 : static_cast<int>(200 * wave));
            rgba[i + 1] = std::byte(line ? 40 : static_cast<int>(120 * wave));
            rgba[i + 2] = std::byte(static_cast<int>(230 * wave));
        }
    }
    return rgba;
}

template <class Encode>
void encode(benchmark::State& state, Encode encoder) {
    const int side = static_cast<int>(state.range(0));
    const std::vector<std::byte> rgba = picture(side);
    std::size_t bytes = 0;
    for (auto _ : state) {
        const auto encoded = encoder(video::ImageView{.size = {side, side}, .rgba = rgba});
        bytes = encoded->size();
        benchmark::DoNotOptimize(encoded->data());
    }
    state.counters["kB"] = static_cast<double>(bytes) / 1e3;
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(rgba.size()));
}

void jpeg(benchmark::State& state) {
    encode(state, [](const video::ImageView& image) { return video::encodeJpeg(image); });
}
void png(benchmark::State& state) {
    encode(state, [](const video::ImageView& image) { return video::encodePng(image); });
}

BENCHMARK(jpeg)->Name("encode/jpeg")->Arg(512)->Arg(1024)->Unit(benchmark::kMillisecond);
BENCHMARK(png)->Name("encode/png")->Arg(512)->Arg(1024)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace volcast::bench
