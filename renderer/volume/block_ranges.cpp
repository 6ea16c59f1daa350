#include "renderer/volume/block_ranges.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

namespace volcast::volume {
namespace {

constexpr glm::vec2 kEmpty{std::numeric_limits<float>::infinity(),
                           -std::numeric_limits<float>::infinity()};

glm::vec2 joined(glm::vec2 a, glm::vec2 b) {
    return {std::min(a.x, b.x), std::max(a.y, b.y)};
}

/// What counts for one place along an axis: first and last.
struct Window {
    int first = 0;
    int last = 0;
};

/// The points that count for block `block` of an axis of `points`.
Window window(int block, int around, int points) {
    return {.first = std::max(block * kRangeBlock - around, 0),
            .last = std::min((block + 1) * kRangeBlock + around, points - 1)};
}

/// Joins along x: rows of values become rows of blocks.
template <class T>
std::vector<glm::vec2> alongX(glm::ivec3 size, int blocks, int around,
                              std::span<const std::byte> voxels) {
    const std::size_t rows = static_cast<std::size_t>(size.y) * size.z;
    std::vector<glm::vec2> ranges(rows * blocks);
    std::vector<T> row(size.x);
    for (std::size_t i = 0; i < rows; ++i) {
        std::memcpy(row.data(), voxels.data() + i * size.x * sizeof(T), size.x * sizeof(T));
        for (int block = 0; block < blocks; ++block) {
            const Window counted = window(block, around, size.x);
            glm::vec2 range = kEmpty;
            for (int x = counted.first; x <= counted.last; ++x) {
                // Comparisons with NaN are false.
                const auto value = static_cast<float>(row[x]);
                range.x = value < range.x ? value : range.x;
                range.y = value > range.y ? value : range.y;
            }
            ranges[i * blocks + block] = range;
        }
    }
    return ranges;
}

/// Joins slabs of `stride` ranges each, `places` a row of them: each row becomes `made` slabs, slab
/// i of what windowOf(i) says.
template <class WindowOf>
std::vector<glm::vec2> along(std::span<const glm::vec2> ranges, std::size_t stride, int places,
                             int made, WindowOf windowOf) {
    const std::size_t repeats = ranges.size() / (stride * places);
    std::vector<glm::vec2> joinedRanges(repeats * made * stride, kEmpty);
    for (std::size_t i = 0; i < repeats; ++i) {
        for (int slab = 0; slab < made; ++slab) {
            glm::vec2* to = &joinedRanges[(i * made + slab) * stride];
            const Window counted = windowOf(slab);
            for (int place = counted.first; place <= counted.last; ++place) {
                const glm::vec2* from = &ranges[(i * places + place) * stride];
                for (std::size_t j = 0; j < stride; ++j) to[j] = joined(to[j], from[j]);
            }
        }
    }
    return joinedRanges;
}

}  // namespace

glm::ivec3 blockGrid(glm::ivec3 points) {
    return (points - 1) / kRangeBlock + 1;
}

std::vector<glm::vec2> blockRanges(const data::Volume& volume, const data::Channel& channel,
                                   int around) {
    const glm::ivec3 size = volume.size;
    const glm::ivec3 grid = blockGrid(size);
    const auto rows = [&] {
        switch (volume.type) {
            case data::VoxelType::kU8:
                return alongX<std::uint8_t>(size, grid.x, around, channel.voxels.span());
            case data::VoxelType::kU16:
                return alongX<std::uint16_t>(size, grid.x, around, channel.voxels.span());
            case data::VoxelType::kI16:
                return alongX<std::int16_t>(size, grid.x, around, channel.voxels.span());
            case data::VoxelType::kF32: break;
        }
        return alongX<float>(size, grid.x, around, channel.voxels.span());
    }();
    const auto windowOf = [around](int points) {
        return [around, points](int block) { return window(block, around, points); };
    };
    const auto planes = along(rows, grid.x, size.y, grid.y, windowOf(size.y));
    return along(planes, static_cast<std::size_t>(grid.x) * grid.y, size.z, grid.z,
                 windowOf(size.z));
}

std::vector<glm::vec2> joinedAround(std::span<const glm::vec2> ranges, glm::ivec3 grid) {
    std::vector<glm::vec2> found(ranges.begin(), ranges.end());
    std::size_t stride = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const int last = grid[axis] - 1;
        found = along(found, stride, grid[axis], grid[axis], [last](int block) {
            return Window{.first = std::max(block - 1, 0), .last = std::min(block + 1, last)};
        });
        stride *= static_cast<std::size_t>(grid[axis]);
    }
    return found;
}

}  // namespace volcast::volume
