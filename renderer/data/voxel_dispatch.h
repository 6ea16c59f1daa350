#pragma once

#include <cstdint>

#include "renderer/data/volume.h"

namespace volcast::data {

/// Calls `work(T{})` with a value of the C++ type that voxels of `type` have; undefined types call
/// nothing.
template <class Work>
void withVoxelType(VoxelType type, const Work& work) {
    switch (type) {
        case VoxelType::kU8: return work(std::uint8_t{});
        case VoxelType::kU16: return work(std::uint16_t{});
        case VoxelType::kI16: return work(std::int16_t{});
        case VoxelType::kF32: return work(float{});
    }
}

}  // namespace volcast::data
