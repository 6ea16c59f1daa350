#pragma once

#include <glm/glm.hpp>

#include "renderer/data/volume.h"
#include "renderer/scene/scene.h"

namespace volcast::pick {

/// One channel of a volume between its grid points, in double; as shaders/volume/voxels.glsl has
/// it.
class VoxelField {
public:
    /// Keeps references.
    VoxelField(const data::Volume& volume, const data::Channel& channel, scene::Sampling sampling)
        : volume_{&volume}, channel_{&channel}, sampling_{sampling} {}

    /// The value at grid coordinates within the box; NaN where a voxel that counts has none.
    [[nodiscard]] double at(const glm::dvec3& grid) const;
    [[nodiscard]] const data::Channel& channel() const noexcept { return *channel_; }

private:
    [[nodiscard]] double voxel(const glm::ivec3& point) const;
    [[nodiscard]] double between(const glm::dvec3& grid) const;

    const data::Volume* volume_;
    const data::Channel* channel_;
    scene::Sampling sampling_;
};

}  // namespace volcast::pick
