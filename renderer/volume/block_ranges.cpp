#include "renderer/volume/block_ranges.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>

namespace volcast::volume {
namespace {

constexpr glm::vec2 kEmpty{std::numeric_limits<float>::infinity(),
                           -std::numeric_limits<float>::infinity()};

glm::vec2 joined(glm::vec2 a, glm::vec2 b) {
    return {std::min(a.x, b.x), std::max(a.y, b.y)};
}

/// The points that count for block `block` of an axis of `points`: first and last.
glm::ivec2 window(int block, int points) {
    constexpr int kMore = kRangeReach + 1;
    return {std::max(block * kRangeBlock - kMore, 0),
            std::min((block + 1) * kRangeBlock + kMore, points - 1)};
}

/// Joins along x: rows of values become rows of blocks.
template <class T>
std::vector<glm::vec2> alongX(glm::ivec3 size, int blocks, std::span<const std::byte> voxels) {
    const std::size_t rows = static_cast<std::size_t>(size.y) * size.z;
    std::vector<glm::vec2> ranges(rows * blocks);
    std::vector<T> row(size.x);
    for (std::size_t i = 0; i < rows; ++i) {
        std::memcpy(row.data(), voxels.data() + i * size.x * sizeof(T), size.x * sizeof(T));
        for (int block = 0; block < blocks; ++block) {
            const glm::ivec2 points = window(block, size.x);
            glm::vec2 range = kEmpty;
            for (int point = points.x; point <= points.y; ++point) {
                const auto value = static_cast<float>(row[point]);
                range = {std::min(range.x, value), std::max(range.y, value)};  // Not of NaN.
            }
            ranges[i * blocks + block] = range;
        }
    }
    return ranges;
}

/// Joins `points` slabs of `stride` ranges each, `repeats` times over, into blocks.
std::vector<glm::vec2> along(std::span<const glm::vec2> ranges, std::size_t stride, int points,
                             int blocks) {
    const std::size_t repeats = ranges.size() / (stride * points);
    std::vector<glm::vec2> joinedRanges(repeats * blocks * stride, kEmpty);
    for (std::size_t i = 0; i < repeats; ++i) {
        for (int block = 0; block < blocks; ++block) {
            glm::vec2* to = &joinedRanges[(i * blocks + block) * stride];
            const glm::ivec2 counted = window(block, points);
            for (int point = counted.x; point <= counted.y; ++point) {
                const glm::vec2* from = &ranges[(i * points + point) * stride];
                for (std::size_t j = 0; j < stride; ++j) to[j] = joined(to[j], from[j]);
            }
        }
    }
    return joinedRanges;
}

}  // namespace

std::vector<glm::vec2> blockRanges(const data::Volume& volume, const data::Channel& channel) {
    const glm::ivec3 size = volume.size;
    const glm::ivec3 grid = (size - 1) / kRangeBlock + 1;
    const auto rows = [&] {
        switch (volume.type) {
            case data::VoxelType::kU8:
                return alongX<std::uint8_t>(size, grid.x, channel.voxels.span());
            case data::VoxelType::kU16:
                return alongX<std::uint16_t>(size, grid.x, channel.voxels.span());
            case data::VoxelType::kI16:
                return alongX<std::int16_t>(size, grid.x, channel.voxels.span());
            case data::VoxelType::kF32: break;
        }
        return alongX<float>(size, grid.x, channel.voxels.span());
    }();
    const auto planes = along(rows, grid.x, size.y, grid.y);
    return along(planes, static_cast<std::size_t>(grid.x) * grid.y, size.z, grid.z);
}

}  // namespace volcast::volume
