#include <algorithm>

#include "renderer/scene/scale.h"
#include "renderer/shading/shared.h"
#include "renderer/volume/march.h"
#include "renderer/volume/voxel_floats.h"

namespace volcast::volume {
namespace {

// Slices are converted and sent in pieces of about this size.
constexpr std::size_t kPieceBytes = std::size_t{32} << 20;

Result<gpu::Texture3D> uploadVoxels(gpu::Device& device, const data::Volume& volume,
                                    const data::Channel& channel,
                                    const scene::ScaleFunction& scale) {
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
        if (volume.type != data::VoxelType::kF32 || !scale.identity()) {
            toFloats(volume.type, part, floats);
            if (!scale.identity()) {
                for (float& value : floats) value = scale.ofData(value);
            }
            sent = std::as_bytes(std::span{floats});
        }
        const Result<void> uploaded = texture->upload(slice, slices, sent);
        if (!uploaded) return uploaded.error();
    }
    return texture;
}

Result<gpu::Buffer> uploadBlocks(gpu::Device& device, const data::Volume& volume,
                                 const data::Channel& channel, VoxelTexels texels) {
    const BlockLayout layout{volume.size};
    Result<gpu::Buffer> buffer =
        gpu::Buffer::create(device, {.bytes = layout.texels() * sizeof(std::uint32_t),
                                     .updatable = true,
                                     .texels = gpu::TexelFormat::kR32U,
                                     .label = channel.name.c_str()});
    if (!buffer) return buffer;
    std::vector<std::uint32_t> packed;
    for (int layer = 0; layer < layout.blocks.z; ++layer) {
        packLayer(layout, texels, channel.voxels.span(), layer, packed);
        const auto bytes = std::as_bytes(std::span{packed});
        buffer->update(layer * bytes.size(), bytes);
    }
    return buffer;
}

}  // namespace

Result<ChannelGpu> ChannelGpu::upload(gpu::Device& device, const data::Volume& volume,
                                      const data::Channel& channel) {
    ChannelGpu made;
    // As maps, intervals and levels are: relative to the range where that lies far from 0.
    const scene::ScaleFunction scale{scene::Scale{}, channel.range};
    const auto limit = static_cast<std::size_t>(device.limits().texelBufferTexels);
    if (scale.identity() && BlockLayout{volume.size}.texels() <= limit) {
        made.texels_ = texelsFor(volume.type);
    }
    if (made.texels_ != VoxelTexels::kTexture) {
        Result<gpu::Buffer> blocks = uploadBlocks(device, volume, channel, made.texels_);
        if (!blocks) return blocks.error();
        made.blocks_ = std::move(*blocks);
    } else {
        Result<gpu::Texture3D> voxels = uploadVoxels(device, volume, channel, scale);
        if (!voxels) return voxels.error();
        made.voxels_ = std::move(*voxels);
    }
    return made;
}

void ChannelGpu::bind() const noexcept {
    if (texels_ == VoxelTexels::kTexture) {
        voxels_.bind(shading::shared::kVoxelUnit);
    } else {
        blocks_.bindTexels(shading::shared::kVoxelUnit);
    }
}

}  // namespace volcast::volume
