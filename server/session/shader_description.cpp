#include "server/session/shader_description.h"

#include "renderer/scene/user_controls.h"
#include "renderer/user_shader/generate.h"

namespace volcast::session {
namespace {

using user_shader::Interval;

void put(const Interval& interval, v1::Range& range) {
    range.set_min(interval.from);
    range.set_max(interval.to);
}

void put(const glm::vec3& colour, v1::Colour& message) {
    message.set_r(colour.r);
    message.set_g(colour.g);
    message.set_b(colour.b);
}

/// Writes one kind of control.
struct Writer {
    v1::ShaderControl& message;
    Interval full;  ///< Of the data's type.

    void operator()(const user_shader::Slider& slider) const {
        v1::ShaderControl::Slider& to = *message.mutable_slider();
        to.set_type(name(slider.type));
        to.set_min(slider.min);
        to.set_max(slider.max);
        to.set_step(slider.step);
        to.set_initial(slider.initial);
    }
    void operator()(const user_shader::Colour& colour) const {
        put(colour.initial, *message.mutable_color());
    }
    void operator()(const user_shader::Checkbox& box) const { message.set_checkbox(box.initial); }
    void operator()(const user_shader::Select& select) const {
        v1::ShaderControl::Select& to = *message.mutable_select();
        to.set_type(select.texts ? "string_t" : name(select.type));
        to.set_initial(static_cast<std::uint32_t>(select.initial));
        for (const user_shader::Select::Option& option : select.options) {
            v1::ShaderControl::Option& added = *to.add_options();
            added.set_label(option.label);
            if (const double* number = std::get_if<double>(&option.value)) {
                added.set_number(*number);
            } else {
                added.set_text(std::get<std::string>(option.value));
            }
        }
    }
    void operator()(const user_shader::InvLerp& lerp) const {
        v1::ShaderControl::Invlerp& to = *message.mutable_invlerp();
        const Interval range = lerp.range.value_or(full);
        put(range, *to.mutable_range());
        const Interval ordered{.from = std::min(range.from, range.to),
                               .to = std::max(range.from, range.to)};
        put(lerp.window.value_or(ordered), *to.mutable_window());
        if (lerp.channel) to.set_channel(*lerp.channel);
        to.set_clamp(lerp.clamp);
    }
    void operator()(const user_shader::TransferFunction& map) const {
        v1::ShaderControl::TransferFunction& to = *message.mutable_transfer_function();
        const Interval window = map.window.value_or(full);
        put(window, *to.mutable_window());
        put(map.defaultColour, *to.mutable_default_colour());
        if (map.channel) to.set_channel(*map.channel);
        for (const user_shader::OpacityPoint& point :
             map.points.value_or(user_shader::defaultPoints(window))) {
            v1::MapState::Point& added = *to.add_points();
            added.set_value(point.value);
            put(point.colour, *added.mutable_colour());
            added.set_opacity(point.opacity);
        }
    }
};

}  // namespace

v1::ShaderDescription shaderDescription(const v1::DescribeShader& message,
                                        const scene::Summaries& summaries) {
    const auto summary = summaries.find(message.dataset());
    const auto type = summary == summaries.end() ? user_shader::ValueType::kF32
                                                 : scene::valueType(summary->second);
    const user_shader::Checked code = user_shader::checkText(message.code());
    v1::ShaderDescription description;
    description.set_request(message.request());
    for (const user_shader::Control& control : code.controls) {
        v1::ShaderControl& added = *description.add_controls();
        added.set_name(control.name);
        added.set_line(static_cast<std::uint32_t>(control.line));
        std::visit(Writer{.message = added, .full = user_shader::fullRange(type)}, control.kind);
    }
    for (const user_shader::Complaint& complaint : code.complaints) {
        v1::ShaderComplaint& added = *description.add_complaints();
        added.set_line(static_cast<std::uint32_t>(complaint.line));
        added.set_column(static_cast<std::uint32_t>(complaint.column));
        added.set_message(complaint.message);
    }
    return description;
}

}  // namespace volcast::session
