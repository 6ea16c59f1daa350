#include "renderer/reference/reference.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <numbers>
#include <string>
#include <thread>

#include "renderer/reference/evaluate.h"
#include "renderer/scene/validate.h"

namespace volcast::reference {
namespace {

constexpr std::array kCorners{glm::ivec2{-1, -1}, glm::ivec2{1, -1}, glm::ivec2{-1, 1},
                              glm::ivec2{1, 1}};
constexpr std::size_t kBatch = 16;  // Rays a thread takes at a time.

/// What all threads did.
struct Effort {
    std::atomic<std::uint64_t> rays{0};
    std::atomic<std::uint64_t> cpuNs{0};
};

std::uint64_t threadCpuNs() {
    timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000U +
           static_cast<std::uint64_t>(now.tv_nsec);
}

/// Calls `work(i, scratch)` for i below `count` on `threads` threads; false if it was cancelled.
template <class Work>
bool forAll(std::size_t count, int threads, const std::atomic<bool>* cancelled, Effort& effort,
            const Work& work) {
    std::atomic<std::size_t> next{0};
    std::atomic<bool> stopped{false};
    const auto takeAll = [&](Scratch& scratch) {
        for (;;) {
            const std::size_t first = next.fetch_add(kBatch);
            if (first >= count) return;
            for (std::size_t i = first; i < std::min(first + kBatch, count); ++i) {
                if (cancelled != nullptr && cancelled->load(std::memory_order_relaxed)) {
                    stopped = true;
                    return;
                }
                work(i, scratch);
            }
        }
    };
    const auto run = [&] {
        Scratch scratch;
        const std::uint64_t start = threadCpuNs();
        takeAll(scratch);
        effort.cpuNs += threadCpuNs() - start;
        effort.rays += scratch.rays;
    };
    std::vector<std::thread> others;
    for (int i = 1; i < threads; ++i) others.emplace_back(run);
    run();
    for (std::thread& other : others) other.join();
    return !stopped;
}

/// Pixels to look at for their shape alone as well: those asked for, and the four at their corners
/// (one of these lies beyond any straight line within a pixel). Sorted, each once, as one number in
/// a picture with a frame of one pixel.
class Places {
public:
    Places(std::span<const glm::ivec2> pixels, scene::PictureSize size) : width_{size.x + 2L} {
        places_.reserve(5 * pixels.size());
        for (const glm::ivec2& pixel : pixels) {
            places_.push_back(numberOf(pixel));
            for (const glm::ivec2& corner : kCorners) places_.push_back(numberOf(pixel + corner));
        }
        std::ranges::sort(places_);
        places_.erase(std::unique(places_.begin(), places_.end()), places_.end());
    }
    [[nodiscard]] std::size_t size() const { return places_.size(); }
    [[nodiscard]] std::size_t indexOf(const glm::ivec2& pixel) const {
        const auto found = std::ranges::lower_bound(places_, numberOf(pixel));
        return static_cast<std::size_t>(found - places_.begin());
    }
    [[nodiscard]] glm::dvec2 centre(std::size_t i) const {
        const std::int64_t row = places_[i] / width_;
        const std::int64_t column = places_[i] % width_;
        return {static_cast<double>(column) - 0.5, static_cast<double>(row) - 0.5};
    }

private:
    [[nodiscard]] std::int64_t numberOf(const glm::ivec2& pixel) const {
        return (pixel.y + 1) * width_ + pixel.x + 1;
    }
    std::int64_t width_;
    std::vector<std::int64_t> places_;
};

/// True where the picture changes by more than it should within a small way of `place`.
///
/// An evaluator in float32 may be off by 1/8000 of a pixel in a picture of 1024 pixels (2^-23 of
/// it); one of three points around lies beyond any straight line within half the way. The slope of
/// a picture that is taken for a jump is above one unit a pixel.
bool jumps(const Evaluator& evaluator, const glm::dvec2& place, const Sight& centre,
           Scratch& scratch) {
    constexpr double kWay = 1.0 / 1024.0;   // Pixels.
    constexpr double kStep = 1.0 / 1024.0;  // Of a channel.
    const double high = 0.5 * std::numbers::sqrt3;
    const std::array around{glm::dvec2{1.0, 0.0}, glm::dvec2{-0.5, high}, glm::dvec2{-0.5, -high}};
    return std::ranges::any_of(around, [&](const glm::dvec2& way) {
        const Sight near = evaluator.look(place + kWay * way, true, scratch);
        const glm::dvec4 change = glm::abs(near.colour - centre.colour);
        return std::max({change.r, change.g, change.b, change.a}) > kStep;
    });
}

Result<void> check(const scene::Scene& scene, scene::PictureSize size,
                   std::span<const glm::ivec2> pixels, int threads) {
    if (auto valid = scene::validate(scene); !valid) return valid;
    if (auto valid = scene::validate(size); !valid) return valid;
    for (const glm::ivec2& pixel : pixels) {
        if (pixel.x >= 0 && pixel.y >= 0 && pixel.x < size.x && pixel.y < size.y) continue;
        return fail(ErrorCode::kInvalidArgument,
                    "reference: pixel " + std::to_string(pixel.x) + ", " + std::to_string(pixel.y) +
                        " lies outside of a picture of " + std::to_string(size.x) + " x " +
                        std::to_string(size.y));
    }
    if (threads >= 1) return {};
    return fail(ErrorCode::kInvalidArgument,
                "reference: " + std::to_string(threads) + " threads, expected 1 or more");
}

Result<std::vector<LayerData>> prepareAll(const scene::Scene& scene, const Bodies& bodies) {
    std::vector<LayerData> layers;
    for (std::size_t i = 0; i < scene.layers.size(); ++i) {
        if (!scene.layers[i].visible) continue;
        auto data = prepare(scene.layers[i], bodies, "layers[" + std::to_string(i) + "]");
        if (!data) return data.error();
        layers.push_back(std::move(*data));
    }
    return layers;
}

}  // namespace

Body makeBody(const data::Dataset& dataset) {
    if (const auto* volume = std::get_if<data::Volume>(&dataset)) {
        return {.mesh = nullptr, .volume = volume};
    }
    return {.mesh = std::make_shared<const Caster>(std::get<data::Mesh>(dataset))};
}

Result<Picture> draw(const scene::Scene& scene, const Bodies& bodies, scene::PictureSize size,
                     std::span<const glm::ivec2> pixels, int threads,
                     const std::atomic<bool>* cancelled) {
    if (auto valid = check(scene, size, pixels, threads); !valid) return valid.error();
    const auto layers = prepareAll(scene, bodies);
    if (!layers) return layers.error();
    std::vector<glm::ivec2> all;
    if (pixels.empty()) {
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) all.emplace_back(x, y);
        }
        pixels = all;
    }
    const Places places{pixels, size};
    std::vector<char> wanted(places.size(), 0);
    for (const glm::ivec2& pixel : pixels) wanted[places.indexOf(pixel)] = 1;

    const Evaluator evaluator{scene, *layers, size};
    std::vector<Sight> sights(places.size());
    std::vector<char> jumping(places.size(), 0);
    Effort effort;
    const auto look = [&](std::size_t i, Scratch& own) {
        const glm::dvec2 centre = places.centre(i);
        sights[i] = evaluator.look(centre, wanted[i] != 0, own);
        if (wanted[i] == 0 || !evaluator.mayJump()) return;
        jumping[i] = jumps(evaluator, centre, sights[i], own) ? 1 : 0;
    };
    const bool done = forAll(places.size(), threads, cancelled, effort, look);
    if (!done) return fail(ErrorCode::kTimeout, "reference: cancelled before the picture was done");

    Picture picture{.size = size, .pixels = {}, .nearEdge = {}};
    picture.rays = effort.rays;
    picture.cpuSeconds = static_cast<double>(effort.cpuNs) * 1e-9;
    for (const glm::ivec2& pixel : pixels) {
        const std::size_t own = places.indexOf(pixel);
        const bool near = std::ranges::any_of(kCorners, [&](const glm::ivec2& corner) {
            return evaluator.apart(sights[own], sights[places.indexOf(pixel + corner)]);
        });
        picture.pixels.push_back(sights[own].colour);
        picture.nearEdge.push_back(near || jumping[own] != 0 ? 1 : 0);
        picture.piecesVisited += sights[own].pieces;
    }
    return picture;
}

Result<Picture> draw(const scene::Scene& scene,
                     const std::map<std::string, const data::Mesh*>& meshes,
                     scene::PictureSize size, std::span<const glm::ivec2> pixels, int threads,
                     const std::atomic<bool>* cancelled) {
    Bodies bodies;
    for (const auto& [id, mesh] : meshes) {
        if (mesh == nullptr) continue;
        bodies.emplace(id, Body{.mesh = std::make_shared<const Caster>(*mesh)});
    }
    return draw(scene, bodies, size, pixels, threads, cancelled);
}

}  // namespace volcast::reference
