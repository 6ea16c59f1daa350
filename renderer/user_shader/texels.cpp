#include "renderer/user_shader/texels.h"

#include <bit>
#include <cstdint>

#include "renderer/user_shader/css_colour.h"

namespace volcast::user_shader {
namespace {

float asFloat(double value) {
    return static_cast<float>(value);
}

/// A number as the code's type; integers by their bits.
glm::vec4 numberTexel(NumberType type, double value) {
    float first = asFloat(value);
    if (type == NumberType::kInt) first = std::bit_cast<float>(static_cast<std::int32_t>(value));
    if (type == NumberType::kUint) first = std::bit_cast<float>(static_cast<std::uint32_t>(value));
    return {first, 0.0F, 0.0F, 0.0F};
}

/// Where something begins, and 1 / its length.
glm::vec4 intervalTexel(const Interval& interval) {
    return {asFloat(interval.from), asFloat(1.0 / (interval.to - interval.from)), 0.0F, 0.0F};
}

glm::vec4 selectTexel(const Select& select) {
    const double* number = std::get_if<double>(&select.options[select.initial].value);
    return numberTexel(select.type,
                       number == nullptr ? static_cast<double>(select.initial) : *number);
}

void addPoints(std::vector<glm::vec4>& texels, const std::vector<OpacityPoint>& points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        const OpacityPoint& point = points[i];
        const double length = i + 1 < points.size() ? points[i + 1].value - point.value : 0.0;
        texels.emplace_back(linearFromSrgb(point.colour), asFloat(point.opacity));
        texels.emplace_back(asFloat(point.value), length > 0.0 ? asFloat(1.0 / length) : 0.0F, 0.0F,
                            0.0F);
    }
}

}  // namespace

std::vector<glm::vec4> controlTexels(const std::vector<Control>& controls, ValueType type,
                                     const ProgramNumbers& numbers) {
    std::vector<glm::vec4> texels(controls.size() + 1, glm::vec4(0.0F));
    texels[0].x = asFloat(numbers.referencesAWorldUnit);
    texels[0].y = asFloat(numbers.intervalShift);
    for (std::size_t i = 0; i < controls.size(); ++i) {
        const Control& control = controls[i];
        glm::vec4 texel{0.0F};
        if (const auto* slider = std::get_if<Slider>(&control.kind)) {
            texel = numberTexel(slider->type, slider->initial);
        } else if (const auto* select = std::get_if<Select>(&control.kind)) {
            texel = selectTexel(*select);
        } else if (const auto* colour = std::get_if<Colour>(&control.kind)) {
            texel = glm::vec4(linearFromSrgb(colour->initial), 1.0F);
        } else if (const auto* lerp = std::get_if<InvLerp>(&control.kind)) {
            texel = intervalTexel(lerp->range.value_or(fullRange(type)));
        } else if (const auto* map = std::get_if<TransferFunction>(&control.kind)) {
            const Interval window = map->window.value_or(fullRange(type));
            const std::vector<OpacityPoint> points = map->points.value_or(defaultPoints(window));
            texel = intervalTexel(window);
            texel.z = static_cast<float>(points.size());
            texel.w = static_cast<float>(texels.size());
            addPoints(texels, points);
        }
        texels[i + 1] = texel;
    }
    return texels;
}

}  // namespace volcast::user_shader
