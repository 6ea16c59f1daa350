#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/data/transfer_function.h"
#include "renderer/data/volume.h"
#include "renderer/scene/scene.h"

/// The normative integrals of a voxel volume in double precision, written apart from the shaders.
namespace volcast::support {

struct ReferenceRay {
    glm::dvec3 eye{0.0};        ///< World.
    glm::dvec3 direction{0.0};  ///< World, length 1.
};

/// The ray through the centre of pixel (x, y), row 0 on top.
inline ReferenceRay referenceRay(const scene::Camera& camera, glm::ivec2 size, int x, int y) {
    const glm::dvec3 w = glm::normalize(camera.center - camera.eye);
    const glm::dvec3 u = glm::normalize(glm::cross(w, camera.up));
    const glm::dvec3 v = glm::cross(u, w);
    const double right = (2.0 * (x + 0.5) / size.x - 1.0) * size.x / size.y;
    const double up = 1.0 - 2.0 * (y + 0.5) / size.y;
    if (camera.projection == scene::Projection::kOrthographic) {
        const double half = camera.orthographicHeight / 2.0;
        return {.eye = camera.eye + half * (right * u + up * v), .direction = w};
    }
    const double slope = std::tan(camera.fovyDegrees * 3.14159265358979323846 / 360.0);
    return {.eye = camera.eye, .direction = glm::normalize(w + slope * (right * u + up * v))};
}

/// A volume of float32 voxels as a function of the place.
class VolumeReference {
public:
    VolumeReference(const data::Volume& volume, scene::Sampling sampling)
        : volume_{volume}, sampling_{sampling}, values_(volume.channels[0].voxels.size() / 4) {
        std::memcpy(values_.data(), volume.channels[0].voxels.data(), values_.size() * 4);
    }

    /// Distances along `ray` at which it enters and leaves the volume, not behind the eye;
    /// x > y: never.
    [[nodiscard]] glm::dvec2 span(const ReferenceRay& ray) const {
        const glm::dvec3 o = gridFrom(ray.eye);
        const glm::dvec3 d = gridFrom(ray.eye + ray.direction) - o;
        glm::dvec2 inside{0.0, 1e300};
        for (int axis = 0; axis < 3; ++axis) {
            const double high = volume_.size[axis] - 1;
            if (d[axis] == 0.0) {
                if (o[axis] < 0.0 || o[axis] > high) return {1.0, 0.0};
                continue;
            }
            const double a = -o[axis] / d[axis], b = (high - o[axis]) / d[axis];
            inside = {std::max(inside.x, std::min(a, b)), std::min(inside.y, std::max(a, b))};
        }
        return inside;
    }

    [[nodiscard]] double valueAt(const glm::dvec3& world) const {
        const glm::dvec3 last = glm::dvec3(volume_.size) - 1.0;
        const glm::dvec3 at = glm::clamp(gridFrom(world), glm::dvec3(0.0), last);
        if (sampling_ == scene::Sampling::kNearest) return voxel(glm::ivec3(at + 0.5));
        if (sampling_ == scene::Sampling::kTricubic) return tricubic(at);
        const glm::ivec3 low = glm::min(glm::ivec3(at), glm::max(volume_.size - 2, 0));
        const glm::dvec3 t = at - glm::dvec3(low);
        double sum = 0.0;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::ivec3 step{corner & 1, corner >> 1 & 1, corner >> 2};
            const glm::dvec3 share = glm::mix(1.0 - t, t, glm::dvec3(step));
            sum += share.x * share.y * share.z * voxel(glm::min(low + step, volume_.size - 1));
        }
        return sum;
    }

    /// How fast the field rises, a world unit: by differences over a grid interval to each side
    /// within the box.
    [[nodiscard]] glm::dvec3 slopeAt(const glm::dvec3& world) const {
        glm::dvec3 slope{0.0};
        for (int axis = 0; axis < 3; ++axis) {
            const glm::dvec3 way = volume_.direction[axis] * volume_.spacing[axis];
            const double at = gridFrom(world)[axis];
            const double back = std::min(at, 1.0);
            const double ahead = std::min(volume_.size[axis] - 1 - at, 1.0);
            const double rise = valueAt(world + ahead * way) - valueAt(world - back * way);
            slope += rise / std::max(back + ahead, 0.5) / volume_.spacing[axis] *
                     volume_.direction[axis];
        }
        return slope;
    }

    /// The direction in which it rises most, of length 1, or 0.
    [[nodiscard]] glm::dvec3 normalAt(const glm::dvec3& world) const {
        const glm::dvec3 slope = slopeAt(world);
        const double size = glm::length(slope);
        return size > 0.0 ? slope / size : glm::dvec3{0.0};
    }

    /// The least and the largest value within `off` grid units of a place, along each axis, as far
    /// as its corners tell.
    [[nodiscard]] glm::dvec2 valuesNear(const glm::dvec3& world, double off) const {
        glm::dvec2 found{1e300, -1e300};
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 way{(corner & 1) != 0 ? off : -off, (corner & 2) != 0 ? off : -off,
                                 (corner & 4) != 0 ? off : -off};
            const double value = valueAt(world + volume_.direction * (volume_.spacing * way));
            found = {std::min(found.x, value), std::max(found.y, value)};
        }
        return found;
    }

    /// What `light` makes of the colour of matter at a place, seen along `direction`.
    [[nodiscard]] glm::dvec3 lit(const glm::dvec3& colour, const scene::Light& light,
                                 const glm::dvec3& world, const glm::dvec3& direction) const {
        const glm::dvec3 normal = normalAt(world);
        const glm::dvec3 towards =
            light.position ? glm::normalize(*light.position - world) : -direction;
        const glm::dvec3 half = glm::normalize(towards - direction);
        const double facing = normal == glm::dvec3{0.0} ? 1.0 : std::abs(glm::dot(normal, towards));
        return colour * (light.ambient + light.diffuse * facing) +
               light.specular * std::pow(std::abs(glm::dot(normal, half)), light.exponent);
    }

    /// The values in the middle of `samples` equal steps; none where the ray misses the volume.
    [[nodiscard]] std::vector<double> valuesOn(const ReferenceRay& ray, int samples) const {
        const glm::dvec2 inside = span(ray);
        std::vector<double> values;
        for (int i = 0; inside.x <= inside.y && i < samples; ++i) {
            const double s = inside.x + (inside.y - inside.x) * (i + 0.5) / samples;
            values.push_back(valueAt(ray.eye + s * ray.direction));
        }
        return values;
    }

    /// Linear colour and extinction of `value`.
    [[nodiscard]] static glm::dvec4 matterOf(double value, const data::TransferFunction& map) {
        const auto& points = map.points;
        std::size_t above = 0;
        while (above < points.size() && value >= points[above].value) ++above;
        const auto matter = [&](std::size_t i) {
            return glm::dvec4(glm::dvec3(points[i].colour), points[i].extinction);
        };
        if (above == 0) return matter(0);
        if (above == points.size()) return matter(above - 1);
        const double low = points[above - 1].value, high = points[above].value;
        return glm::mix(matter(above - 1), matter(above), (value - low) / (high - low));
    }

    /// Emission and absorption by `samples` midpoints: premultiplied linear colour and opacity.
    [[nodiscard]] glm::dvec4 composite(const ReferenceRay& ray, const data::TransferFunction& map,
                                       int samples) const {
        const glm::dvec2 inside = span(ray);
        if (inside.x > inside.y) return glm::dvec4(0.0);
        const double dt = (inside.y - inside.x) / samples;
        glm::dvec3 colour{0.0};
        double depth = 0.0;
        for (int i = 0; i < samples; ++i) {
            const glm::dvec3 at = ray.eye + (inside.x + (i + 0.5) * dt) * ray.direction;
            const glm::dvec4 matter = matterOf(valueAt(at), map);
            colour += glm::dvec3(matter) * (std::exp(-depth) * -std::expm1(-matter.a * dt));
            depth += matter.a * dt;
        }
        return {colour, -std::expm1(-depth)};
    }

    /// The largest of `samples` values at midpoints; `met` tells whether the ray met the volume.
    [[nodiscard]] double largest(const ReferenceRay& ray, int samples, bool& met) const {
        const std::vector<double> values = valuesOn(ray, samples);
        met = !values.empty();
        return met ? *std::max_element(values.begin(), values.end()) : 0.0;
    }

private:
    /// Cubic convolution with a = -1/2, by its kernel as a function of the distance.
    [[nodiscard]] double tricubic(const glm::dvec3& at) const {
        const auto kernel = [](double x) {
            x = std::abs(x);
            if (x < 1.0) return 1.5 * x * x * x - 2.5 * x * x + 1.0;
            return x < 2.0 ? -0.5 * x * x * x + 2.5 * x * x - 4.0 * x + 2.0 : 0.0;
        };
        const glm::ivec3 first = glm::ivec3(glm::floor(at)) - 1;
        double sum = 0.0;
        for (int point = 0; point < 64; ++point) {
            const glm::ivec3 i = first + glm::ivec3{point & 3, point >> 2 & 3, point >> 4};
            const glm::dvec3 off = at - glm::dvec3(i);
            sum += kernel(off.x) * kernel(off.y) * kernel(off.z) *
                   voxel(glm::clamp(i, glm::ivec3(0), volume_.size - 1));
        }
        return sum;
    }
    [[nodiscard]] glm::dvec3 gridFrom(const glm::dvec3& world) const {
        return glm::transpose(volume_.direction) * (world - volume_.origin) / volume_.spacing;
    }
    [[nodiscard]] double voxel(const glm::ivec3& i) const {
        return values_[static_cast<std::size_t>(i.x) +
                       static_cast<std::size_t>(volume_.size.x) *
                           (i.y + static_cast<std::size_t>(volume_.size.y) * i.z)];
    }

    const data::Volume& volume_;
    scene::Sampling sampling_;
    std::vector<float> values_;
};

}  // namespace volcast::support
