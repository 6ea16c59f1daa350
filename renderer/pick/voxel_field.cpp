#include "renderer/pick/voxel_field.h"

#include <array>
#include <cstring>

namespace volcast::pick {

namespace {

template <class T>
double valueAt(const std::byte* voxels, std::size_t i) {
    T value{};
    std::memcpy(&value, voxels + i * sizeof(T), sizeof(T));
    return static_cast<double>(value);
}

/// Weights of the grid points at -1, 0, 1 and 2 for the value at t in [0, 1].
std::array<double, 4> weights(scene::Sampling sampling, double t) {
    if (sampling != scene::Sampling::kTricubic) return {0.0, 1.0 - t, t, 0.0};
    return {0.5 * ((2.0 - t) * t - 1.0) * t, 0.5 * ((3.0 * t - 5.0) * t * t + 2.0),
            0.5 * ((4.0 - 3.0 * t) * t + 1.0) * t, 0.5 * (t - 1.0) * t * t};
}

}  // namespace

double VoxelField::voxel(const glm::ivec3& point) const {
    const glm::ivec3 p = glm::clamp(point, glm::ivec3{0}, volume_->size - 1);
    const auto size = glm::i64vec3{volume_->size};
    const auto i = static_cast<std::size_t>((p.z * size.y + p.y) * size.x + p.x);
    const std::byte* voxels = channel_->voxels.data();
    switch (volume_->type) {
        case data::VoxelType::kU8: return valueAt<std::uint8_t>(voxels, i);
        case data::VoxelType::kU16: return valueAt<std::uint16_t>(voxels, i);
        case data::VoxelType::kI16: return valueAt<std::int16_t>(voxels, i);
        case data::VoxelType::kF32: return valueAt<float>(voxels, i);
    }
    return 0.0;
}

double VoxelField::between(const glm::dvec3& grid) const {
    const glm::ivec3 lastCell = glm::max(volume_->size - 2, glm::ivec3{0});
    const glm::ivec3 low = glm::clamp(glm::ivec3{glm::floor(grid)}, glm::ivec3{0}, lastCell);
    const glm::dvec3 t = glm::clamp(grid - glm::dvec3{low}, 0.0, 1.0);
    const auto x = weights(sampling_, t.x), y = weights(sampling_, t.y),
               z = weights(sampling_, t.z);
    const int begin = sampling_ == scene::Sampling::kTricubic ? 0 : 1;
    double sum = 0.0;
    for (int k = begin; k < 4 - begin; ++k) {
        for (int j = begin; j < 4 - begin; ++j) {
            for (int i = begin; i < 4 - begin; ++i) {
                const auto weight = x[static_cast<std::size_t>(i)] *
                                    y[static_cast<std::size_t>(j)] * z[static_cast<std::size_t>(k)];
                sum += weight * voxel(low + glm::ivec3{i, j, k} - 1);  // NaN, whatever its weight.
            }
        }
    }
    return sum;
}

double VoxelField::at(const glm::dvec3& grid) const {
    if (sampling_ == scene::Sampling::kNearest) return voxel(glm::ivec3{glm::floor(grid + 0.5)});
    return between(grid);
}

}  // namespace volcast::pick
