#pragma once

#include <array>

#include <glm/glm.hpp>

#include "renderer/data/volume.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/scene.h"

namespace volcast::scene {

/// Pixels of a picture, row 0 at its top.
struct PixelBox {
    glm::ivec2 low{0};
    glm::ivec2 size{0};
    friend bool operator==(const PixelBox&, const PixelBox&) = default;
};

/// A rectangle of the picture that holds every pixel whose ray meets `box`: its lowest and its
/// highest corner in grid coordinates of `volume`. Empty where it is beside the picture, or the
/// first corner is above the second; all of the picture where a corner is not in front of the eye.
PixelBox coverOf(const Camera& camera, PictureSize size, const data::Volume& volume,
                 const std::array<glm::vec3, 2>& box);

}  // namespace volcast::scene
