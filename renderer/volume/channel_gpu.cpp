#include <algorithm>

#include "renderer/shading/shared.h"
#include "renderer/volume/march.h"
#include "renderer/volume/voxel_floats.h"

namespace volcast::volume {
namespace {

// Slices are converted and sent in pieces of about this size.
constexpr std::size_t kPieceBytes = std::size_t{32} << 20;

Result<gpu::Texture3D> uploadVoxels(gpu::Device& device, const data::Volume& volume,
                                    const data::Channel& channel) {
    Result<gpu::Texture3D> texture = gpu::Texture3D::create(
        device, {.size = volume.size, .linear = true, .label = channel.name.c_str()});
    if (!texture) return texture.error();
    const std::size_t voxelsASlice = static_cast<std::size_t>(volume.size.x) * volume.size.y;
    const auto slicesAPiece = static_cast<int>(
        std::clamp<std::size_t>(kPieceBytes / (voxelsASlice * sizeof(float)), 1, volume.size.z));
    std::vector<float> floats;
    for (int slice = 0; slice < volume.size.z; slice += slicesAPiece) {
        const int slices = std::min(slicesAPiece, volume.size.z - slice);
        const std::size_t bytesASlice = voxelsASlice * data::voxelBytes(volume.type);
        const auto part = channel.voxels.span().subspan(slice * bytesASlice, slices * bytesASlice);
        std::span<const std::byte> sent = part;
        if (volume.type != data::VoxelType::kF32) {
            toFloats(volume.type, part, floats);
            sent = std::as_bytes(std::span{floats});
        }
        const Result<void> uploaded = texture->upload(slice, slices, sent);
        if (!uploaded) return uploaded.error();
    }
    return texture;
}

}  // namespace

Result<ChannelGpu> ChannelGpu::upload(gpu::Device& device, const data::Volume& volume,
                                      const data::Channel& channel) {
    ChannelGpu made;
    Result<gpu::Texture3D> voxels = uploadVoxels(device, volume, channel);
    if (!voxels) return voxels.error();
    made.voxels_ = std::move(*voxels);
    const glm::ivec3 grid = volume.brickGrid();
    Result<gpu::Texture3D> bricks = gpu::Texture3D::create(
        device, {.size = grid, .format = gpu::VoxelFormat::kRg32F, .label = "brick ranges"});
    if (!bricks) return bricks.error();
    made.bricks_ = std::move(*bricks);
    const Result<void> uploaded = made.bricks_.upload(0, grid.z, channel.bricks.bytes());
    if (!uploaded) return uploaded.error();
    return made;
}

void ChannelGpu::bind() const noexcept {
    voxels_.bind(shading::shared::kVoxelUnit);
    bricks_.bind(shading::shared::kBrickUnit);
}

}  // namespace volcast::volume
