#include "renderer/user_shader/generate.h"

#include <array>

#include "renderer/user_shader/check_text.h"

namespace volcast::user_shader {
namespace {

struct TypeRow {
    const char* name;  ///< In GLSL.
    Interval range;
};

const TypeRow& rowOf(ValueType type) {
    static const std::array<TypeRow, 4> kRows{
        TypeRow{"useruint8_t", {.from = 0.0, .to = 255.0}},
        TypeRow{"useruint16_t", {.from = 0.0, .to = 65535.0}},
        TypeRow{"userint16_t", {.from = -32768.0, .to = 32767.0}},
        TypeRow{"float", {.from = 0.0, .to = 1.0}}};
    return kRows[static_cast<std::size_t>(type)];
}

std::string channelText(const std::optional<int>& channel) {
    return channel ? std::to_string(*channel) : "kOwnChannel";
}

/// A function of a value, and one of the sample's own.
std::string functionText(const std::string& result, const std::string& name,
                         const std::string& call, const std::optional<int>& channel,
                         ValueType type) {
    return result + " " + name + "(" + rowOf(type).name + " v) { return " + call + "; }\n" +
           result + " " + name + "() { return " + name + "(getSampledValue(" +
           channelText(channel) + ")); }\n";
}

/// `texel` is where the control's state lies.
std::string numberText(NumberType type, const std::string& name, const std::string& texel) {
    switch (type) {
        case NumberType::kFloat: return "float " + name + " = " + texel + ".x;\n";
        case NumberType::kInt: return "int " + name + " = floatBitsToInt(" + texel + ".x);\n";
        case NumberType::kUint: return "uint " + name + " = floatBitsToUint(" + texel + ".x);\n";
    }
    return {};
}

std::string controlText(const Control& control, std::size_t index, ValueType type) {
    const std::string name = std::string{kPrefix} + control.name;
    const std::string number = std::to_string(index);
    const std::string texel = "controlTexel(" + number + ")";
    const std::string state = "control" + number;
    const std::string kept = "vec4 " + state + " = " + texel + ";\n";
    if (const auto* slider = std::get_if<Slider>(&control.kind)) {
        return numberText(slider->type, name, texel);
    }
    if (const auto* select = std::get_if<Select>(&control.kind)) {
        return numberText(select->type, name, texel);
    }
    if (std::holds_alternative<Colour>(control.kind)) {
        return "vec3 " + name + " = " + texel + ".rgb;\n";
    }
    if (const auto* box = std::get_if<Checkbox>(&control.kind)) {
        return "const bool " + name + (box->initial ? " = true;\n" : " = false;\n");
    }
    if (const auto* lerp = std::get_if<InvLerp>(&control.kind)) {
        const std::string call =
            "invLerp(" + state + (lerp->clamp ? ", true" : ", false") + ", valueOf(v))";
        return kept + functionText("float", name, call, lerp->channel, type);
    }
    const auto& map = std::get<TransferFunction>(control.kind);
    return kept + functionText("vec4", name, "transferFunctionAt(" + state + ", valueOf(v))",
                               map.channel, type);
}

}  // namespace

Interval fullRange(ValueType type) {
    return rowOf(type).range;
}

std::string valuesText(ValueType type, bool volumeRendering) {
    const std::string name = rowOf(type).name;
    const auto reader = [&name](const std::string& function, const std::string& value) {
        return name + " " + function + "(int channel) { return " + name + "(" + value +
               "(channel)); }\n";
    };
    const auto ofOwn = [&name](const std::string& function) {
        return name + " " + function + "() { return " + function + "(kOwnChannel); }\n";
    };
    return std::string{"const bool VOLUME_RENDERING = "} + (volumeRendering ? "true" : "false") +
           ";\n" + reader("getDataValue", "nearestValue") + ofOwn("getDataValue") +
           reader("getInterpolatedDataValue", "interpolatedValue") +
           ofOwn("getInterpolatedDataValue") + reader("getSampledValue", "sampledValue");
}

std::string controlsText(const std::vector<Control>& controls, const std::vector<int>& others,
                         ValueType type) {
    std::string text = "int slotOf(int channel) { return ";
    for (std::size_t i = 0; i < others.size(); ++i) {
        text += "channel == " + std::to_string(others[i]) + " ? " + std::to_string(i + 1) + " : ";
    }
    text += "0; }\n";
    for (std::size_t i = 0; i < controls.size(); ++i) text += controlText(controls[i], i, type);
    return text;
}

}  // namespace volcast::user_shader
