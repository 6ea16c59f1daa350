#include "renderer/volume/brick_voxels.h"

#include <algorithm>
#include <cstring>

#include "renderer/shading/shared.h"

namespace volcast::volume {

int pooledBrickSide() noexcept {
    return shading::shared::kPoolBrick + 1 + 2 * shading::shared::kBrickBorder;
}

void copyBrick(const data::Volume& volume, const data::Channel& channel, const Brick& brick,
               std::vector<std::byte>& voxels) {
    const int side = pooledBrickSide();
    const std::size_t each = data::voxelBytes(volume.type);
    voxels.resize(static_cast<std::size_t>(side) * side * side * each);
    const std::byte* source =
        (brick.level == 0 ? channel.voxels
                          : channel.coarser[static_cast<std::size_t>(brick.level) - 1].voxels)
            .data();
    const glm::ivec3 size = volume.levelSize(brick.level);
    const glm::ivec3 last = size - 1;
    const glm::ivec3 first =
        shading::shared::kPoolBrick * brick.place - shading::shared::kBrickBorder;
    // Along x: repeated points, those of the volume, repeated points.
    const int begin = std::clamp(first.x, 0, last.x);
    const int end = std::clamp(first.x + side - 1, 0, last.x) + 1;
    const int before = std::min(begin - first.x, side);
    std::byte* target = voxels.data();
    for (int z = 0; z < side; ++z) {
        const int fromZ = std::clamp(first.z + z, 0, last.z);
        for (int y = 0; y < side; ++y) {
            const int fromY = std::clamp(first.y + y, 0, last.y);
            const std::byte* row =
                source + (static_cast<std::size_t>(fromZ) * size.y + fromY) * size.x * each;
            for (int x = 0; x < before; ++x, target += each) {
                std::memcpy(target, row + begin * each, each);
            }
            std::memcpy(target, row + begin * each, (end - begin) * each);
            target += (end - begin) * each;
            for (int x = before + end - begin; x < side; ++x, target += each) {
                std::memcpy(target, row + last.x * each, each);
            }
        }
    }
}

}  // namespace volcast::volume
