#include "renderer/scene/control_states.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "renderer/user_shader/parameters.h"

namespace volcast::scene {
namespace {

using user_shader::Interval;
using user_shader::OpacityPoint;
using user_shader::textOf;

/// Why a state is refused; nothing where it was taken.
using Refusal = std::optional<std::string>;

constexpr const char* kStateNames[] = {"a number", "a colour",         "checked or not",
                                       "a choice", "an invlerp state", "a map"};

Refusal wrongKind(const user_shader::Control& control, const ControlState& state,
                  const char* wanted) {
    return std::string{"is a "} + kindName(control) + ", whose state is " + wanted + ", not " +
           kStateNames[state.value.index()];
}

bool finite(const glm::vec3& colour) {
    return colour.r >= 0.0F && colour.r <= 1.0F && colour.g >= 0.0F && colour.g <= 1.0F &&
           colour.b >= 0.0F && colour.b <= 1.0F;
}

Refusal take(user_shader::Slider& slider, double value) {
    if (!(value >= slider.min && value <= slider.max)) {
        return textOf(value) + " is not in " + textOf(slider.min) + " to " + textOf(slider.max);
    }
    const char* wanted = user_shader::unfit(value, slider.type);
    if (wanted != nullptr) return textOf(value) + " is not " + wanted;
    slider.initial = value;
    return {};
}

Refusal take(user_shader::Colour& control, const glm::vec3& colour) {
    if (!finite(colour)) return "its red, green and blue are not all in 0 to 1";
    control.initial = colour;
    return {};
}

std::string optionsOf(const user_shader::Select& select) {
    std::string text;
    for (const auto& option : select.options) {
        const double* number = std::get_if<double>(&option.value);
        text += text.empty() ? "" : ", ";
        text +=
            number == nullptr ? "\"" + std::get<std::string>(option.value) + "\"" : textOf(*number);
    }
    return text;
}

Refusal take(user_shader::Select& select, const std::variant<double, std::string>& choice) {
    const auto found =
        std::ranges::find(select.options, choice, &user_shader::Select::Option::value);
    if (found == select.options.end()) {
        const double* number = std::get_if<double>(&choice);
        return (number == nullptr ? "\"" + std::get<std::string>(choice) + "\"" : textOf(*number)) +
               " is not one of " + optionsOf(select);
    }
    select.initial = static_cast<std::size_t>(found - select.options.begin());
    return {};
}

Refusal take(std::optional<Interval>& into, const std::optional<data::Range>& range,
             const char* name, bool ordered) {
    if (!range) return {};
    const std::string ends = textOf(range->min) + " to " + textOf(range->max);
    if (!std::isfinite(range->min) || !std::isfinite(range->max) || range->min == range->max) {
        return std::string{"its "} + name + " " + ends + " has no length";
    }
    if (ordered && range->min > range->max) {
        return std::string{"its "} + name + " " + ends + " is not in order";
    }
    into = Interval{.from = range->min, .to = range->max};
    return {};
}

Refusal take(std::optional<int>& into, const std::optional<int>& channel) {
    if (!channel) return {};
    if (*channel < 0) return "there is no channel " + std::to_string(*channel);
    into = channel;
    return {};
}

Refusal take(user_shader::InvLerp& control, const InvlerpState& state) {
    if (Refusal why = take(control.range, state.range, "range", false)) return why;
    if (Refusal why = take(control.window, state.window, "window", true)) return why;
    return take(control.channel, state.channel);
}

Refusal take(user_shader::TransferFunction& control, const MapState& state) {
    if (state.points.size() > user_shader::TransferFunction::kMaxPoints) {
        return std::to_string(state.points.size()) + " points, at most " +
               std::to_string(user_shader::TransferFunction::kMaxPoints);
    }
    std::vector<OpacityPoint> points;
    for (std::size_t i = 0; i < state.points.size(); ++i) {
        const MapState::Point& point = state.points[i];
        const std::string which = "point " + std::to_string(i) + ": ";
        if (!std::isfinite(point.value)) return which + "its value is not finite";
        if (i > 0 && point.value < state.points[i - 1].value) {
            return which + textOf(point.value) + " is below the point before";
        }
        if (!finite(point.colour)) return which + "its red, green and blue are not all in 0 to 1";
        if (!(point.opacity >= 0.0F && point.opacity <= 1.0F)) {
            return which + "the opacity " + textOf(point.opacity) + " is not in 0 to 1";
        }
        points.push_back({.value = point.value, .colour = point.colour, .opacity = point.opacity});
    }
    if (Refusal why = take(control.window, state.window, "window", true)) return why;
    control.points = std::move(points);
    return take(control.channel, state.channel);
}

/// Takes the state where it is of the control's kind.
Refusal take(user_shader::Control& control, const ControlState& state) {
    const double* number = std::get_if<double>(&state.value);
    const auto* text = std::get_if<std::string>(&state.value);
    if (auto* slider = std::get_if<user_shader::Slider>(&control.kind)) {
        return number != nullptr ? take(*slider, *number) : wrongKind(control, state, "a number");
    }
    if (auto* select = std::get_if<user_shader::Select>(&control.kind)) {
        if (select->texts) {
            return text != nullptr ? take(*select, *text) : wrongKind(control, state, "a choice");
        }
        return number != nullptr ? take(*select, *number) : wrongKind(control, state, "a number");
    }
    if (auto* colour = std::get_if<user_shader::Colour>(&control.kind)) {
        const auto* value = std::get_if<glm::vec3>(&state.value);
        return value != nullptr ? take(*colour, *value) : wrongKind(control, state, "a colour");
    }
    if (auto* box = std::get_if<user_shader::Checkbox>(&control.kind)) {
        const bool* checked = std::get_if<bool>(&state.value);
        if (checked == nullptr) return wrongKind(control, state, "checked or not");
        box->initial = *checked;
        return {};
    }
    if (auto* lerp = std::get_if<user_shader::InvLerp>(&control.kind)) {
        const auto* value = std::get_if<InvlerpState>(&state.value);
        return value != nullptr ? take(*lerp, *value)
                                : wrongKind(control, state, "an invlerp state");
    }
    const auto* value = std::get_if<MapState>(&state.value);
    if (value == nullptr) return wrongKind(control, state, "a map");
    return take(std::get<user_shader::TransferFunction>(control.kind), *value);
}

}  // namespace

Result<user_shader::Control> withState(const user_shader::Control& control,
                                       const ControlState& state, const std::string& path) {
    user_shader::Control changed = control;
    const Refusal why = take(changed, state);
    if (!why) return changed;
    return fail(ErrorCode::kInvalidArgument,
                path + ": the control \"" + control.name + "\": " + *why, path);
}

}  // namespace volcast::scene
