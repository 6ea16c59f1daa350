#pragma once

#include <limits>
#include <span>

#include <glm/glm.hpp>

#include "renderer/scene/scene.h"

namespace volcast::reference {

struct Ray {
    glm::dvec3 origin{0.0};         ///< World; the eye, or a point of the plane through it.
    glm::dvec3 direction{0, 0, 1};  ///< Of length 1.
};

/// Distances from a ray's origin, world units; empty where begin >= end.
struct Span {
    double begin = 0.0;
    double end = std::numeric_limits<double>::infinity();
};

/// From places in a picture to rays and back.
class Lens {
public:
    /// `camera` and `size` must be valid.
    Lens(const scene::Camera& camera, scene::PictureSize size);

    /// The ray through `place`, in pixels from the upper left corner (centres at .5).
    [[nodiscard]] Ray through(const glm::dvec2& place) const;

    /// Distance in pixels from `place` to the line through the pictures of points a and b (world),
    /// wherever these lie; infinity where the line is seen end on.
    [[nodiscard]] double pixelsToLine(const glm::dvec2& place, const glm::dvec3& a,
                                      const glm::dvec3& b) const;

    /// World size of a pixel at a distance.
    [[nodiscard]] double pixelSize(double distance) const {
        return perspective_ ? perPixel_ * distance : perPixel_;
    }

private:
    /// Right, up and 1 (perspective: towards the scene) of a place, in units of the picture plane.
    [[nodiscard]] glm::dvec3 onPlane(const glm::dvec2& place) const;

    glm::dvec3 eye_, right_, up_, forward_;
    glm::dvec2 half_;  ///< Half of the picture, pixels.
    double perPixel_;  ///< Picture plane units a pixel.
    bool perspective_;
};

/// The part of `ray` that all of `planes` keep.
Span keptBy(std::span<const scene::ClipPlane> planes, const Ray& ray);

}  // namespace volcast::reference
