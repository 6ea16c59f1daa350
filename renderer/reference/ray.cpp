#include "renderer/reference/ray.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace volcast::reference {

Lens::Lens(const scene::Camera& camera, scene::PictureSize size)
    : eye_{camera.eye},
      half_{0.5 * size.x, 0.5 * size.y},
      perspective_{camera.projection == scene::Projection::kPerspective} {
    forward_ = glm::normalize(camera.center - camera.eye);
    // Gram-Schmidt: what is left of `up` without its part along the view.
    const glm::dvec3 up = glm::normalize(camera.up);
    up_ = glm::normalize(up - glm::dot(up, forward_) * forward_);
    right_ = glm::cross(forward_, up_);
    const double halfHeight = perspective_ ? std::tan(camera.fovyDegrees * std::numbers::pi / 360.0)
                                           : 0.5 * camera.orthographicHeight;
    perPixel_ = halfHeight / half_.y;
}

glm::dvec3 Lens::onPlane(const glm::dvec2& place) const {
    return {(place.x - half_.x) * perPixel_, (half_.y - place.y) * perPixel_, 1.0};
}

Ray Lens::through(const glm::dvec2& place) const {
    const glm::dvec3 at = onPlane(place);
    const glm::dvec3 aside = at.x * right_ + at.y * up_;
    if (!perspective_) return {.origin = eye_ + aside, .direction = forward_};
    return {.origin = eye_, .direction = glm::normalize(forward_ + aside)};
}

double Lens::pixelsToLine(const glm::dvec2& place, const glm::dvec3& a, const glm::dvec3& b) const {
    // Homogeneous points of the picture plane, so that points behind the eye need no care.
    const auto seen = [&](const glm::dvec3& point) {
        const glm::dvec3 from = point - eye_;
        return glm::dvec3{glm::dot(from, right_), glm::dot(from, up_),
                          perspective_ ? glm::dot(from, forward_) : 1.0};
    };
    const glm::dvec3 line = glm::cross(seen(a), seen(b));
    const double length = std::hypot(line.x, line.y);
    if (!(length > 0.0)) return std::numeric_limits<double>::infinity();
    return std::abs(glm::dot(line, onPlane(place))) / length / perPixel_;
}

Span keptBy(std::span<const scene::ClipPlane> planes, const Ray& ray) {
    Span kept;
    for (const scene::ClipPlane& plane : planes) {
        const double inside = glm::dot(plane.normal, ray.origin) - plane.offset;
        const double rate = glm::dot(plane.normal, ray.direction);
        if (rate > 0.0) kept.begin = std::max(kept.begin, -inside / rate);
        if (rate < 0.0) kept.end = std::min(kept.end, -inside / rate);
        if (rate == 0.0 && inside < 0.0) kept.end = 0.0;
    }
    return kept;
}

}  // namespace volcast::reference
