// encode/<codec>/<side>: one picture as a renderer makes them, one thread. Of VP9 and H.264
// pictures of a stream in which all moves; a keyframe at first.
#include <array>
#include <cmath>

#include <benchmark/benchmark.h>

#include "server/video/encoder.h"
#include "server/video/video_stream.h"

namespace volcast::bench {
namespace {

/// Smooth shading with thin coloured lines, the upper third background; `step` moves it.
std::vector<std::byte> picture(int side, int step = 0) {
    std::vector<std::byte> rgba(std::size_t{4} * side * side, std::byte{255});
    std::size_t i = 0;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x, i += 4) {
            const double wave =
                y * 3 < side ? 0.0 : 0.5 + 0.5 * std::sin((x + 5 * step) * 0.031 + y * 0.02);
            const bool line = y * 3 >= side && (x + step + 2 * y) % 97 == 0;
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

void webp(benchmark::State& state) {
    encode(state, [](const video::ImageView& image) { return video::encodeWebp(image); });
}

void stream(benchmark::State& state, video::VideoCodec codec) {
    auto made = video::VideoStream::create(codec);
    if (!made) return state.SkipWithError(made.error().message.c_str());
    const int side = static_cast<int>(state.range(0));
    std::array<std::vector<std::byte>, 8> pictures;
    for (int step = 0; step < 8; ++step) {
        pictures[static_cast<std::size_t>(step)] = picture(side, step);
    }
    std::size_t bytes = 0, count = 0;
    for (auto _ : state) {
        const auto& rgba = pictures[count % pictures.size()];
        const auto encoded = (*made)->encode({.size = {side, side}, .rgba = rgba}, 90);
        bytes += encoded->bytes.size();
        ++count;
        benchmark::DoNotOptimize(encoded->bytes.data());
    }
    state.SetLabel((*made)->encoder());
    state.counters["kB"] = static_cast<double>(bytes) / 1e3 / static_cast<double>(count);
    state.SetBytesProcessed(state.iterations() * std::int64_t{4} * side * side);
}

void vp9(benchmark::State& state) {
    stream(state, video::VideoCodec::kVp9);
}
void h264(benchmark::State& state) {
    stream(state, video::VideoCodec::kH264);
}

BENCHMARK(jpeg)->Name("encode/jpeg")->Arg(512)->Arg(1024)->Unit(benchmark::kMillisecond);
BENCHMARK(png)->Name("encode/png")->Arg(512)->Arg(1024)->Unit(benchmark::kMillisecond);
BENCHMARK(webp)->Name("encode/webp")->Arg(512)->Arg(1024)->Unit(benchmark::kMillisecond);
BENCHMARK(vp9)->Name("encode/vp9")->Arg(512)->Arg(1024)->Unit(benchmark::kMillisecond);
BENCHMARK(h264)->Name("encode/h264")->Arg(512)->Arg(1024)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace volcast::bench
