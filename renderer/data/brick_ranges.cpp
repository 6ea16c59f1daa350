#include "renderer/data/brick_ranges.h"

#include <algorithm>
#include <limits>

#include "renderer/data/voxel_dispatch.h"

namespace volcast::data {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

template <class T>
constexpr T kHighest = std::numeric_limits<T>::has_infinity ? std::numeric_limits<T>::infinity()
                                                            : std::numeric_limits<T>::max();
template <class T>
constexpr T kLowest = std::numeric_limits<T>::has_infinity ? -std::numeric_limits<T>::infinity()
                                                           : std::numeric_limits<T>::lowest();

/// The same as a loop over bricks, but in the order of the voxels: each slice is read once.
template <class T>
void findRanges(const T* voxels, glm::ivec3 size, glm::ivec3 grid, std::vector<glm::vec2>& ranges) {
    for (int z = 0; z < size.z; ++z) {
        // A point on the face between two bricks belongs to both.
        const auto firstOf = [](int point) { return std::max(point - 1, 0) / Volume::kBrickSize; };
        const int lastZ = std::min(z / Volume::kBrickSize, grid.z - 1);
        for (int y = 0; y < size.y; ++y) {
            const int lastY = std::min(y / Volume::kBrickSize, grid.y - 1);
            const T* row = voxels + (static_cast<std::size_t>(z) * size.y + y) * size.x;
            for (int bx = 0; bx < grid.x; ++bx) {
                const int first = bx * Volume::kBrickSize;
                const int last = std::min(first + Volume::kBrickSize, size.x - 1);
                T low = kHighest<T>;
                T high = kLowest<T>;
                for (int x = first; x <= last; ++x) {
                    low = std::min(low, row[x]);  // In this order NaN is passed over.
                    high = std::max(high, row[x]);
                }
                if (low > high) continue;
                for (int bz = firstOf(z); bz <= lastZ; ++bz) {
                    for (int by = firstOf(y); by <= lastY; ++by) {
                        glm::vec2& range =
                            ranges[(static_cast<std::size_t>(bz) * grid.y + by) * grid.x + bx];
                        range.x = std::min(range.x, static_cast<float>(low));
                        range.y = std::max(range.y, static_cast<float>(high));
                    }
                }
            }
        }
    }
}

}  // namespace

std::vector<glm::vec2> brickRanges(const Volume& volume, int level,
                                   std::span<const std::byte> voxels) {
    const glm::ivec3 grid = volume.brickGrid(level);
    std::vector<glm::vec2> ranges(static_cast<std::size_t>(grid.x) * grid.y * grid.z,
                                  glm::vec2{kInfinity, -kInfinity});
    withVoxelType(volume.type, [&](auto kind) {
        // Voxels are aligned for their type: they start a vector or a section of a packed dataset.
        findRanges(reinterpret_cast<const decltype(kind)*>(voxels.data()), volume.levelSize(level),
                   grid, ranges);
    });
    return ranges;
}

void includeFiner(const Volume& volume, int level, std::span<const glm::vec2> finer,
                  std::span<glm::vec2> ranges) {
    const glm::ivec3 grid = volume.brickGrid(level);
    const glm::ivec3 fineGrid = volume.brickGrid(level - 1);
    for (int z = 0; z < fineGrid.z; ++z) {
        for (int y = 0; y < fineGrid.y; ++y) {
            for (int x = 0; x < fineGrid.x; ++x) {
                const glm::vec2 beneath =
                    finer[(static_cast<std::size_t>(z) * fineGrid.y + y) * fineGrid.x + x];
                glm::vec2& range =
                    ranges[(static_cast<std::size_t>(z / 2) * grid.y + y / 2) * grid.x + x / 2];
                range = {std::min(range.x, beneath.x), std::max(range.y, beneath.y)};
            }
        }
    }
}

}  // namespace volcast::data
