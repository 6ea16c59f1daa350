#include "renderer/volume/brick_voxels.h"

#include <cstring>

#include <gtest/gtest.h>

#include "renderer/data/volume_builder.h"
#include "renderer/shading/shared.h"

namespace volcast::volume {
namespace {

/// Of u16 voxels x + 131 y + 7 z.
data::Volume ramp(glm::ivec3 size) {
    data::VolumeInput input{.size = size, .type = data::VoxelType::kU16};
    std::vector<std::byte> voxels(static_cast<std::size_t>(size.x) * size.y * size.z * 2);
    std::size_t i = 0;
    for (int z = 0; z < size.z; ++z) {
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x, i += 2) {
                const auto value = static_cast<std::uint16_t>(x + 131 * y + 7 * z);
                std::memcpy(&voxels[i], &value, sizeof value);
            }
        }
    }
    input.channels.push_back({.name = "c", .voxels = std::move(voxels)});
    return data::buildVolume(std::move(input)).value();
}

// Level 1 of 150 grid points: 76, of which the last lies at 149, not at 150.
TEST(BrickVoxels, AreThoseOfTheLevelAndRepeatedBeyondTheVolume) {
    const data::Volume volume = ramp({150, 149, 96});
    const int side = pooledBrickSide();
    std::vector<std::byte> bytes;
    for (const Brick brick : {Brick{0, {0, 0, 0}}, Brick{0, {4, 4, 2}}, Brick{1, {2, 1, 1}},
                              Brick{3, {0, 0, 0}}, Brick{0, {1, 2, 1}}}) {
        copyBrick(volume, volume.channels[0], brick, bytes);
        ASSERT_EQ(bytes.size(), static_cast<std::size_t>(side) * side * side * 2);
        std::size_t i = 0;
        for (int z = 0; z < side; ++z) {
            for (int y = 0; y < side; ++y) {
                for (int x = 0; x < side; ++x, i += 2) {
                    const glm::ivec3 point =
                        glm::clamp(shading::shared::kPoolBrick * brick.place + glm::ivec3(x, y, z) -
                                       shading::shared::kBrickBorder,
                                   glm::ivec3(0), volume.levelSize(brick.level) - 1);
                    const glm::ivec3 at = glm::min(point << brick.level, volume.size - 1);
                    std::uint16_t value = 0;
                    std::memcpy(&value, &bytes[i], sizeof value);
                    ASSERT_EQ(value, at.x + 131 * at.y + 7 * at.z)
                        << brick.level << ": " << x << " " << y << " " << z;
                }
            }
        }
    }
}

TEST(BrickVoxels, ThinVolumesFillABrick) {
    const data::Volume volume = ramp({1500, 1400, 1});
    std::vector<std::byte> bytes;
    copyBrick(volume, volume.channels[0], {.level = 0, .place = {0, 0, 0}}, bytes);
    const auto side = static_cast<std::size_t>(pooledBrickSide());
    for (std::size_t z = 1; z < side; ++z) {
        EXPECT_EQ(std::memcmp(bytes.data(), bytes.data() + 2 * z * side * side, 2 * side * side),
                  0);
    }
}

}  // namespace
}  // namespace volcast::volume
