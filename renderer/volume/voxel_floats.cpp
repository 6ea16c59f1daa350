#include "renderer/volume/voxel_floats.h"

#include <cstdint>
#include <cstring>

namespace volcast::volume {
namespace {

template <class T>
void convert(std::span<const std::byte> voxels, std::vector<float>& floats) {
    floats.resize(voxels.size() / sizeof(T));
    for (std::size_t i = 0; i < floats.size(); ++i) {
        T value;
        std::memcpy(&value, voxels.data() + i * sizeof(T), sizeof(T));
        floats[i] = static_cast<float>(value);
    }
}

}  // namespace

void toFloats(data::VoxelType type, std::span<const std::byte> voxels, std::vector<float>& floats) {
    switch (type) {
        case data::VoxelType::kU8: return convert<std::uint8_t>(voxels, floats);
        case data::VoxelType::kU16: return convert<std::uint16_t>(voxels, floats);
        case data::VoxelType::kI16: return convert<std::int16_t>(voxels, floats);
        case data::VoxelType::kF32: return convert<float>(voxels, floats);
    }
}

}  // namespace volcast::volume
