#pragma once

#include <glm/glm.hpp>

#include "renderer/base/result.h"
#include "renderer/data/dataset.h"

namespace volcast::scene {

enum class Projection { kPerspective, kOrthographic };

/// Where the picture is taken from; world space, right-handed, looking from `eye` to `center`.
struct Camera {
    glm::dvec3 eye{0.0, 0.0, 3.0};
    glm::dvec3 center{0.0};
    glm::dvec3 up{0.0, 1.0, 0.0};  ///< Need not be perpendicular to the view direction.
    Projection projection = Projection::kPerspective;
    double fovyDegrees = 30.0;      ///< Vertical field of view, perspective only.
    double orthographicHeight = 2;  ///< Height of the picture in world units, orthographic only.
    friend bool operator==(const Camera&, const Camera&) = default;
};

/// Orthonormal axes of the camera: x right, y up, z towards the scene (left-handed on purpose:
/// depth grows away from the eye).
struct CameraFrame {
    glm::dvec3 right, up, forward;
};

/// Errors (checked before any use): kInvalidArgument for a component that is not finite, eye ==
/// center, up parallel to the view, a field of view outside (0, 180), a height that is not > 0.
Result<void> validate(const Camera& camera);

/// `camera` must be valid.
CameraFrame frame(const Camera& camera);

/// A camera that shows all of `bounds`, from slightly above and to the right.
Camera fit(const data::Box& bounds);

/// `camera` with its eye turned by `degrees` about `up` through `center` (right-hand rule).
Camera orbit(const Camera& camera, double degrees);

}  // namespace volcast::scene
