#include "renderer/volume/raw_channel.h"

#include <algorithm>
#include <vector>

#include "renderer/volume/voxel_floats.h"

namespace volcast::volume {

Result<RawChannel> RawChannel::upload(gpu::Device& device, const data::Volume& volume,
                                      const data::Channel& channel) {
    Result<gpu::Texture3D> texture = gpu::Texture3D::create(
        device, {.size = volume.size, .linear = true, .label = channel.name.c_str()});
    if (!texture) return texture.error();
    // Slices are converted and sent in pieces of about this size.
    constexpr std::size_t kPieceBytes = std::size_t{32} << 20;
    const std::size_t voxelsASlice = static_cast<std::size_t>(volume.size.x) * volume.size.y;
    const std::size_t bytesASlice = voxelsASlice * data::voxelBytes(volume.type);
    const auto slicesAPiece = static_cast<int>(
        std::clamp<std::size_t>(kPieceBytes / (voxelsASlice * sizeof(float)), 1, volume.size.z));
    std::vector<float> floats;
    for (int slice = 0; slice < volume.size.z; slice += slicesAPiece) {
        const int slices = std::min(slicesAPiece, volume.size.z - slice);
        toFloats(volume.type,
                 channel.voxels.span().subspan(slice * bytesASlice, slices * bytesASlice), floats);
        const Result<void> sent = texture->upload(slice, slices, std::as_bytes(std::span{floats}));
        if (!sent) return sent.error();
    }
    RawChannel made;
    made.voxels_ = std::move(*texture);
    return made;
}

}  // namespace volcast::volume
