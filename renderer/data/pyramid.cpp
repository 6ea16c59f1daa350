#include "renderer/data/pyramid.h"

#include <algorithm>
#include <array>
#include <cmath>
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

template <class T>
void halveAs(const Volume& volume, int level, const Range& range, const T* fine, T* coarse,
             const std::function<void(double)>& progress) {
    const glm::ivec3 from = volume.levelSize(level - 1);
    const glm::ivec3 to = volume.levelSize(level);
    const auto xs = stencilsOf(volume.size.x, from.x, to.x, level);
    const auto ys = stencilsOf(volume.size.y, from.y, to.y, level);
    const auto zs = stencilsOf(volume.size.z, from.z, to.z, level);
    // A row of means across y and z, with a point to spare at each end.
    std::vector<float> row(static_cast<std::size_t>(from.x) + 2);
    for (int z = 0; z < to.z; ++z) {
        for (int y = 0; y < to.y; ++y) {
            std::fill(row.begin(), row.end(), 0.0F);
            visit(zs[static_cast<std::size_t>(z)], [&](int fineZ, float weightZ) {
                visit(ys[static_cast<std::size_t>(y)], [&](int fineY, float weightY) {
                    const T* values =
                        fine + (static_cast<std::size_t>(fineZ) * from.y + fineY) * from.x;
                    const float weight = weightZ * weightY;
                    for (int x = 0; x < from.x; ++x) {
                        row[static_cast<std::size_t>(x) + 1] +=
                            weight * static_cast<float>(values[x]);
                    }
                });
            });
            T* target = coarse + (static_cast<std::size_t>(z) * to.y + y) * to.x;
            for (int x = 0; x < to.x; ++x) {
                const Stencil& stencil = xs[static_cast<std::size_t>(x)];
                const float* values = row.data() + stencil.first + 1;
                target[x] =
                    rounded<T>(stencil.weights[0] * values[0] + stencil.weights[1] * values[1] +
                                   stencil.weights[2] * values[2],
                               range);
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

void halve(const Volume& volume, int level, const Range& range, std::span<const std::byte> fine,
           std::span<std::byte> coarse, const std::function<void(double)>& progress) {
    withVoxelType(volume.type, [&](auto kind) {
        using T = decltype(kind);
        halveAs(volume, level, range, reinterpret_cast<const T*>(fine.data()),
                reinterpret_cast<T*>(coarse.data()), progress);
    });
}

std::vector<ChannelLevel> buildPyramid(const Volume& volume, const Channel& channel,
                                       const std::function<void(double)>& progress) {
    std::span<const std::byte> voxels = channel.voxels.span();
    std::span<const glm::vec2> bricks = channel.bricks.span();
    std::vector<ChannelLevel> levels;
    const int count = pyramidLevels(volume.size);
    double done = 0.0;
    for (int level = 1; level <= count; ++level) {
        std::vector<std::byte> coarse(product(volume.levelSize(level)) * voxelBytes(volume.type));
        // Each level takes an eighth of the time of the one before.
        const double share = (1.0 - done) * 7.0 / 8.0;
        halve(volume, level, channel.range, voxels, coarse,
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
