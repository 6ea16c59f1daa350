#include "renderer/worker/user_shader_message.h"

#include <utility>

namespace volcast::worker {
namespace {

using scene::ControlState;
using scene::InvlerpState;
using scene::MapState;

data::Range rangeFrom(const v1::Range& message) {
    return {.min = static_cast<float>(message.min()), .max = static_cast<float>(message.max())};
}

void put(v1::Range* message, data::Range range) {
    message->set_min(range.min);
    message->set_max(range.max);
}

glm::vec3 colourFrom(const v1::Colour& message) {
    return {message.r(), message.g(), message.b()};
}

void put(v1::Colour* message, const glm::vec3& colour) {
    message->set_r(colour.r);
    message->set_g(colour.g);
    message->set_b(colour.b);
}

InvlerpState invlerpFrom(const v1::InvlerpState& message) {
    InvlerpState state;
    if (message.has_range()) state.range = rangeFrom(message.range());
    if (message.has_window()) state.window = rangeFrom(message.window());
    if (message.has_channel()) state.channel = message.channel();
    return state;
}

MapState mapFrom(const v1::MapState& message) {
    MapState state;
    if (message.has_window()) state.window = rangeFrom(message.window());
    if (message.has_channel()) state.channel = message.channel();
    for (const v1::MapState::Point& point : message.points()) {
        state.points.push_back({.value = static_cast<float>(point.value()),
                                .colour = colourFrom(point.colour()),
                                .opacity = static_cast<float>(point.opacity())});
    }
    return state;
}

/// Writes the value of a control into its message.
struct Writer {
    v1::ControlState* message;

    void operator()(double number) const { message->set_number(number); }
    void operator()(const glm::vec3& colour) const { put(message->mutable_colour(), colour); }
    void operator()(bool checked) const { message->set_checked(checked); }
    void operator()(const std::string& choice) const { message->set_choice(choice); }
    void operator()(const InvlerpState& state) const {
        v1::InvlerpState* invlerp = message->mutable_invlerp();
        if (state.range) put(invlerp->mutable_range(), *state.range);
        if (state.window) put(invlerp->mutable_window(), *state.window);
        if (state.channel) invlerp->set_channel(*state.channel);
    }
    void operator()(const MapState& state) const {
        v1::MapState* map = message->mutable_map();
        if (state.window) put(map->mutable_window(), *state.window);
        if (state.channel) map->set_channel(*state.channel);
        for (const MapState::Point& point : state.points) {
            v1::MapState::Point* added = map->add_points();
            added->set_value(point.value);
            put(added->mutable_colour(), point.colour);
            added->set_opacity(point.opacity);
        }
    }
};

Result<ControlState> controlFrom(const v1::ControlState& message, const std::string& path) {
    ControlState state{.name = message.name(), .value = {}};
    switch (message.value_case()) {
        case v1::ControlState::kNumber: state.value = message.number(); return state;
        case v1::ControlState::kColour: state.value = colourFrom(message.colour()); return state;
        case v1::ControlState::kChecked: state.value = message.checked(); return state;
        case v1::ControlState::kChoice: state.value = message.choice(); return state;
        case v1::ControlState::kInvlerp: state.value = invlerpFrom(message.invlerp()); return state;
        case v1::ControlState::kMap: state.value = mapFrom(message.map()); return state;
        case v1::ControlState::VALUE_NOT_SET: break;
    }
    return fail(ErrorCode::kInvalidArgument,
                path + ": the control \"" + message.name() + "\" has no value", path);
}

}  // namespace

Result<scene::UserShader> userShaderFrom(const v1::UserShader& message, const std::string& path) {
    scene::UserShader shader{.code = message.code(), .controls = {}};
    for (int i = 0; i < message.controls_size(); ++i) {
        auto control =
            controlFrom(message.controls(i), path + ".controls[" + std::to_string(i) + "]");
        if (!control) return std::move(control).error();
        shader.controls.push_back(*std::move(control));
    }
    return shader;
}

v1::UserShader toMessage(const scene::UserShader& shader) {
    v1::UserShader message;
    message.set_code(shader.code);
    for (const ControlState& control : shader.controls) {
        v1::ControlState* added = message.add_controls();
        added->set_name(control.name);
        std::visit(Writer{added}, control.value);
    }
    return message;
}

}  // namespace volcast::worker
