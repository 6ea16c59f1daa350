#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

namespace volcast::user_shader {

/// The GLSL type of a slider or of a select's options.
enum class NumberType { kFloat, kInt, kUint };

/// From one number to another; `from` may be the larger.
struct Interval {
    double from = 0.0;
    double to = 1.0;
    friend bool operator==(const Interval&, const Interval&) = default;
};

struct Slider {
    NumberType type = NumberType::kFloat;
    double min = 0.0, max = 1.0, step = 0.01;
    double initial = 0.5;
    friend bool operator==(const Slider&, const Slider&) = default;
};

struct Colour {
    glm::vec3 initial{1.0F};  ///< sRGB-encoded.
    friend bool operator==(const Colour&, const Colour&) = default;
};

/// A constant of the program: a change compiles it again.
struct Checkbox {
    bool initial = false;
    friend bool operator==(const Checkbox&, const Checkbox&) = default;
};

/// One of a list. In code it is its option's value; where these are texts, an int, its place.
struct Select {
    struct Option {
        std::string label;
        std::variant<double, std::string> value;
        friend bool operator==(const Option&, const Option&) = default;
    };
    bool texts = false;
    NumberType type = NumberType::kInt;
    std::vector<Option> options;
    std::size_t initial = 0;
    friend bool operator==(const Select&, const Select&) = default;
};

/// Maps values to 0..1: `range` to it, `window` is what an editor shows.
struct InvLerp {
    std::optional<Interval> range = {};   ///< None: that of the data's type.
    std::optional<Interval> window = {};  ///< None: `range`, in order.
    std::optional<int> channel = {};      ///< None: the layer's field.
    bool clamp = true;
    friend bool operator==(const InvLerp&, const InvLerp&) = default;
};

/// A point of a transfer function; linear between two, each channel by itself.
struct OpacityPoint {
    double value = 0.0;
    glm::vec3 colour{0.0F};  ///< sRGB-encoded.
    double opacity = 0.0;    ///< 0 to 1.
    friend bool operator==(const OpacityPoint&, const OpacityPoint&) = default;
};

/// Transparent below its first point, the last point's above it.
struct TransferFunction {
    static constexpr std::size_t kMaxPoints = 256;
    std::optional<Interval> window = {};                   ///< None: that of the data's type.
    std::optional<std::vector<OpacityPoint>> points = {};  ///< None: defaultPoints().
    std::optional<int> channel = {};                       ///< None: the layer's field.
    glm::vec3 defaultColour{1.0F};  ///< Of points that an editor adds; sRGB-encoded.
    friend bool operator==(const TransferFunction&, const TransferFunction&) = default;
};

/// What a `#uicontrol` line declares.
struct Control {
    std::string name;
    int line = 1;
    std::variant<Slider, Colour, Checkbox, Select, InvLerp, TransferFunction> kind;
    friend bool operator==(const Control&, const Control&) = default;
};

inline constexpr std::size_t kMaxControls = 64;

/// "slider", "color", "checkbox", "select", "invlerp", "transferFunction".
const char* kindName(const Control& control);
/// "float", "int", "uint".
const char* name(NumberType type);

/// Transparent black at 0.4 of `window`, opaque white at 0.7.
std::vector<OpacityPoint> defaultPoints(const Interval& window);

}  // namespace volcast::user_shader
