#include "renderer/scene/camera.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace volcast::scene {
namespace {

// Squares of coordinates must still fit single precision on the GPU.
constexpr double kLargestCoordinate = 1e18;
constexpr double kParallel = 1e-9;  // Sine of the smallest angle between view and up.
constexpr double kPi = 3.14159265358979323846;
constexpr double kFitShare = 0.94;  // Of the picture's half height that fit() fills.

bool usable(const glm::dvec3& point) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!(std::abs(point[axis]) <= kLargestCoordinate)) return false;  // Also for NaN.
    }
    return true;
}

Error badPoint(const char* field) {
    return fail(ErrorCode::kInvalidArgument,
                std::string{field} + ": a coordinate is not a number of size 1e18 or less", field);
}

}  // namespace

Result<void> validate(const Camera& camera) {
    if (!usable(camera.eye)) return badPoint("camera.eye");
    if (!usable(camera.center)) return badPoint("camera.center");
    if (!usable(camera.up)) return badPoint("camera.up");
    const glm::dvec3 view = camera.center - camera.eye;
    const double distance = glm::length(view), up = glm::length(camera.up);
    if (!(distance > 0.0)) {
        return fail(ErrorCode::kInvalidArgument, "camera.center: is the eye itself",
                    "camera.center");
    }
    if (!(up > 0.0) || glm::length(glm::cross(view / distance, camera.up / up)) < kParallel) {
        return fail(ErrorCode::kInvalidArgument,
                    "camera.up: is zero or parallel to the view direction", "camera.up");
    }
    if (camera.projection == Projection::kPerspective) {
        if (camera.fovyDegrees > 0.0 && camera.fovyDegrees < 180.0) return {};
        return fail(ErrorCode::kInvalidArgument,
                    "camera.fovy_degrees: " + std::to_string(camera.fovyDegrees) +
                        " is not between 0 and 180",
                    "camera.fovy_degrees");
    }
    if (camera.orthographicHeight > 0.0 && camera.orthographicHeight <= kLargestCoordinate) {
        return {};
    }
    return fail(ErrorCode::kInvalidArgument,
                "camera.orthographic_height: " + std::to_string(camera.orthographicHeight) +
                    " is not between 0 and 1e18",
                "camera.orthographic_height");
}

CameraFrame frame(const Camera& camera) {
    const glm::dvec3 forward = glm::normalize(camera.center - camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::normalize(camera.up)));
    return {.right = right, .up = glm::cross(right, forward), .forward = forward};
}

Camera fit(const data::Box& bounds) {
    Camera camera;
    camera.center = 0.5 * (bounds.min + bounds.max);
    camera.eye = camera.center + glm::dvec3(0.45, 0.35, 1.0);
    const CameraFrame axes = frame(camera);
    const double slope = std::tan(0.5 * camera.fovyDegrees * kPi / 180.0) * kFitShare;
    double distance = 0.0, half = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 offset = glm::dvec3((corner & 1) != 0 ? bounds.max.x : bounds.min.x,
                                             (corner & 2) != 0 ? bounds.max.y : bounds.min.y,
                                             (corner & 4) != 0 ? bounds.max.z : bounds.min.z) -
                                  camera.center;
        const double side =
            std::max(std::abs(glm::dot(offset, axes.right)), std::abs(glm::dot(offset, axes.up)));
        distance = std::max(distance, side / slope - glm::dot(offset, axes.forward));
        half = std::max(half, side);
    }
    if (!(half > 0.0)) {
        distance = 1.0;
        half = 0.5;
    }
    // A point far from the coordinates' origin: the eye must still differ from it.
    distance = std::max(distance, glm::length(camera.center) * 1e-9);
    camera.eye = camera.center - distance * axes.forward;
    camera.orthographicHeight = 2.0 * half / kFitShare;
    return camera;
}

Camera orbit(const Camera& camera, double degrees) {
    const glm::dvec3 axis = glm::normalize(camera.up);
    const glm::dvec3 arm = camera.eye - camera.center;
    const double angle = degrees * kPi / 180.0;
    // Rodrigues' rotation formula.
    const glm::dvec3 turned = arm * std::cos(angle) + glm::cross(axis, arm) * std::sin(angle) +
                              axis * glm::dot(axis, arm) * (1.0 - std::cos(angle));
    Camera moved = camera;
    moved.eye = camera.center + turned;
    return moved;
}

}  // namespace volcast::scene
