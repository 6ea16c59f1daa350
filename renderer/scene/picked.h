#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace volcast::scene {

/// The value of a field or channel somewhere.
struct PickedValue {
    std::string field;
    double value = 0.0;  ///< In the field's unit.
    friend bool operator==(const PickedValue&, const PickedValue&) = default;
};

/// The place in the data that a pixel shows.
struct Picked {
    std::string layer;
    std::vector<PickedValue> values;  ///< First the one that is seen; none where nothing is known.
    glm::dvec3 position{0.0};         ///< World.
    double distance = 0.0;            ///< From where the ray begins, world units.
    std::optional<std::uint32_t> cell{};  ///< Of a mesh: its index, as drawn.
    std::optional<glm::ivec3> voxel{};    ///< Of a volume: the nearest grid point.
    glm::vec3 colour{0.0F};               ///< Of the map there, or of the surface; linear RGB.
    friend bool operator==(const Picked&, const Picked&) = default;
};

}  // namespace volcast::scene
