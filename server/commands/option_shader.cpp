#include "server/commands/option_shader.h"

#include <algorithm>
#include <charconv>

#include "renderer/scene/user_controls.h"
#include "renderer/user_shader/css_colour.h"
#include "server/commands/files.h"

namespace volcast::commands {
namespace {

using scene::ControlState;
using user_shader::Control;

Error wrong(const std::string& option, const std::string& wanted) {
    return fail(ErrorCode::kInvalidArgument, option + ": the value is not " + wanted);
}

Error undeclared(const std::string& option, const std::string& file) {
    return fail(ErrorCode::kNotFound, option + ": " + file + " declares no such control");
}

Result<double> numberFrom(const std::string& text, const std::string& option) {
    double value = 0.0;
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, value);
    if (read.ec == std::errc{} && read.ptr == end) return value;
    return wrong(option, "a number");
}

/// A control of the same kind whose one parameter is `text`: values are written as in code.
Result<Control> declaredWith(const std::string& head, const std::string& parameter,
                             const std::string& text, const std::string& option) {
    const user_shader::Parsed parsed =
        user_shader::parse("#uicontrol " + head + " x(" + parameter + "=" + text + ")");
    if (!parsed.complaints.empty()) {
        return fail(ErrorCode::kInvalidArgument, option + ": " + parsed.complaints.front().message);
    }
    return parsed.controls.front();
}

Result<ControlState> selectFrom(const user_shader::Select& select, const std::string& name,
                                const std::string& text, const std::string& option) {
    const auto labelled =
        std::ranges::find(select.options, text, &user_shader::Select::Option::label);
    if (labelled != select.options.end()) {
        const double* number = std::get_if<double>(&labelled->value);
        if (number != nullptr) return ControlState{.name = name, .value = *number};
        return ControlState{.name = name, .value = std::get<std::string>(labelled->value)};
    }
    if (select.texts) return ControlState{.name = name, .value = text};
    const Result<double> number = numberFrom(text, option);
    if (!number) return number.error();
    return ControlState{.name = name, .value = *number};
}

Result<ControlState> invlerpFrom(const std::string& name, const std::string& text,
                                 const std::string& option) {
    const Result<Control> read = declaredWith("invlerp", "range", text, option);
    if (!read) return read.error();
    const user_shader::Interval range = *std::get<user_shader::InvLerp>(read->kind).range;
    return ControlState{
        .name = name,
        .value = scene::InvlerpState{.range = data::Range{.min = static_cast<float>(range.from),
                                                          .max = static_cast<float>(range.to)}}};
}

Result<ControlState> mapFrom(const std::string& name, const std::string& text,
                             const std::string& option) {
    const Result<Control> read = declaredWith("transferFunction", "controlPoints", text, option);
    if (!read) return read.error();
    scene::MapState map;
    for (const user_shader::OpacityPoint& point :
         *std::get<user_shader::TransferFunction>(read->kind).points) {
        map.points.push_back({.value = static_cast<float>(point.value),
                              .colour = point.colour,
                              .opacity = static_cast<float>(point.opacity)});
    }
    return ControlState{.name = name, .value = std::move(map)};
}

Result<ControlState> stateFrom(const Control& control, const std::string& text,
                               const std::string& option) {
    const std::string& name = control.name;
    if (std::holds_alternative<user_shader::Slider>(control.kind)) {
        const Result<double> number = numberFrom(text, option);
        if (!number) return number.error();
        return ControlState{.name = name, .value = *number};
    }
    if (std::holds_alternative<user_shader::Colour>(control.kind)) {
        const auto colour = user_shader::cssColour(text);
        if (!colour) return wrong(option, "a CSS colour");
        return ControlState{.name = name, .value = *colour};
    }
    if (std::holds_alternative<user_shader::Checkbox>(control.kind)) {
        if (text != "true" && text != "false") return wrong(option, "true or false");
        return ControlState{.name = name, .value = text == "true"};
    }
    if (const auto* select = std::get_if<user_shader::Select>(&control.kind)) {
        return selectFrom(*select, name, text, option);
    }
    return std::holds_alternative<user_shader::InvLerp>(control.kind)
               ? invlerpFrom(name, text, option)
               : mapFrom(name, text, option);
}

}  // namespace

Result<scene::UserShader> shaderFrom(const std::string& file,
                                     const std::vector<std::string>& controls) {
    auto code = readTextFile(file);
    if (!code) return std::move(code).error();
    scene::UserShader shader{.code = *std::move(code), .controls = {}};
    const auto declared = scene::resolved(shader, file);
    if (!declared) return declared.error();
    for (const std::string& given : controls) {
        const std::size_t equals = given.find('=');
        const std::string name = given.substr(0, equals);
        const std::string option = "--control " + name;
        if (equals == std::string::npos) return wrong("--control " + given, "given: NAME=VALUE");
        const auto control = std::ranges::find(declared->controls, name, &Control::name);
        if (control == declared->controls.end()) {
            return undeclared(option, file);
        }
        auto state = stateFrom(*control, given.substr(equals + 1), option);
        if (!state) return std::move(state).error();
        shader.controls.push_back(*std::move(state));
    }
    const auto valid = scene::resolved(shader, file);
    if (!valid) return valid.error();
    return shader;
}

}  // namespace volcast::commands
