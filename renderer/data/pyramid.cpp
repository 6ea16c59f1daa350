#include "renderer/data/pyramid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "renderer/data/brick_ranges.h"
#include "renderer/data/voxel_dispatch.h"

namespace volcast::data {

namespace {

std::size_t product(const glm::ivec3& v) {
    return static_cast<std::size_t>(v.x) * static_cast<std::size_t>(v.y) *
           static_cast<std::size_t>(v.z);
}

/// What a coarse point is made of along one axis: fine points and their weights, which add up to 1.
struct Stencil {
    int first = 0;  ///< Of three; those beyond the grid have no weight and are not read.
    std::array<float, 3> weights{};
};

/// Stencils of all points of `level` along an axis of `points` grid points.
std::vector<Stencil> stencilsOf(int points, int fineCount, int coarseCount, int level) {
    const int fineInterval = 1 << (level - 1);
    const auto place = [&](int i) { return std::min(i * fineInterval, points - 1); };
    std::vector<Stencil> stencils(static_cast<std::size_t>(coarseCount));
    for (int j = 0; j < coarseCount; ++j) {
        const int middle = std::min(2 * j, fineCount - 1);
        Stencil& stencil = stencils[static_cast<std::size_t>(j)];
        stencil.first = middle - 1;
        stencil.weights[1] = 1.0F;
        if (middle == 0 || middle == fineCount - 1) continue;
        // The mean of a piecewise linear function over [-h, h] about a point.
        const auto before = static_cast<float>(place(middle) - place(middle - 1));
        const auto behind = static_cast<float>(place(middle + 1) - place(middle));
        const float h = std::min(before, behind);
        const float left = 0.25F * h / before;
        const float right = 0.25F * h / behind;
        stencil.weights = {left, 1.0F - left - right, right};
    }
    return stencils;
}

/// Calls `use(i, weight)` for the fine points that count.
template <class Use>
void visit(const Stencil& stencil, const Use& use) {
    for (int i = 0; i < 3; ++i) {
        const float weight = stencil.weights[static_cast<std::size_t>(i)];
        if (weight != 0.0F) use(stencil.first + i, weight);
    }
}

template <class T>
T rounded(float value, const Range& range) {
    if constexpr (std::is_floating_point_v<T>) {
        return std::clamp(value, range.min, range.max);  // A sum of rounded products may leave it.
    } else {
        return static_cast<T>(std::nearbyint(value));  // Means never leave the type's range.
    }
}

/// Sums of values and of their weights along a row of fine points, with a point to spare at each
/// end. Weights are kept where some values are missing; else they add up to 1.
template <bool SomeMissing>
struct Row {
    std::vector<float> sums, weights;

    explicit Row(int points) : sums(static_cast<std::size_t>(points) + 2) {
        if (SomeMissing) weights.resize(sums.size());
    }
    void clear() {
        std::ranges::fill(sums, 0.0F);
        std::ranges::fill(weights, 0.0F);
    }
    template <class T>
    void add(const T* values, float weight) {
        for (std::size_t x = 1; x + 1 < sums.size(); ++x) {
            const auto value = static_cast<float>(values[x - 1]);
            if constexpr (SomeMissing) {
                const bool there = !std::isnan(value);
                weights[x] += there ? weight : 0.0F;
                sums[x] += there ? weight * value : 0.0F;
            } else {
                sums[x] += weight * value;
            }
        }
    }
    [[nodiscard]] float mean(const Stencil& stencil) const {
        const auto along = [&stencil](const std::vector<float>& row) {
            const float* at = row.data() + stencil.first + 1;
            return stencil.weights[0] * at[0] + stencil.weights[1] * at[1] +
                   stencil.weights[2] * at[2];
        };
        if constexpr (!SomeMissing) return along(sums);
        const float weight = along(weights);
        return weight > 0.0F ? along(sums) / weight : std::numeric_limits<float>::quiet_NaN();
    }
};

template <bool SomeMissing, class T>
void halveAs(const Volume& volume, int level, const Range& range, const T* fine, T* coarse,
             const std::function<void(double)>& progress) {
    const glm::ivec3 from = volume.levelSize(level - 1);
    const glm::ivec3 to = volume.levelSize(level);
    const auto xs = stencilsOf(volume.size.x, from.x, to.x, level);
    const auto ys = stencilsOf(volume.size.y, from.y, to.y, level);
    const auto zs = stencilsOf(volume.size.z, from.z, to.z, level);
    Row<SomeMissing> row{from.x};  // Of means across y and z.
    for (int z = 0; z < to.z; ++z) {
        for (int y = 0; y < to.y; ++y) {
            row.clear();
            visit(zs[static_cast<std::size_t>(z)], [&](int fineZ, float weightZ) {
                visit(ys[static_cast<std::size_t>(y)], [&](int fineY, float weightY) {
                    row.add(fine + (static_cast<std::size_t>(fineZ) * from.y + fineY) * from.x,
                            weightZ * weightY);
                });
            });
            T* target = coarse + (static_cast<std::size_t>(z) * to.y + y) * to.x;
            for (int x = 0; x < to.x; ++x) {
                target[x] = rounded<T>(row.mean(xs[static_cast<std::size_t>(x)]), range);
            }
        }
        progress(static_cast<double>(z + 1) / to.z);
    }
}

}  // namespace

int pyramidLevels(const glm::ivec3& size) noexcept {
    if (product(size) < kLeastPyramidVoxels) return 0;
    const int intervals = std::max({size.x, size.y, size.z}) - 1;
    int levels = 0;
    while ((intervals + (1 << levels) - 1) >> levels > kCoarsestIntervals) ++levels;
    return levels;
}

std::size_t pyramidBytes(const Volume& volume) noexcept {
    std::size_t voxels = 0;
    const int levels = pyramidLevels(volume.size);
    for (int level = 1; level <= levels; ++level) voxels += product(volume.levelSize(level));
    return voxels * voxelBytes(volume.type);
}

void halve(const Volume& volume, int level, const KnownVoxels& known,
           std::span<const std::byte> fine, std::span<std::byte> coarse,
           const std::function<void(double)>& progress) {
    withVoxelType(volume.type, [&](auto kind) {
        using T = decltype(kind);
        const auto* from = reinterpret_cast<const T*>(fine.data());
        auto* to = reinterpret_cast<T*>(coarse.data());
        if constexpr (std::is_floating_point_v<T>) {
            if (known.someMissing) {
                return halveAs<true>(volume, level, known.range, from, to, progress);
            }
        }
        halveAs<false>(volume, level, known.range, from, to, progress);
    });
}

std::vector<ChannelLevel> buildPyramid(const Volume& volume, const Channel& channel,
                                       const std::function<void(double)>& progress) {
    std::span<const std::byte> voxels = channel.voxels.span();
    std::span<const glm::vec2> bricks = channel.bricks.span();
    std::vector<ChannelLevel> levels;
    const int count = pyramidLevels(volume.size);
    const KnownVoxels known{.range = channel.range, .someMissing = channel.voxelsWithoutValue > 0};
    double done = 0.0;
    for (int level = 1; level <= count; ++level) {
        std::vector<std::byte> coarse(product(volume.levelSize(level)) * voxelBytes(volume.type));
        // Each level takes an eighth of the time of the one before.
        const double share = (1.0 - done) * 7.0 / 8.0;
        halve(volume, level, known, voxels, coarse,
              [&](double part) { progress(done + part * share); });
        done += share;
        std::vector<glm::vec2> ranges = brickRanges(volume, level, coarse);
        includeFiner(volume, level, bricks, ranges);
        levels.push_back({.voxels = std::move(coarse), .bricks = std::move(ranges)});
        voxels = levels.back().voxels.span();
        bricks = levels.back().bricks.span();
    }
    return levels;
}

}  // namespace volcast::data
