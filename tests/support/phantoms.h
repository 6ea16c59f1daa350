#pragma once

#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/data/transfer_function.h"
#include "renderer/data/volume_builder.h"
#include "tests/support/gl_test.h"

namespace volcast::support {

/// Where a phantom's grid lies in the world.
struct GridPlace {
    glm::ivec3 size{17};
    glm::dvec3 spacing{1.0};
    glm::dvec3 origin{0.0};
    glm::dmat3 direction{1.0};
};

/// A turn by `degrees` about `axis`, right-handed.
inline glm::dmat3 turn(const glm::dvec3& axis, double degrees) {
    const glm::dvec3 a = glm::normalize(axis);
    const double angle = degrees * 3.14159265358979323846 / 180.0;
    const double c = std::cos(angle), s = std::sin(angle);
    glm::dmat3 matrix;
    for (int column = 0; column < 3; ++column) {
        glm::dvec3 e{0.0};
        e[column] = 1.0;
        matrix[column] = e * c + glm::cross(a, e) * s + a * (glm::dot(a, e) * (1.0 - c));
    }
    return matrix;
}

/// A float32 volume whose grid point (i, j, k) holds `value(glm::dvec3(i, j, k))`.
inline data::Volume volumeOf(const GridPlace& place,
                             const std::function<double(const glm::dvec3&)>& value) {
    std::vector<float> voxels;
    for (int k = 0; k < place.size.z; ++k) {
        for (int j = 0; j < place.size.y; ++j) {
            for (int i = 0; i < place.size.x; ++i) {
                voxels.push_back(static_cast<float>(value(glm::dvec3(i, j, k))));
            }
        }
    }
    data::ChannelInput channel{.name = "f", .unit = "", .voxels = {}};
    channel.voxels.resize(voxels.size() * sizeof(float));
    std::memcpy(channel.voxels.data(), voxels.data(), channel.voxels.size());
    data::VolumeInput input;
    input.size = place.size;
    input.spacing = place.spacing;
    input.origin = place.origin;
    input.direction = place.direction;
    input.channels.push_back(std::move(channel));
    return must(data::buildVolume(std::move(input)));
}

/// The same matter for every value.
inline data::TransferFunction constantMap(const glm::vec3& colour, float extinction) {
    return {{{.value = 0.0F, .colour = colour, .extinction = extinction}}};
}

}  // namespace volcast::support
