#include "renderer/user_shader/control.h"

#include <array>

namespace volcast::user_shader {

const char* kindName(const Control& control) {
    static constexpr std::array kNames{"slider", "color",   "checkbox",
                                       "select", "invlerp", "transferFunction"};
    return kNames[control.kind.index()];
}

const char* name(NumberType type) {
    switch (type) {
        case NumberType::kFloat: return "float";
        case NumberType::kInt: return "int";
        case NumberType::kUint: return "uint";
    }
    return "";
}

std::vector<OpacityPoint> defaultPoints(const Interval& window) {
    const double length = window.to - window.from;
    return {{.value = window.from + 0.4 * length, .colour = glm::vec3(0.0F), .opacity = 0.0},
            {.value = window.from + 0.7 * length, .colour = glm::vec3(1.0F), .opacity = 1.0}};
}

}  // namespace volcast::user_shader
