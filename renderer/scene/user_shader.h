#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/data/field.h"

namespace volcast::scene {

/// State of an invlerp control; what is not given is as the code declares it.
struct InvlerpState {
    std::optional<data::Range> range{};
    std::optional<data::Range> window{};
    std::optional<int> channel{};
    friend bool operator==(const InvlerpState&, const InvlerpState&) = default;
};

/// State of a transferFunction control, as an editor draws it.
struct MapState {
    struct Point {
        float value = 0.0F;
        glm::vec3 colour{1.0F};  ///< sRGB.
        float opacity = 1.0F;    ///< In [0, 1].
        friend bool operator==(const Point&, const Point&) = default;
    };
    std::optional<data::Range> window{};
    std::vector<Point> points;
    std::optional<int> channel{};
    friend bool operator==(const MapState&, const MapState&) = default;
};

/// State of one control. double: slider or select; vec3: colour (sRGB); bool: checkbox; string:
/// select of strings.
struct ControlState {
    std::string name;
    std::variant<double, glm::vec3, bool, std::string, InvlerpState, MapState> value;
    friend bool operator==(const ControlState&, const ControlState&) = default;
};

/// GLSL that says what a sample of a ray emits, and the controls that are not at their default.
struct UserShader {
    std::string code;
    std::vector<ControlState> controls;
    friend bool operator==(const UserShader&, const UserShader&) = default;
};

}  // namespace volcast::scene
